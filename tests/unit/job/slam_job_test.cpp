#include "rgbd_graphslam/job/slam_job.h"

#include <gtest/gtest.h>
#include <mrpt/graphs/CNetworkOfPoses.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "../../support/textured_room.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/job/sparse_map_file.h"
#include "rgbd_graphslam/mapping/run_folder.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

constexpr double turn_rad = 0.02;
constexpr int frames = 30, whole_round = 330;

class JobOnARawlog : public testing::Test {
  protected:
    JobOnARawlog() {
        setVerbosity(Verbosity::Quiet);
        job_.rawlog = folder_ / "a.rawlog";
        job_.out_folder = folder_ / "out";
        job_.options.run.dense_maps = false;
        write(filmRoundTrip(frames, turn_rad));
    }
    ~JobOnARawlog() override { setVerbosity(Verbosity::Normal); }

    /** With ground truth.
     *  \param first frame of the round trip that the film begins with
     *  \param truth_turn_rad in each frame */
    void write(const std::vector<mrpt::obs::CObservation3DRangeScan::Ptr>& film, int first = 0,
               double truth_turn_rad = turn_rad) const {
        writeRawlog(job_.rawlog, RawlogStorage::Embedded, [&](RawlogWriter& writer) {
            for (std::size_t i = 0; i < film.size(); ++i) {
                mrpt::obs::CObservationRobotPose truth;
                truth.sensorLabel = ground_truth_label;
                truth.timestamp = film[i]->timestamp;
                truth.pose.mean = toCPose3D(roundTrip(first + static_cast<int>(i), truth_turn_rad));
                writer.write(truth);
                writer.write(*film[i]);
            }
        });
    }
    /** Maps the room, then goes on with a film that shows some of it and more. */
    JobReport runAgain(MapUse use) {
        runSlamJob(job_);
        const auto film = filmRoundTrip(later_first + later_frames, turn_rad);
        job_.rawlog = folder_ / "b.rawlog";
        write({film.begin() + later_first, film.end()}, later_first);
        job_.map_folder = job_.out_folder;
        job_.out_folder = folder_ / "out2";
        job_.map_use = use;
        return runSlamJob(job_);
    }
    /** Errors of the later film's poses, seen in the world of the first run. */
    double largestErrorInTheFirstWorld() const {
        const auto first = readTumTrajectory(folder_ / "out/trajectory.txt").front().T_world_cam;
        const SE3 T_base_cam = T_optical_from_mrpt.inverse();
        const SE3 T_world_room = first * (roundTrip(0, turn_rad) * T_base_cam).inverse();
        double largest = 0;
        int i = later_first;
        for (const auto& [stamp, T] : readTumTrajectory(folder_ / "out2/trajectory.txt")) {
            const SE3 truth = T_world_room * roundTrip(i++, turn_rad) * T_base_cam;
            largest = std::max(largest, (T.t - truth.t).norm());
        }
        return largest;
    }
    /** Where the map begins in map.sparse, behind header and hash. */
    static constexpr std::size_t map_content = 44;
    static constexpr int later_first = 15, later_frames = 30;
    std::string output(const std::string& name) const {
        return readText((fs::path(job_.out_folder) / name).string());
    }
    static std::size_t linesOf(const std::string& text) {
        return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    }

    TestFolder folder_;
    SlamJob job_;
};

TEST_F(JobOnARawlog, writesAFolderThatDescribesItself) {
    const JobReport report = runSlamJob(job_);
    EXPECT_EQ(report.tracked, static_cast<std::size_t>(frames));
    ASSERT_TRUE(report.ate_rmse_m);
    EXPECT_LT(*report.ate_rmse_m, 0.01);
    EXPECT_NEAR(report.path_m, 0.5 * turn_rad * (frames - 1), 0.05);

    EXPECT_EQ(linesOf(output("trajectory.txt")), 1u + frames);
    EXPECT_EQ(linesOf(output("keyframes.txt")), 1 + report.keyframes);
    EXPECT_EQ(linesOf(output("frames.csv")), 1u + frames);
    EXPECT_EQ(linesOf(output("frame_times.csv")), 1u + frames);
    const auto summary = nlohmann::json::parse(output("summary.json"));
    EXPECT_EQ(summary["tracked"], frames);
    EXPECT_EQ(summary["rawlog"], job_.rawlog);
    JobOptions written;
    IniFile::fromFile(job_.out_folder + "/config.ini").load(written.all());
    EXPECT_EQ(summary["config_hash"], configHash(written));
    EXPECT_EQ(summary["ate"]["rmse_m"], *report.ate_rmse_m);
    EXPECT_EQ(summary["stages"]["extract"]["calls"], frames);
    EXPECT_TRUE(fs::exists(job_.out_folder + "/graph.graph"));
}

