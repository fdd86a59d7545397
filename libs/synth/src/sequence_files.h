/** The text and geometry files of a sequence: everything but the pictures. */
#pragma once
#include <string>

#include "rgbd_graphslam/synth/sequence.h"

namespace rgbd_graphslam::synth {

/** Time 0 of a motion, in stamps (s). */
constexpr double kFirstStamp_s = 1000;

/** `rgb/1000.033333.png` for a stamp. \param kind the folder, e.g. "rgb" */
std::string pictureName(const char* kind, double stamp_s);

void writePictureLists(const std::string& folder, const FilmOptions& options, int frames);
/** Truth at 100 Hz, inertial readings at 200 Hz and, for planar robots, odometry at 20 Hz and when
 *  the wheels slip. */
void writeMotionFiles(const std::string& folder, std::uint64_t seed, const World& world,
                      int frames);
/** Of the laser scanner, where it is asked for.
 *  \throws Error when no robot carries the camera */
void writeScans(const std::string& path, const FilmOptions& options, const World& world,
                const Scene& scene, int frames);
/** Of both cameras of a stereo camera. */
void writeCameraIni(const std::string& folder, const FilmOptions& options, bool on_robot);
/** Names and colors of the values of label pictures. */
void writeLabelsIni(const std::string& path);
/** Boxes of the movers at the stamps of color pictures.
 *  \param bodies of the movers, in the same order */
void writeMovers(const std::string& path, const FilmOptions& options,
                 const std::vector<Mover>& movers, const std::vector<MovingBody>& bodies,
                 int frames);
/** The faces that stand still, as triangles, binary PLY. */
void writeSurface(const std::string& path, const Scene& scene);

}  // namespace rgbd_graphslam::synth
