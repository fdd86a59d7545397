/** Two cameras of one rig on a synthetic sequence, one of them covered for a while. */
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../support/synthetic_film.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"

namespace rgbd_graphslam {
namespace {
using mrpt::obs::CObservation;
using mrpt::obs::CObservation3DRangeScan;

constexpr int frames = 90, covered_from = 40, covered_frames = 25;
const std::string settings = "--frames 90 --size 320x240";

std::vector<CObservation::Ptr> entriesOf(const std::string& rawlog) {
    RawlogReader reader(rawlog);
    std::vector<CObservation::Ptr> entries;
    while (const auto entry = reader.next()) entries.push_back(entry);
    return entries;
}

void cover(CObservation3DRangeScan& frame) {
    setColor(frame, cv::Mat(240, 320, CV_8UC3, cv::Scalar(4, 3, 5)));
    setDepth(frame, cv::Mat::zeros(240, 320, CV_16UC1));
}

/** All of the first film and the frames of the second, in order of time. */
void writeRig(const std::string& first, const std::string& second, const std::string& rawlog) {
    auto entries = entriesOf(first);
    int frame = 0;
    for (const auto& entry : entries) {
        auto rgbd = std::dynamic_pointer_cast<CObservation3DRangeScan>(entry);
        if (!rgbd) continue;
        const bool is_covered = frame >= covered_from && frame < covered_from + covered_frames;
        if (is_covered) cover(*rgbd);
        ++frame;
    }
    for (const auto& entry : entriesOf(second)) {
        auto rgbd = std::dynamic_pointer_cast<CObservation3DRangeScan>(entry);
        if (!rgbd) continue;
        rgbd->sensorLabel = "SIDE";
        entries.push_back(rgbd);
    }
    std::stable_sort(entries.begin(), entries.end(),
                     [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
    writeRawlog(rawlog, RawlogStorage::Embedded, [&](RawlogWriter& writer) {
        for (const auto& entry : entries) writer.write(*entry);
    });
}

struct RigResult {
    int tracked = 0;
    double ate_m = 1;
};

RigResult slamOn(const std::string& rawlog, const std::string& options) {
    const TestFolder out;
    runOrFail("rgbd-slam", "'" RGBD_SOURCE_DIR "/ini/default.ini' '" + rawlog + "' -o '" +
                               out / "run" + "' -q --no-maps" + options);
    const auto summary = nlohmann::json::parse(std::ifstream(out / "run/summary.json"));
    RigResult result{summary["tracked"], summary["ate"]["rmse_m"]};
    std::printf("%s: %d tracked, ATE %.4f m\n", options.c_str(), result.tracked, result.ate_m);
    return result;
}

TEST(SlamOfARig, isNearlyAsExactAsOneCameraThoughTheOtherIsCovered) {
    const std::string ahead = filmOf("office", settings);
    const std::string aside = filmOf("office", settings + " --mount 0 -0.2 0 -70 0 0");
    if (HasFatalFailure()) return;
    const TestFolder folder;
    writeRig(ahead + ".rawlog", aside + ".rawlog", folder / "rig.rawlog");
    const RigResult alone = slamOn(ahead + ".rawlog", "");
    const RigResult both = slamOn(folder / "rig.rawlog", "");
    const RigResult covered = slamOn(folder / "rig.rawlog", " --sensor RGBD");
    EXPECT_EQ(both.tracked, frames);
    // Not covered at all, the first camera alone is a millimeter better.
    EXPECT_LE(both.ate_m, alone.ate_m + 0.0015);
    EXPECT_LE(both.ate_m, covered.ate_m);
}

}  // namespace
}  // namespace rgbd_graphslam
