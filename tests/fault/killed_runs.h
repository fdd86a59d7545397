/** Programs that are killed, and what they leave in their output folder. */
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "../support/run_program.h"
#include "../support/textured_room.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"

namespace rgbd_graphslam {

inline std::string inQuotes(const std::string& text) {
    return "'" + text + "'";
}

/** The frames of the round trip from one to before another. */
inline void writeFilm(const std::string& rawlog, int from, int to, double turn_rad) {
    const auto film = filmRoundTrip(to, turn_rad);
    writeRawlog(rawlog, RawlogStorage::Embedded, [&](RawlogWriter& writer) {
        for (int i = from; i < to; ++i) writer.write(*film[i]);
    });
}

inline void shell(const std::string& command) {
    ASSERT_NE(std::system(command.c_str()), -1);
}

/** \param arguments as typed into a shell */
inline void killAfter(double delay_s, const std::string& program, const std::string& arguments) {
    shell("'" RGBD_BINARY_DIR "/bin/" + program + "' " + arguments + " >/dev/null 2>&1 & sleep " +
          std::to_string(delay_s) + "; kill -KILL $! 2>/dev/null; wait $!");
}

/** Moments at which to kill a run that takes some seconds. */
class KillMoments {
  public:
    explicit KillMoments(double run_s) : run_s_(run_s) {}
    double next() { return run_s_ * static_cast<double>(random_() % 1000) / 1000; }
    /** A run that was finished before: the machine has less to do than when it was timed. */
    void cameTooLate() { run_s_ *= 0.8; }

  private:
    std::mt19937 random_{1};
    double run_s_;
};

/** Bytes by name. */
using Files = std::map<std::string, std::string>;

inline bool isTemporary(const std::string& name) {
    return name.rfind(".tmp-", 0) == 0;
}

/** Those that a run writes for good: no temporary ones, no socket. */
inline Files filesIn(const std::string& folder) {
    Files files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (entry.is_regular_file() && !isTemporary(name)) {
            files[name] = readText(entry.path().string());
        }
    }
    return files;
}

inline std::vector<std::string> temporariesIn(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (isTemporary(name)) names.push_back(name);
    }
    return names;
}

/** Differ from run to run. */
inline const std::set<std::string> files_of_times = {"summary.json", "report.html",
                                                     "frame_times.csv"};

inline bool endsWith(const std::string& text, const std::string& end) {
    return text.size() >= end.size() &&
           text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/** Whether one of those is whole, as its end says; the table has a line of each frame.
 *  \param finished the same file of the finished run */
inline bool isWhole(const std::string& name, const std::string& bytes,
                    const std::string& finished) {
    const auto lines = [](const std::string& text) {
        return std::count(text.begin(), text.end(), '\n');
    };
    if (name == "summary.json") return endsWith(bytes, "\n}\n");
    if (name == "report.html") return endsWith(bytes, "</html>\n");
    return endsWith(bytes, "\n") && lines(bytes) == lines(finished);
}

/** What a run that may have been killed has left. */
class LeftBehind {
  public:
    LeftBehind(Files files, const Files& earlier, const Files& finished)
        : files_(std::move(files)), earlier_(earlier), finished_(finished) {}

    /** Every file is as it was or as the finished run has it, and one that the finished run does
     *  not have goes when all of its own have come. */
    void expectOldOrNew() const {
        for (const auto& file : files_) EXPECT_TRUE(isOld(file) || isNew(file)) << file.first;
        for (const auto& [name, bytes] : earlier_) {
            const bool may_be_gone = finished_.count(name) == 0 && resultsAreNew();
            EXPECT_TRUE(files_.count(name) == 1 || may_be_gone) << name << " is lost";
        }
    }
    /** Files that tell of times included. */
    bool isFinished() const {
        return std::all_of(finished_.begin(), finished_.end(), [&](const auto& file) {
            const auto found = files_.find(file.first);
            return found != files_.end() && isNew(*found) && !isOlder(*found);
        });
    }

  private:
    using File = Files::value_type;

    bool isOld(const File& file) const {
        const auto before = earlier_.find(file.first);
        return before != earlier_.end() && before->second == file.second;
    }
    bool isNew(const File& file) const {
        const auto after = finished_.find(file.first);
        if (after == finished_.end()) return false;
        if (files_of_times.count(file.first))
            return isWhole(file.first, file.second, after->second);
        return after->second == file.second;
    }
    /** And another than the finished run's. */
    bool isOlder(const File& file) const {
        return isOld(file) && finished_.at(file.first) != file.second;
    }
    /** But for those that tell of times. */
    bool resultsAreNew() const {
        return std::all_of(finished_.begin(), finished_.end(), [&](const File& after) {
            const auto found = files_.find(after.first);
            return files_of_times.count(after.first) ||
                   (found != files_.end() && found->second == after.second);
        });
    }

    Files files_;
    const Files &earlier_, &finished_;
};

}  // namespace rgbd_graphslam