TEST_F(JobOnARawlog, loopsAreJudgedByTheTruth) {
    const auto film = filmRoundTrip(whole_round, turn_rad);
    write(film);
    const JobReport right = runSlamJob(job_);
    ASSERT_FALSE(right.loops.empty());
    for (const ReportedLoop& loop : right.loops) EXPECT_LT(loop.error_m.value(), 0.05);
    EXPECT_EQ(right.false_loops, 0u);
    const auto summary = nlohmann::json::parse(output("summary.json"));
    EXPECT_EQ(summary["loop_edges"][0][3], *right.loops[0].error_m);
    EXPECT_EQ(readRunFolder(job_.out_folder, "").loops.size(), right.loops.size());

    write(film, 0, turn_rad / 2);
    const JobReport wrong = runSlamJob(job_);
    EXPECT_EQ(wrong.false_loops, wrong.loops.size());
    EXPECT_GT(wrong.loops[0].error_m.value(), 0.9);  // the truth ends on the other side
    EXPECT_EQ(nlohmann::json::parse(output("summary.json"))["false_loops"], wrong.loops.size());
}

TEST_F(JobOnARawlog, truthIsWrittenWhereThePathLies) {
    runSlamJob(job_);
    const Trajectory truth = readTumTrajectory(job_.out_folder + "/truth.txt");
    const Trajectory path = readTumTrajectory(job_.out_folder + "/trajectory.txt");
    ASSERT_EQ(truth.size(), path.size());
    for (std::size_t i = 0; i < path.size(); ++i) {
        EXPECT_EQ(truth[i].stamp_s, path[i].stamp_s);
        EXPECT_LT((truth[i].T_world_cam.t - path[i].T_world_cam.t).norm(), 0.02);
        EXPECT_LT((truth[i].T_world_cam.R - path[i].T_world_cam.R).norm(), 0.05);
    }
}

TEST_F(JobOnARawlog, posesOfAnEarlierRunGoWhereThisOneHasNone) {
    runSlamJob(job_);
    ASSERT_TRUE(fs::exists(job_.out_folder + "/truth.txt"));
    folder_.write("out/keyframes_before_loops.txt", output("keyframes.txt"));
    const auto film = filmRoundTrip(frames, turn_rad);
    writeRawlog(job_.rawlog, RawlogStorage::Embedded, [&](RawlogWriter& writer) {
        for (const auto& frame : film) writer.write(*frame);
    });
    runSlamJob(job_);
    EXPECT_FALSE(fs::exists(job_.out_folder + "/truth.txt"));
    EXPECT_FALSE(fs::exists(job_.out_folder + "/keyframes_before_loops.txt"));
}

TEST_F(JobOnARawlog, reportTellsOfTheRunAndItsWarnings) {
    auto film = filmRoundTrip(frames, turn_rad);
    film[10]->timestamp = film[9]->timestamp;
    write(film);
    runSlamJob(job_);
    const auto summary = nlohmann::json::parse(output("summary.json"));
    ASSERT_FALSE(summary["warnings"].empty());
    EXPECT_NE(summary["warnings"][0].get<std::string>().find("not later"), std::string::npos);
    const std::string page = output("report.html");
    EXPECT_NE(page.find("is not later than the one before"), std::string::npos);
    EXPECT_NE(page.find("29 / 29"), std::string::npos);
    EXPECT_NE(page.find("data:image/jpeg;base64,"), std::string::npos);  // of keyframes
}

TEST_F(JobOnARawlog, effectiveConfigRunsTheSameJobAgain) {
    job_.options.slam.tracker.min_inliers = 30;
    job_.options.slam.features.depth_max_m = 8;
    runSlamJob(job_);
    JobOptions read;
    IniFile::fromFile(job_.out_folder + "/config.ini").load(read.all());
    EXPECT_EQ(configHash(read), configHash(job_.options));
}

TEST_F(JobOnARawlog, trajectoryDoesNotDependOnThreads) {
    job_.options.run.threads = 1;
    runSlamJob(job_);
    const std::string alone = output("trajectory.txt"), graph = output("graph.graph");
    for (const int threads : {2, 4}) {
        job_.options.run.threads = threads;
        runSlamJob(job_);
        EXPECT_EQ(output("trajectory.txt"), alone);
        EXPECT_EQ(output("graph.graph"), graph);
    }
}

TEST_F(JobOnARawlog, framesThatGoBackAreLeftOutAndCounted) {
    auto film = filmRoundTrip(frames, turn_rad);
    film[10]->timestamp = film[9]->timestamp;
    film[20]->timestamp = film[5]->timestamp;
    write(film);
    const JobReport report = runSlamJob(job_);
    EXPECT_EQ(report.out_of_order, 2u);
    EXPECT_EQ(report.frames, static_cast<std::size_t>(frames - 2));
    EXPECT_EQ(report.lost, 0u);
}

