#include "rgbd_graphslam/live/live_socket.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <utility>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr std::uint32_t magic = 0x344c4752;  // "RGL4"
constexpr std::size_t largest_message = std::size_t{256} << 20, chunk_bytes = 1 << 16;

struct Header {
    std::uint32_t magic, bytes;
};

/** Addresses hold 107 characters only; a folder of any name is reached through its descriptor. */
class SocketAddress {
  public:
    explicit SocketAddress(const std::string& folder)
        : folder_(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC)) {
        address_.sun_family = AF_UNIX;
        const std::string path =
            "/proc/self/fd/" + std::to_string(folder_.get()) + "/" + live_socket_name;
        path.copy(address_.sun_path, sizeof(address_.sun_path) - 1);
    }
    const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&address_); }
    static constexpr socklen_t size() { return sizeof(sockaddr_un); }

  private:
    FileDescriptor folder_;
    sockaddr_un address_{};
};

int newSocket() {
    return ::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
}

std::string framed(std::string message) {
    const Header header{magic, static_cast<std::uint32_t>(message.size())};
    return message.insert(0, reinterpret_cast<const char*>(&header), sizeof(header));
}

}  // namespace

LiveServer::LiveServer(const std::string& folder)
    : path_(folder + "/" + live_socket_name),
      listener_(newSocket()),
      wake_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    ::unlink(path_.c_str());
    const SocketAddress address(folder);
    if (!listener_ || !wake_ ||
        ::bind(listener_.get(), address.get(), SocketAddress::size()) != 0 ||
        ::listen(listener_.get(), 4) != 0) {
        throw Error("no viewer can look on: '" + path_ + "' cannot be made (" +
                    std::strerror(errno) + ")");
    }
    thread_ = std::thread([this] { serve(); });
}

LiveServer::~LiveServer() {
    stop_ = true;
    ::eventfd_write(wake_.get(), 1);
    thread_.join();
    ::unlink(path_.c_str());
}

void LiveServer::post(std::function<std::string()> encode) {
    if (!ready_.exchange(false)) return;
    {
        const std::lock_guard lock(mutex_);
        message_ = std::move(encode);
    }
    ::eventfd_write(wake_.get(), 1);
}

void LiveServer::pictureSent() {
    wanted_ = false;
    ::eventfd_write(wake_.get(), 1);
}

void LiveServer::serve() {
    while (!stop_) {
        // Who asks without end is heard once a picture.
        const short asks = wanted_ ? 0 : POLLIN, takes = pending_.empty() ? 0 : POLLOUT;
        pollfd events[] = {
            {wake_.get(), POLLIN, 0},
            {viewer_ ? -1 : listener_.get(), POLLIN, 0},
            {viewer_.get(), static_cast<short>(asks | takes), 0}};  // those below 0 are passed over
        if (::poll(events, 3, -1) < 0 && errno != EINTR) return;
        if (events[0].revents) takeMessage();
        if (events[1].revents) acceptViewer();
        if (events[2].revents & (POLLHUP | POLLERR)) {
            dropViewer();
        } else if (events[2].revents & POLLIN) {
            hearViewer();
        } else if (!pending_.empty()) {
            sendSome();
        }
    }
}

void LiveServer::acceptViewer() {
    viewer_.reset(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    wanted_ = false;
    ready_ = static_cast<bool>(viewer_);
}

void LiveServer::dropViewer() {
    ready_ = false;
    viewer_.reset();
    pending_.clear();
    const std::lock_guard lock(mutex_);
    message_ = nullptr;
}

/** Each byte asks for a picture; its end is that of the viewer. */
void LiveServer::hearViewer() {
    char bytes[64];
    const ssize_t n = ::recv(viewer_.get(), bytes, sizeof(bytes), MSG_DONTWAIT);
    if (n > 0) {
        wanted_ = true;
    } else if (n == 0 || (errno != EAGAIN && errno != EINTR)) {
        dropViewer();
    }
}

void LiveServer::takeMessage() {
    eventfd_t count = 0;
    ::eventfd_read(wake_.get(), &count);
    std::function<std::string()> message;
    {
        const std::lock_guard lock(mutex_);
        message = std::exchange(message_, nullptr);
    }
    if (!message || !viewer_ || !pending_.empty()) return;
    ready_ = false;
    try {
        pending_ = framed(message());
    } catch (const std::exception&) {
        ready_ = true;  // a message that cannot be made is one more that is dropped
    }
    sent_ = 0;
}

void LiveServer::sendSome() {
    const ssize_t n = ::send(viewer_.get(), pending_.data() + sent_, pending_.size() - sent_,
                             MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n < 0) {
        if (errno != EAGAIN && errno != EINTR) dropViewer();
        return;
    }
    sent_ += static_cast<std::size_t>(n);
    if (sent_ < pending_.size()) return;
    pending_.clear();
    ready_ = true;
}

bool LiveClient::connect(const std::string& folder) {
    socket_.reset(newSocket());
    buffer_.clear();
    const SocketAddress address(folder);
    if (::connect(socket_.get(), address.get(), SocketAddress::size()) != 0) socket_.reset();
    return connected();
}

void LiveClient::askForPicture() {
    const char any = 1;
    ::send(socket_.get(), &any, 1, MSG_NOSIGNAL | MSG_DONTWAIT);  // receive() notices an end
}

std::vector<std::string> LiveClient::receive() {
    std::vector<std::string> messages;
    while (connected() && readSome()) cutMessages(messages);
    return messages;
}

/** \return whether something came */
bool LiveClient::readSome() {
    char bytes[chunk_bytes];
    const ssize_t n = ::recv(socket_.get(), bytes, sizeof(bytes), 0);
    if (n > 0) {
        buffer_.append(bytes, static_cast<std::size_t>(n));
        return true;
    }
    if (n == 0 || (errno != EAGAIN && errno != EINTR)) socket_.reset();
    return false;
}

void LiveClient::cutMessages(std::vector<std::string>& messages) {
    Header header{};
    std::size_t at = 0;
    while (buffer_.size() - at >= sizeof(header)) {
        std::memcpy(&header, buffer_.data() + at, sizeof(header));
        if (header.magic != magic || header.bytes > largest_message) {
            socket_.reset();  // this is not rgbd-slam of our version
            return;
        }
        if (buffer_.size() - at - sizeof(header) < header.bytes) break;
        messages.push_back(buffer_.substr(at + sizeof(header), header.bytes));
        at += sizeof(header) + header.bytes;
    }
    buffer_.erase(0, at);
}

}  // namespace rgbd_graphslam
