#include "rgbd_graphslam/benchmark/download.h"

#include <curl/curl.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/progress.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

constexpr long connect_timeout_s = 30;
constexpr long stalled_bytes_a_s = 1000, stalled_for_s = 60;
constexpr double megabyte = 1e6;

std::string inMegabytes(std::size_t bytes) {
    char text[32];
    std::snprintf(text, sizeof text, bytes < 1e6 ? "%.3f MB" : "%.0f MB",
                  static_cast<double>(bytes) / megabyte);
    return text;
}

/** One attempt to fetch what is missing of a file. */
class Transfer {
  public:
    Transfer(const std::string& url, const std::string& part, std::optional<std::size_t> expected)
        : url_(url),
          part_(part),
          expected_(expected),
          offset_(fs::exists(part) ? fs::file_size(part) : 0),
          curl_(curl_easy_init(), curl_easy_cleanup),
          file_(std::fopen(part.c_str(), "ab"), std::fclose),
          progress_("fetching", 0, "MB") {
        if (!curl_ || !file_) throw Error("cannot write '" + part + "'", "check permissions");
        set(CURLOPT_URL, url.c_str());
        set(CURLOPT_PROTOCOLS_STR, "http,https");
        set(CURLOPT_FOLLOWLOCATION, 1L);
        set(CURLOPT_FAILONERROR, 1L);
        set(CURLOPT_CONNECTTIMEOUT, connect_timeout_s);
        set(CURLOPT_LOW_SPEED_LIMIT, stalled_bytes_a_s);
        set(CURLOPT_LOW_SPEED_TIME, stalled_for_s);
        set(CURLOPT_NOSIGNAL, 1L);
        set(CURLOPT_ERRORBUFFER, reason_);
        set(CURLOPT_RESUME_FROM_LARGE, static_cast<curl_off_t>(offset_));
        set(CURLOPT_WRITEFUNCTION, &Transfer::takeBytes);
        set(CURLOPT_WRITEDATA, this);
    }

    /** \return false when the server does not go on from where the file ends */
    bool run() {
        const CURLcode code = curl_easy_perform(curl_.get());
        if (std::fflush(file_.get()) != 0) refused_ = "the disk is full";
        if (offset_ + received_ == 0) fs::remove(part_);
        if (!refused_.empty()) throw Error("fetching '" + url_ + "': " + refused_, remedy_);
        if (offset_ > 0 && cannotResume(code)) return false;
        if (code != CURLE_OK) fail(code);
        if (total_ && fs::file_size(part_) != *total_) fail(CURLE_PARTIAL_FILE);
        return true;
    }

  private:
    template <class Value>
    void set(CURLoption option, Value value) {
        curl_easy_setopt(curl_.get(), option, value);
    }

    long status() const {
        long status = 0;
        curl_easy_getinfo(curl_.get(), CURLINFO_RESPONSE_CODE, &status);
        return status;
    }

    bool cannotResume(CURLcode code) const {
        constexpr long range_not_satisfiable = 416;
        return code == CURLE_RANGE_ERROR || status() == range_not_satisfiable;
    }

    static std::size_t takeBytes(char* bytes, std::size_t, std::size_t count, void* self) {
        return static_cast<Transfer*>(self)->take(bytes, count);
    }

    std::size_t take(const char* bytes, std::size_t count) {
        if (received_ == 0 && !accepts()) return 0;
        if (std::fwrite(bytes, 1, count, file_.get()) != count) {
            refused_ = "the disk is full";
            return 0;
        }
        received_ += count;
        progress_.update(static_cast<std::size_t>((offset_ + received_) / megabyte));
        return count;
    }

    /** Looks at what the server announces, before anything is written. */
    bool accepts() {
        curl_off_t announced = -1;
        curl_easy_getinfo(curl_.get(), CURLINFO_CONTENT_LENGTH_DOWNLOAD_T, &announced);
        if (announced < 0) return true;
        total_ = offset_ + static_cast<std::size_t>(announced);
        progress_.expect(static_cast<std::size_t>(*total_ / megabyte));
        if (expected_ && *total_ != *expected_) {
            refused_ = "the server offers " + std::to_string(*total_) + " bytes where " +
                       std::to_string(*expected_) + " are expected";
            remedy_ = offset_ > 0 ? "remove '" + part_ + "' and call again"
                                  : "check the address, or correct the table";
        } else if (fs::space(fs::absolute(part_).parent_path()).available <
                   static_cast<std::uintmax_t>(announced)) {
            refused_ = "its " + inMegabytes(*total_) + " do not fit on the disk";
        }
        return refused_.empty();
    }

    [[noreturn]] void fail(CURLcode code) const {
        const std::string again = "check the network and call again";
        if (code == CURLE_HTTP_RETURNED_ERROR) {
            throw Error("the server answers " + std::to_string(status()) + " for '" + url_ + "'",
                        "check the address");
        }
        if (offset_ + received_ > 0) {
            throw Error("fetching '" + url_ + "' stopped at " + inMegabytes(offset_ + received_) +
                            (total_ ? " of " + inMegabytes(*total_) : ""),
                        "call again to go on from there");
        }
        const std::string reason = reason_[0] ? reason_ : curl_easy_strerror(code);
        throw Error("cannot fetch '" + url_ + "' (" + reason + ")", again);
    }

    std::string url_, part_;
    std::optional<std::size_t> expected_, total_;
    std::size_t offset_, received_ = 0;
    std::string refused_, remedy_ = "make room and call again";
    char reason_[CURL_ERROR_SIZE] = "";
    std::unique_ptr<CURL, void (*)(CURL*)> curl_;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
    Progress progress_;
};

void checkSize(const std::string& url, const std::string& part,
               std::optional<std::size_t> expected) {
    if (!expected || fs::file_size(part) == *expected) return;
    const std::size_t got = fs::file_size(part);
    fs::remove(part);
    throw Error("'" + url + "' has " + std::to_string(got) + " bytes where " +
                    std::to_string(*expected) + " are expected",
                "check the address, or correct the table");
}

}  // namespace

void download(const std::string& url, const std::string& path, std::optional<std::size_t> bytes) {
    if (fs::exists(path)) return;
    const std::string part = path + ".part";
    const bool whole = bytes && fs::exists(part) && fs::file_size(part) == *bytes;
    if (!whole && !Transfer(url, part, bytes).run()) {
        fs::remove(part);
        Transfer(url, part, bytes).run();
    }
    checkSize(url, part, bytes);
    fs::rename(part, path);
}

}  // namespace rgbd_graphslam
