/** Files that are whole or absent: written under a temporary name, checked, then renamed. */
#pragma once
#include <functional>
#include <string>

namespace rgbd_graphslam {

/** Where a file or folder is made until it is whole: beside `path`, under a name that ends like
 *  it and tells machine and process, so that makeWritableFolder() knows what is abandoned. */
std::string temporaryName(const std::string& path);

/** Calls `write(temporary_path)`, flushes the file to disk and renames it to `path`; a kill at any
 *  moment leaves the old file, if any, untouched. The temporary name keeps the extension of `path`
 *  because many writers choose their format by it.
 *  \param write writes the whole file; returns false or throws on failure
 *  \throws Error naming `path` when writing, flushing or renaming fails; the temporary is removed
 */
void writeAtomically(const std::string& path,
                     const std::function<bool(const std::string& temporary_path)>& write);

/** writeAtomically for text. */
void writeTextAtomically(const std::string& path, const std::string& text);

/** Makes a folder with its parents if it must, and removes what killed processes of this machine
 *  left half-written in it.
 *  \throws Error naming the folder */
void makeWritableFolder(const std::string& path);

}  // namespace rgbd_graphslam
