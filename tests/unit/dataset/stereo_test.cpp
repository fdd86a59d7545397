/** Stereo recordings become observations with both calibrations. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <cstdlib>

#include "../../support/problem_of.h"
#include "../../support/stereo_folders.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_info.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/sequence_layout.h"
#include "rgbd_graphslam/dataset/stereo_import.h"

namespace rgbd_graphslam {
namespace {

namespace fs = std::filesystem;
using mrpt::img::DistortionModel;
using mrpt::obs::CObservationIMU;
using mrpt::obs::CObservationRobotPose;
using mrpt::obs::CObservationStereoImages;
using ::testing::Contains;
using ::testing::HasSubstr;

class Stereo : public ::testing::Test {
  protected:
    void SetUp() override { setVerbosity(Verbosity::Quiet); }

    StereoReport import(const ImportOptions& options = {}) const {
        EXPECT_FALSE(layoutOf(folder_ / "s"));
        EXPECT_TRUE(isStereoFolder(folder_ / "s"));
        return importStereo(readStereoFolder(folder_ / "s", 10), rawlog(), options);
    }

    template <class Observation>
    std::vector<typename Observation::Ptr> all() const {
        std::vector<typename Observation::Ptr> found;
        RawlogReader reader(rawlog());
        while (const auto observation = reader.next()) {
            const auto one = std::dynamic_pointer_cast<Observation>(observation);
            if (one) found.push_back(one);
        }
        return found;
    }

    std::string problem() const {
        return problemOf([&] { readStereoFolder(folder_ / "s", 10); });
    }

    /** The images of all pairs are those of the folder. */
    void expectImages(int left, int right) const {
        const auto pairs = all<CObservationStereoImages>();
        ASSERT_EQ(pairs.size(), std::size_t(stereo_folder::pairs));
        for (int i = 0; i < stereo_folder::pairs; ++i) {
            const CObservationStereoImages& pair = *pairs[i];
            EXPECT_TRUE(pair.hasImageRight);
            EXPECT_EQ(
                cv::norm(pair.imageLeft.asCvMatRef(), stereo_folder::gray(i, left), cv::NORM_L1),
                0);
            EXPECT_EQ(
                cv::norm(pair.imageRight.asCvMatRef(), stereo_folder::gray(i, right), cv::NORM_L1),
                0);
        }
    }

    std::string rawlog() const { return folder_ / "s.rawlog"; }
    TestFolder folder_;
};

TEST_F(Stereo, euroc) {
    stereo_folder::makeEuroc(folder_, "s");
    const StereoReport report = import();
    EXPECT_EQ(report.pairs, 4u);
    EXPECT_EQ(report.imu, 4u);
    EXPECT_EQ(report.truth, 4u);
    EXPECT_THAT(report.notes, Contains(HasSubstr("left out: leica0")));
    expectImages(0, 1);
    const auto pair = all<CObservationStereoImages>().at(1);
    EXPECT_NEAR(toSeconds(pair->timestamp), 1403636579.813556, 1e-6);
    EXPECT_EQ(pair->leftCamera.distortion, DistortionModel::plumb_bob);
    EXPECT_EQ(pair->leftCamera.k1(), -0.2);
    EXPECT_EQ(pair->leftCamera.p2(), -0.002);
    EXPECT_EQ(pair->leftCamera.fy(), 31);
    // x of the body is the camera's -y.
    const SE3 T_body_left = toSE3(mrpt::poses::CPose3D(pair->cameraPose));
    EXPECT_LT((T_body_left.t - Eigen::Vector3d(0.1, 0.02, 0.03)).norm(), 1e-9);
    EXPECT_LT((T_body_left.R * Eigen::Vector3d::UnitY() + Eigen::Vector3d::UnitX()).norm(), 1e-9);
    const auto imu = all<CObservationIMU>().at(0);
    EXPECT_NEAR(imu->sensorPose.x(), 0.5, 1e-9);
    EXPECT_EQ(imu->get(mrpt::obs::IMU_WX), 0.1);
    EXPECT_EQ(imu->get(mrpt::obs::IMU_Z_ACC), 9.8);
    const auto pose = all<CObservationRobotPose>().at(2);  // of the body
    EXPECT_NEAR(pose->pose.mean.x(), 1.2, 1e-9);
    EXPECT_NEAR(pose->pose.mean.yaw(), 0, 1e-9);
}

