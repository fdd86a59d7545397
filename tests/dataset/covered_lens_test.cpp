/** A robot's lens is covered while it drives along walls and a floor that repeat every 1.6 m. */
#include <gtest/gtest.h>

#include <ostream>
#include <random>

#include "../support/synthetic_film.h"
#include "../support/tum_folder.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/job/slam_job.h"
#include "rgbd_graphslam/metrics/ate.h"

namespace rgbd_graphslam {
namespace {

constexpr int width = 320, height = 240;
constexpr double units_per_m = 5000;

enum class Cover { Black, Flat };

struct Recipe {
    Cover cover;
    int first, frames;
    double max_error_m;
};

std::ostream& operator<<(std::ostream& out, const Recipe& recipe) {
    return out << (recipe.cover == Cover::Black ? "black" : "flat") << " from " << recipe.first
               << " for " << recipe.frames;
}

/** 0.03 m, and 2 % of the way driven blind at 0.65 m/s. */
const Recipe recipes[] = {{Cover::Black, 60, 30, 0.043},
                          {Cover::Black, 90, 60, 0.056},
                          {Cover::Flat, 60, 30, 0.043},
                          {Cover::Flat, 110, 45, 0.05}};

/** Gray 110; without depth, or 1 m away with the noise of a sensor. */
void putCover(Cover cover, unsigned frame, mrpt::obs::CObservation3DRangeScan& rgbd) {
    cv::Mat color(height, width, CV_8UC3, cv::Scalar::all(110));
    cv::Mat depth = cv::Mat::zeros(height, width, CV_16UC1);
    if (cover == Cover::Flat) {
        std::mt19937 random(frame);
        for (int i = 0; i < width * height; ++i) {
            const int gray = 108 + static_cast<int>(random() % 5);
            color.at<cv::Vec3b>(i / width, i % width) = cv::Vec3b::all(gray);
            depth.at<std::uint16_t>(i / width, i % width) =
                static_cast<std::uint16_t>(units_per_m - 8 + random() % 17);
        }
    }
    setColor(rgbd, color);
    setDepth(rgbd, depth);
}

class CoveredLens : public testing::TestWithParam<Recipe> {
  protected:
    void cover(const std::string& from) {
        const Recipe& recipe = GetParam();
        writeRawlog(job_.rawlog, RawlogStorage::Embedded, [&](RawlogWriter& writer) {
            RawlogReader reader(from);
            int frame = -1;
            while (const auto entry = reader.next()) {
                auto rgbd = std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(entry);
                if (rgbd && ++frame >= recipe.first && frame < recipe.first + recipe.frames) {
                    putCover(recipe.cover, frame, *rgbd);
                }
                writer.write(*entry);
            }
        });
    }

    TestFolder folder_;
    SlamJob job_;
};

TEST_P(CoveredLens, wheelsCarryTheCameraToWhereItIsFoundAgain) {
    setVerbosity(Verbosity::Quiet);
    const std::string film = filmOf("corridor-loop", "--frames 220 --size 320x240");
    job_.rawlog = folder_ / "covered.rawlog";
    job_.out_folder = folder_ / "out";
    job_.options.run.dense_maps = false;
    cover(film + ".rawlog");
    const JobReport report = runSlamJob(job_);
    EXPECT_EQ(report.lost, 0u);
    EXPECT_GE(report.dead_reckoned, static_cast<std::size_t>(GetParam().frames));
    const AteResult ate = evaluateAte(readTumTrajectory(folder_ / "out/trajectory.txt"),
                                      readTumTrajectory(film + "/groundtruth.txt"));
    EXPECT_EQ(ate.pairs.size(), report.frames);
    EXPECT_LT(ate.translation_m.max, GetParam().max_error_m);
    EXPECT_LT(ate.translation_m.rmse, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Recipes, CoveredLens, testing::ValuesIn(recipes));

}  // namespace
}  // namespace rgbd_graphslam