TEST_F(JobOnARawlog, cutRawlogGivesWhatCameBefore) {
    cutFile(job_.rawlog, 0.55);
    const JobReport report = runSlamJob(job_);
    EXPECT_NE(report.damage.find("cut off"), std::string::npos);
    EXPECT_GE(report.frames, static_cast<std::size_t>(frames / 2 - 1));
    EXPECT_EQ(linesOf(output("trajectory.txt")), 1 + report.frames);
}

TEST_F(JobOnARawlog, maxFramesStopsEarly) {
    job_.options.run.max_frames = 7;
    const JobReport report = runSlamJob(job_);
    EXPECT_EQ(report.frames, 7u);
    EXPECT_TRUE(report.damage.empty());
}

TEST_F(JobOnARawlog, limitsEndTheTrackingAndTheMapIsWritten) {
    const std::size_t unlimited = runSlamJob(job_).keyframes;
    ASSERT_GT(unlimited, 2u);
    job_.options.run.max_keyframes = 2;
    const JobReport few = runSlamJob(job_);
    EXPECT_EQ(few.keyframes, 2u);
    EXPECT_LT(few.frames, std::size_t{frames});
    EXPECT_NE(few.limit.find("max_keyframes = 2"), std::string::npos) << few.limit;
    EXPECT_EQ(readSparseMap(job_.out_folder + "/map.sparse").snapshot.keyframes.size(), 2u);

    job_.options.run.max_keyframes = 0;
    job_.options.run.max_memory_mb = 1;
    EXPECT_NE(runSlamJob(job_).limit.find("max_memory_mb = 1"), std::string::npos);
}

TEST_F(JobOnARawlog, nothingToSeeIsAnErrorThatSaysSo) {
    auto film = filmRoundTrip(3, turn_rad);
    for (auto& frame : film) setColor(*frame, cv::Mat(240, 320, CV_8UC3, cv::Scalar::all(90)));
    write(film);
    try {
        runSlamJob(job_);
        FAIL();
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("could start a map"), std::string::npos) << e.what();
    }
    EXPECT_EQ(linesOf(output("frames.csv")), 4u);
}

/** Blackens the color images [first, last). */
void cover(std::vector<mrpt::obs::CObservation3DRangeScan::Ptr>& film, int first, int last,
           bool depth_too) {
    for (int i = first; i < last; ++i) {
        setColor(*film[i], cv::Mat(240, 320, CV_8UC3, cv::Scalar::all(0)));
        if (depth_too) setDepth(*film[i], cv::Mat(240, 320, CV_16UC1, cv::Scalar::all(0)));
    }
}

TEST_F(JobOnARawlog, coveredFramesAreTiedInByOdometry) {
    auto film = filmRoundTrip(frames, turn_rad);
    cover(film, 10, 18, true);
    writeRawlog(job_.rawlog, RawlogStorage::Embedded, [&](RawlogWriter& writer) {
        for (int i = 0; i < frames; ++i) {
            mrpt::obs::CObservationOdometry odometry;
            odometry.timestamp = film[i]->timestamp;
            const SE3 pose = roundTrip(i, turn_rad);
            odometry.odometry = {pose.t.x(), pose.t.y(), i * turn_rad};
            writer.write(odometry);
            writer.write(*film[i]);
        }
    });
    const JobReport report = runSlamJob(job_);
    EXPECT_EQ(report.dead_reckoned, 8u);
    EXPECT_EQ(report.lost, 0u);
    EXPECT_EQ(linesOf(output("trajectory.txt")), 1u + frames);
    const Trajectory path = readTumTrajectory(job_.out_folder + "/trajectory.txt");
    const SE3 T_base_cam = T_optical_from_mrpt.inverse();
    const SE3 T_world_room = path[0].T_world_cam * (roundTrip(0, turn_rad) * T_base_cam).inverse();
    for (int i = 0; i < frames; ++i) {
        const SE3 truth = T_world_room * roundTrip(i, turn_rad) * T_base_cam;
        EXPECT_LT((path[i].T_world_cam.t - truth.t).norm(), 0.02) << i;
    }
    EXPECT_NE(output("frames.csv").find(",dead_reckoned,"), std::string::npos);
}