/** sensor_pose says where the left camera is on the body, whose truth the folder has. */
TEST_F(Stereo, aCalibrationThatIsGivenReplacesTheFolders) {
    stereo_folder::makeEuroc(folder_, "s");
    std::string ini = stereo_folder::stereoIni();
    ini.insert(ini.find("[CAMERA_PARAMS_RIGHT]"), "sensor_pose = [1 0 0 0 0 0]\n");
    folder_.write("given.ini", ini);
    importStereo(readStereoFolder(folder_ / "s", 10, folder_ / "given.ini"), rawlog(), {});
    const auto pair = all<CObservationStereoImages>().at(0);
    EXPECT_NEAR(pair->rightCameraPose.x(), 0.537, 1e-9);
    EXPECT_NEAR(pair->cameraPose.x(), 1, 1e-9);
    EXPECT_NEAR(all<CObservationRobotPose>().at(2)->pose.mean.x(), 1.2, 1e-9);
}

TEST_F(Stereo, fisheyesOfTumVi) {
    stereo_folder::makeTumVi(folder_, "s");
    const StereoReport report = import();
    EXPECT_EQ(report.truth, 4u);
    const auto pair = all<CObservationStereoImages>().at(0);
    for (const auto* camera : {&pair->leftCamera, &pair->rightCamera}) {
        EXPECT_EQ(camera->distortion, DistortionModel::kannala_brandt);
        EXPECT_EQ(camera->k1(), 0.0034);
        EXPECT_EQ(camera->k4(), 0.0002);
    }
    EXPECT_NEAR(pair->cameraPose.x(), -0.25, 1e-9);
    EXPECT_NEAR(pair->rightCameraPose.x(), 0.101, 1e-9);
}

TEST_F(Stereo, kittiGrayAndColor) {
    stereo_folder::makeKitti(folder_, "s", 0);
    EXPECT_EQ(import().pairs, 4u);
    expectImages(0, 1);
    const auto gray = all<CObservationStereoImages>().at(3);
    EXPECT_NEAR(gray->rightCameraPose.x(), 16.1 / 30, 1e-9);
    EXPECT_EQ(gray->leftCamera.ncols, 32u);
    EXPECT_NEAR(toSeconds(gray->timestamp), 0.3, 1e-6);
    const SE3 T_world_base =
        toSE3(mrpt::poses::CPose3D(all<CObservationRobotPose>()[3]->pose.mean));
    EXPECT_LT(((T_world_base * T_optical_from_mrpt.inverse()).t - Eigen::Vector3d(0, 0, 3)).norm(),
              1e-9);

    fs::remove_all(folder_ / "s");
    stereo_folder::makeKitti(folder_, "s", 2);
    import();
    expectImages(2, 3);
    const auto color = all<CObservationStereoImages>().at(0);
    EXPECT_NEAR(color->rightCameraPose.x(), 16.2 / 30, 1e-9);
    // image_2's camera is 0.06 m to the left of image_0's, of which the poses are.
    const SE3 T_world_robot =
        toSE3(mrpt::poses::CPose3D(all<CObservationRobotPose>().at(1)->pose.mean));
    EXPECT_LT((T_world_robot.t - Eigen::Vector3d(-0.06, 0, 1)).norm(), 1e-9);
}

TEST_F(Stereo, leftAndRight) {
    stereo_folder::makeLeftRight(folder_, "s");
    ImportOptions options;
    options.storage = RawlogStorage::Compact;
    const StereoReport report = import(options);
    EXPECT_EQ(report.pairs, 4u);
    EXPECT_EQ(report.truth, 2u);
    EXPECT_LT(fs::file_size(rawlog()), 8000u) << "images are beside the rawlog";
    EXPECT_NEAR(all<CObservationStereoImages>().at(0)->rightCameraPose.x(), 0.537, 1e-9);
    options.storage = RawlogStorage::Embedded;
    import(options);
    expectImages(0, 1);
}

