/** Disks that are full or read-only. */
#pragma once
#include <sys/mount.h>

#include <filesystem>
#include <string>

namespace rgbd_graphslam {

/** A tmpfs, which only root can make. */
class SmallDisk {
  public:
    SmallDisk(const std::string& path, std::size_t bytes) : path_(path) {
        std::filesystem::create_directories(path);
        const std::string size = "size=" + std::to_string(bytes);
        mounted_ = mount("tmpfs", path.c_str(), "tmpfs", 0, size.c_str()) == 0;
    }
    ~SmallDisk() {
        if (mounted_) umount2(path_.c_str(), MNT_DETACH);
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

    bool mounted() const { return mounted_; }
    bool makeReadOnly() const {
        return mount("tmpfs", path_.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr) == 0;
    }

  private:
    std::string path_;
    bool mounted_ = false;
};

}  // namespace rgbd_graphslam
