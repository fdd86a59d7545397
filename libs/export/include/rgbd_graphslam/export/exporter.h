/** A finished run in the formats of other programs. */
#pragma once
#include <memory>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** What all formats have in common, and settings of single ones. */
struct ExportOptions {
    /** Takes the place of the rawlog named in summary.json unless empty. */
    std::string rawlog;
    /** Images of all frames with a pose instead of keyframes only. */
    bool all_frames = false;
    /** Meshes with the colors of their vertices, without texture. */
    bool vertex_colors = false;
    /** Largest width and height of a texture, pixels. */
    int texture_size = 8192;
};

/** One format. */
class Exporter {
  public:
    virtual ~Exporter() = default;

    /** As given to --to. */
    virtual const char* name() const = 0;
    /** What is written, in a few words. */
    virtual const char* about() const = 0;
    /** Name of the file or folder that is written, when none is given. */
    virtual const char* fileName() const = 0;
    virtual bool writesFolder() const { return false; }

    /** Writes a file atomically, or fills an empty folder.
     *  \param run_folder output folder of rgbd-slam
     *  \return one line that says what was written
     *  \throws Error naming the input that is missing or damaged and how to get it, or the file
     * that cannot be written */
    virtual std::string write(const std::string& run_folder, const ExportOptions& options,
                              const std::string& path) const = 0;
};

/** All formats, in the order in which they are listed. */
const std::vector<std::unique_ptr<const Exporter>>& exporters();

/** Names of all formats. */
std::vector<std::string> exportFormats();

/** A file that was written, with a few words on its contents. */
struct ExportedFile {
    std::string path, summary;
};

/** Writes a run in one or several formats.
 *  \param formats names, see exportFormats()
 *  \param output "" for RUN_FOLDER/export; otherwise an existing folder to write into, or, for a
 *         single format, the path to write; for several formats a folder that is made
 *  \throws Error as Exporter::write does; when a folder would have to be replaced that is not in
 *          RUN_FOLDER/export */
std::vector<ExportedFile> exportRun(const std::string& run_folder,
                                    const std::vector<std::string>& formats,
                                    const ExportOptions& options, const std::string& output);

}  // namespace rgbd_graphslam