TEST_F(Stereo, whatIsMissingOrWrongIsNamed) {
    stereo_folder::makeEuroc(folder_, "s");
    const std::string yaml = "s/mav0/cam1/sensor.yaml";
    folder_.write(yaml, stereo_folder::sensorYaml(0.1, "omni"));
    EXPECT_THAT(problem(), HasSubstr("cam1/sensor.yaml': the lens model 'omni'"));
    folder_.write(yaml, stereo_folder::sensorYaml(0.1, "radtan", "[0.1]"));
    EXPECT_THAT(problem(), HasSubstr("must have 4 numbers"));
    fs::remove(folder_ / yaml);
    EXPECT_THAT(problem(), HasSubstr("has no calibration"));
    folder_.write(yaml, stereo_folder::sensorYaml(0.1));
    folder_.write("s/mav0/imu0/data.csv", "1403636579763555584,0.1,0.2\n");
    EXPECT_THAT(problem(), HasSubstr("imu0/data.csv:1: too few values"));

    fs::remove_all(folder_ / "s");
    stereo_folder::makeKitti(folder_, "s", 0);
    folder_.write("s/calib.txt", "P0: 30 0 15.5 0 0 30 11.5 0 0 0 1 0\nP1: 30 0 15.5\n");
    EXPECT_THAT(problem(), HasSubstr("calib.txt:2: too few values"));
    folder_.write("s/calib.txt", "P0: 30 0 15.5 0 0 30 11.5 0 0 0 1 0\n");
    EXPECT_THAT(problem(), HasSubstr("has no P0 and P1"));
}

TEST_F(Stereo, doubtfulCalibrationsAreRefusedWhenStrict) {
    stereo_folder::makeLeftRight(folder_, "s");
    std::string ini = stereo_folder::stereoIni();
    ini.replace(ini.find("0.537"), 5, "537");
    folder_.write("s/camera.ini", ini);
    ImportOptions options;
    options.strict = true;
    EXPECT_THAT(problemOf([&] { import(options); }), HasSubstr("baseline not in meters"));
    ini.replace(ini.find("resolution = [32 24]"), 20, "resolution = [32 25]");
    folder_.write("s/camera.ini", ini);
    EXPECT_THAT(problemOf([&] { import(); }), HasSubstr("32x24 pixels, its calibration is for"));
}

TEST_F(Stereo, damagedImagesAreLeftOutWhenAsked) {
    stereo_folder::makeLeftRight(folder_, "s");
    cutFile(folder_ / "s/right/2.png", 0.5);
    EXPECT_THAT(problemOf([&] { import(); }), HasSubstr("right/2.png' is cut off"));
    ImportOptions options;
    options.skip_damaged = true;
    const StereoReport report = import(options);
    EXPECT_EQ(report.pairs, 3u);
    EXPECT_EQ(report.damaged, 1u);
}

TEST_F(Stereo, clipOfAStreet) {
    const char* data = std::getenv("RGBD_DATA");
    const fs::path clip =
        fs::path(data ? data : RGBD_SOURCE_DIR "/../shared/data") / "street-stereo-51";
    if (!fs::exists(clip)) GTEST_SKIP() << "SKIPPED: " << clip << " is absent";
    const StereoReport report = importStereo(readStereoFolder(clip, 10), rawlog(), {});
    EXPECT_EQ(report.pairs, 51u);
    EXPECT_GT(report.truth, 50u);
    const auto pair = all<CObservationStereoImages>().at(50);
    EXPECT_NEAR(pair->rightCameraPose.x(), 0.537151, 1e-9);
    EXPECT_EQ(pair->imageRight.getWidth(), 1226u);
    EXPECT_FALSE(pair->imageRight.isColor());
    EXPECT_EQ(truthOf(rawlog()).size(), report.truth);
}

}  // namespace
}  // namespace rgbd_graphslam