/** Covered, and then where nothing is known: poses without a common world are not mixed. */
TEST_F(JobOnARawlog, partsThatNothingJoinsAreKeptApart) {
    job_.options.slam.recovery.new_submap_after = 3;
    job_.options.run.dense_maps = true;
    constexpr int opposite = 157, later = 20;  // half a round away
    auto film = filmRoundTrip(opposite + later, turn_rad);
    film.erase(film.begin() + frames, film.begin() + opposite);
    for (int i = 0; i < later; ++i) {
        film[frames + i]->timestamp = toMrptTime(room_start_s + (frames + 40 + i) * room_period_s);
    }
    cover(film, frames - 2, frames, true);
    write(film);
    const JobReport report = runSlamJob(job_);
    EXPECT_EQ(report.tracked, static_cast<std::size_t>(frames - 2 + later - 2));
    EXPECT_EQ(report.lost, 4u);
    EXPECT_EQ(report.disconnected, static_cast<std::size_t>(later - 2));
    EXPECT_EQ(linesOf(output("trajectory.txt")), 1u + frames - 2);
    EXPECT_EQ(linesOf(output("keyframes.txt")), 1 + report.keyframes);
    const auto summary = nlohmann::json::parse(output("summary.json"));
    EXPECT_EQ(summary["disconnected"], later - 2);
    ASSERT_FALSE(summary["disconnected_keyframes"].empty());
    EXPECT_EQ(readRunFolder(job_.out_folder, "").disconnected, report.disconnected_keyframes);
}

TEST_F(JobOnARawlog, laterRunIsLocalizedInTheMap) {
    const JobReport report = runAgain(MapUse::Localize);
    EXPECT_GE(report.tracked + report.recovered, 20u);
    EXPECT_EQ(report.recovered, 1u);
    EXPECT_LT(largestErrorInTheFirstWorld(), 0.02);
    EXPECT_FALSE(fs::exists(job_.out_folder + "/keyframes.txt"));
    EXPECT_FALSE(fs::exists(job_.out_folder + "/map.sparse"));
    const auto summary = nlohmann::json::parse(output("summary.json"));
    EXPECT_EQ(summary["map"]["use"], "localize");
    EXPECT_EQ(summary["false_loops"], 0);
}

TEST_F(JobOnARawlog, aMapIsNotLocalizedInOverItself) {
    runSlamJob(job_);
    const std::string trajectory = output("trajectory.txt");
    job_.map_folder = job_.out_folder + "/../out";
    EXPECT_THROW(runSlamJob(job_), Error);
    EXPECT_EQ(output("trajectory.txt"), trajectory);
    job_.map_use = MapUse::Extend;
    EXPECT_EQ(runSlamJob(job_).frames, static_cast<std::size_t>(frames)) << "grows in its place";
}

TEST_F(JobOnARawlog, laterRunExtendsTheMap) {
    job_.options.run.dense_maps = true;
    const JobReport report = runAgain(MapUse::Extend);
    EXPECT_EQ(report.lost, 0u);
    EXPECT_LT(largestErrorInTheFirstWorld(), 0.02);
    ASSERT_EQ(report.earlier.size(), 1u);
    EXPECT_EQ(report.earlier[0].rawlog, folder_ / "a.rawlog");
    EXPECT_GT(report.keyframes, report.earlier[0].keyframes);
    EXPECT_EQ(linesOf(output("keyframes.txt")), 1 + report.keyframes);
    EXPECT_TRUE(fs::exists(job_.out_folder + "/points.ply"));
    const SparseMap map = readSparseMap(job_.out_folder + "/map.sparse");
    ASSERT_EQ(map.sessions.size(), 2u);
    EXPECT_EQ(map.sessions[1].rawlog, job_.rawlog);
    mrpt::graphs::CNetworkOfPoses3DInf graph;
    graph.loadFromTextFile(job_.out_folder + "/graph.graph");
    EXPECT_EQ(graph.nodes.size(), report.keyframes);
}

TEST_F(JobOnARawlog, extendingDoesNotDependOnThreads) {
    job_.options.run.threads = 1;
    runAgain(MapUse::Extend);
    const std::string alone = output("trajectory.txt"), map = output("map.sparse");
    for (const int threads : {2, 4}) {
        job_.options.run.threads = threads;
        runSlamJob(job_);
        EXPECT_EQ(output("trajectory.txt"), alone);
        // The hash of the settings differs, as they name the threads.
        EXPECT_TRUE(output("map.sparse").substr(map_content) == map.substr(map_content));
    }
}

TEST_F(JobOnARawlog, denseMapsAreMade) {
    job_.options.run.dense_maps = true;
    runSlamJob(job_);
    for (const char* name : {"points.ply", "octree.bt", "octree.ot", "grid.gridmap.gz",
                             "map.simplemap", "scene.3Dscene"}) {
        EXPECT_TRUE(fs::exists(job_.out_folder + "/" + name)) << name;
    }
}

}  // namespace
}  // namespace rgbd_graphslam
