/** Ownership of what the system numbers. */
#pragma once
#include <unistd.h>

#include <utility>

namespace rgbd_graphslam {

/** A file descriptor that is closed with its owner. */
class FileDescriptor {
  public:
    explicit FileDescriptor(int fd = -1) : fd_(fd) {}
    ~FileDescriptor() { reset(); }
    FileDescriptor(FileDescriptor&& other) noexcept : fd_(other.release()) {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept {
        reset(other.release());
        return *this;
    }
    int get() const { return fd_; }
    explicit operator bool() const { return fd_ >= 0; }
    void reset(int fd = -1) {
        if (fd_ >= 0) ::close(fd_);
        fd_ = fd;
    }

  private:
    int release() { return std::exchange(fd_, -1); }
    int fd_;
};

}  // namespace rgbd_graphslam
