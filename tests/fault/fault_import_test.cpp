/** Bad sequences and rawlogs end in one clear line and an exit code, never in half a file. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../support/run_program.h"
#include "rgbd_graphslam/dataset/rawlog_info.h"

namespace rgbd_graphslam {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class FaultImport : public ::testing::Test {
  protected:
    void SetUp() override { small_sequence::make(folder_, "s", 4); }

    ProgramResult import(const std::string& options = "") const {
        return runProgram("rgbd-import",
                          "'" + folder_ / "s" + "' '" + rawlog() + "' --quiet " + options);
    }

    std::string rawlog() const { return folder_ / "out.rawlog"; }
    std::string colorPath(int frame) const {
        return folder_ / ("s/" + small_sequence::colorFile(frame));
    }
    std::string depthPath(int frame) const {
        return folder_ / ("s/" + small_sequence::depthFile(frame));
    }

    void expectRefused(const ProgramResult& result, const std::string& reason) const {
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_THAT(result.err, HasSubstr("error: "));
        EXPECT_THAT(result.err, HasSubstr(reason));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        expectNothingWritten();
    }

    void expectNothingWritten() const {
        for (const auto& entry : fs::directory_iterator(folder_ / "")) {
            const std::string name = entry.path().filename().string();
            EXPECT_FALSE(name.rfind("out", 0) == 0 || name.rfind(".tmp", 0) == 0) << name;
        }
    }

    TestFolder folder_;
};

TEST_F(FaultImport, goodSequenceIsTaken) {
    const ProgramResult result = import();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_THAT(result.out, HasSubstr("4 frames"));
}

TEST_F(FaultImport, noFolder) {
    fs::remove_all(folder_ / "s");
    expectRefused(import(), "there is no folder");
}

TEST_F(FaultImport, fileInsteadOfFolder) {
    fs::remove_all(folder_ / "s");
    folder_.write("s", "x");
    expectRefused(import(), "is not a folder");
}

TEST_F(FaultImport, emptyFolder) {
    fs::remove_all(folder_ / "s");
    fs::create_directory(folder_ / "s");
    expectRefused(import(), "is empty");
}

TEST_F(FaultImport, missingLists) {
    fs::remove(folder_ / "s/depth.txt");
    expectRefused(import(), "has no depth.txt");
    fs::remove_all(folder_ / "s/rgb");
    fs::remove(folder_ / "s/rgb.txt");
    expectRefused(import(), "has no rgb.txt");
}

TEST_F(FaultImport, withoutListsTheNamesTell) {
    fs::remove(folder_ / "s/depth.txt");
    fs::remove(folder_ / "s/rgb.txt");
    const ProgramResult result = import();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("stamps in seconds"));
    EXPECT_THAT(result.out, HasSubstr("4 frames"));
}

TEST_F(FaultImport, filesThatAreNoRecording) {
    folder_.write("a.mkv", "\x1a\x45\xdf\xa3 and more");
    expectRefused(runProgram("rgbd-import", "'" + folder_ / "a.mkv" + "' '" + rawlog() + "'"),
                  "a.mkv' is a Matroska video");
    folder_.write("a.sens", "short");
    expectRefused(runProgram("rgbd-import", "'" + folder_ / "a.sens" + "' '" + rawlog() + "'"),
                  "a.sens' is not a .sens file");
}

TEST_F(FaultImport, calibrationsOfOtherPrograms) {
    const auto with = [&](const std::string& name, const std::string& text) {
        folder_.write(name, text);
        return import("--camera '" + folder_ / name + "'");
    };
    expectRefused(with("a.json", "{"), "a.json' is not JSON");
    expectRefused(with("a.yaml", "image_width: 32"), "a.yaml' has no camera");
    const ProgramResult result =
        with("b.json", R"({"fx": 30, "fy": 31, "cx": 15.5, "cy": 11.5, "depth_units": 5000})");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(inspectRawlog(rawlog()).camera.width, 32);
}

TEST_F(FaultImport, malformedListLine) {
    folder_.write("s/rgb.txt", "# color\n1305031453.3 rgb/a.png\nrgb/b.png 1305031453.4\n");
    expectRefused(import(), "rgb.txt:3: ");
}

TEST_F(FaultImport, nanStamp) {
    folder_.write("s/depth.txt", "nan depth/a.png\n");
    expectRefused(import(), "depth.txt:1: 'nan' is not a number");
}

TEST_F(FaultImport, malformedTruth) {
    folder_.write("s/groundtruth.txt", "1 2 3\n");
    expectRefused(import(), "groundtruth.txt:1");
}

TEST_F(FaultImport, missingFileIsLeftOutAndCounted) {
    fs::remove(depthPath(1));
    const ProgramResult result = import();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("3 frames"));
    EXPECT_THAT(result.out,
                HasSubstr("1 files missing, the first: '" + small_sequence::depthFile(1) + "'"));
    EXPECT_EQ(inspectRawlog(rawlog()).rgbd_frames, 3u);
}

TEST_F(FaultImport, missingFileIsAnErrorWhenStrict) {
    fs::remove(depthPath(1));
    expectRefused(import("--strict"), small_sequence::depthFile(1) + "' is missing");
}

TEST_F(FaultImport, allFilesMissing) {
    fs::remove_all(folder_ / "s/rgb");
    expectRefused(import(), "the listed files are missing");
}

TEST_F(FaultImport, truncatedImages) {
    cutFile(colorPath(2), 0.7);
    expectRefused(import(), small_sequence::colorFile(2) + "' is cut off");
    const ProgramResult result = import("--skip-damaged");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("1 left out as damaged"));
    EXPECT_EQ(inspectRawlog(rawlog()).rgbd_frames, 3u);
}

TEST_F(FaultImport, truncatedDepth) {
    cutFile(depthPath(0), 0.5);
    expectRefused(import(), small_sequence::depthFile(0) + "' is cut off");
}

TEST_F(FaultImport, truncatedJpeg) {
    cv::imwrite(folder_ / "s/rgb/a.jpg", small_sequence::color(0));
    cutFile(folder_ / "s/rgb/a.jpg", 0.6);
    folder_.write("s/rgb.txt",
                  small_sequence::stampText(small_sequence::colorStamp(0)) + " rgb/a.jpg\n");
    expectRefused(import(), "a.jpg' is cut off");
}

TEST_F(FaultImport, imageThatIsNone) {
    std::ofstream(colorPath(0)) << "<html>404</html>";
    expectRefused(import(), "is damaged or no image");
    std::ofstream(colorPath(0), std::ios::trunc).close();
    expectRefused(import(), "is empty");
}

TEST_F(FaultImport, corruptedImage) {
    std::string bytes = readText(colorPath(0));
    std::fill(bytes.begin() + bytes.size() / 3, bytes.begin() + bytes.size() / 2, '\x55');
    std::ofstream(colorPath(0), std::ios::binary) << bytes;
    expectRefused(import(), small_sequence::colorFile(0));
}

TEST_F(FaultImport, eightBitDepth) {
    cv::Mat narrow;
    small_sequence::depth(0).convertTo(narrow, CV_8U, 1.0 / 256);
    cv::imwrite(depthPath(0), narrow);
    expectRefused(import(), "is 8-bit");
    expectRefused(import("--skip-damaged"), "is 8-bit");
}

TEST_F(FaultImport, colorAsDepth) {
    cv::imwrite(depthPath(0), small_sequence::color(0));
    expectRefused(import(), "is a color image");
}

TEST_F(FaultImport, floatDepth) {
    cv::Mat meters;
    small_sequence::depth(0).convertTo(meters, CV_32F, 1 / 5000.0);
    std::string list = readText(folder_ / "s/depth.txt");
    const std::string file = small_sequence::depthFile(0);
    list.replace(list.find(file), file.size(), "depth/a.tiff");
    folder_.write("s/depth.txt", list);
    cv::imwrite(folder_ / "s/depth/a.tiff", meters);
    const ProgramResult result = import();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out,
                HasSubstr("1 depth images in meters, converted to 5000 units per meter"));
    fs::remove(rawlog());
    meters.convertTo(meters, CV_64F);
    cv::imwrite(folder_ / "s/depth/a.tiff", meters);
    expectRefused(import(), "is floating-point");
}

TEST_F(FaultImport, exrDepth) {
    folder_.write("s/depth/a.exr", "\x76\x2f\x31\x01\x02 and so on");
    folder_.write("s/depth.txt",
                  small_sequence::stampText(small_sequence::depthStamp(0)) + " depth/a.exr\n");
    expectRefused(import(), "OpenEXR");
}

TEST_F(FaultImport, sizesThatDiffer) {
    cv::imwrite(depthPath(3), cv::Mat(cv::Mat::zeros(12, 16, CV_16UC1)));
    expectRefused(import(), "has 16x12 pixels, the camera 32x24");
}

TEST_F(FaultImport, cameraOfAnotherSize) {
    expectRefused(import("--camera fr1"), "has 32x24 pixels, the camera 640x480");
}

TEST_F(FaultImport, unknownCamera) {
    expectRefused(import("--camera fr7"), "fr7");
}

TEST_F(FaultImport, cameraFileWithUnknownKey) {
    folder_.write("s/camera.ini", small_sequence::cameraIni() + "fz = 2\n");
    expectRefused(import(), "unknown key 'fz'");
}

TEST_F(FaultImport, cameraFileWithAKeyTwice) {
    folder_.write("s/camera.ini", small_sequence::cameraIni() + "Fx = 2\n");
    expectRefused(import(), "'Fx' in line 11 repeats 'fx' of line 3");
}

TEST_F(FaultImport, principalPointOfLargerImages) {
    folder_.write("s/camera.ini",
                  "[CAMERA_PARAMS]\nresolution = [32 24]\nfx = 60\nfy = 60\ncx = 32\ncy = 23.5\n");
    expectRefused(import(), "principal point (cx 32, cy 23.5) is outside the image of 32x24");
}

TEST_F(FaultImport, depthCameraFileThatIsBroken) {
    folder_.write("s/camera_depth.ini", "[CAMERA_PARAMS]\nfx = 3\n");
    expectRefused(import(), "camera_depth.ini");
}

TEST_F(FaultImport, mostFramesLost) {
    for (const int frame : {0, 1, 3}) fs::remove(depthPath(frame));
    expectRefused(import(), "only 1 of 4 frames");
    expectRefused(import("--strict"), "is missing");
    EXPECT_EQ(import("--allow-loss").exit_code, 0);
}

TEST_F(FaultImport, strictRefusesDepthInAnImplausibleUnit) {
    EXPECT_EQ(import("--depth-units 200").exit_code, 0);
    fs::remove(rawlog());
    expectRefused(import("--strict --depth-units 200"), "would give a median of");
}

TEST_F(FaultImport, noReadingOutOfRange) {
    EXPECT_NE(import("--no-reading 70000").exit_code, 0);
    expectNothingWritten();
}

TEST_F(FaultImport, stampsOutOfReach) {
    expectRefused(import("--max-difference 0.001"), "within 0.001 s of each other");
}

TEST_F(FaultImport, unsortedAndRepeatedStampsAreSortedAndSaid) {
    std::string list = readText(folder_ / "s/rgb.txt");
    const std::string again = small_sequence::stampText(small_sequence::colorStamp(1)) + " " +
                              small_sequence::colorFile(2) + "\n";
    folder_.write("s/rgb.txt", list + again);
    const ProgramResult result = import();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("4 frames"));
    EXPECT_THAT(result.out, HasSubstr("1 with a repeated timestamp); 1 out of order"));
}

TEST_F(FaultImport, wrongArguments) {
    EXPECT_NE(import("--depth-units -3").exit_code, 0);
    EXPECT_NE(import("--max-difference soon").exit_code, 0);
    EXPECT_NE(runProgram("rgbd-import", "").exit_code, 0);
    expectNothingWritten();
}

/** Permissions do not stop root, a file in place of a folder does. */
TEST_F(FaultImport, unwritableOutput) {
    folder_.write("file", "x");
    for (const std::string option : {"", " --compact"}) {
        const ProgramResult result =
            runProgram("rgbd-import", "'" + folder_ / "s" + "' '" + folder_ / "file/out.rawlog" +
                                          "' --quiet" + option);
        expectRefused(result, "cannot make the folder");
    }
    expectRefused(runProgram("rgbd-import", "'" + folder_ / "s" + "' '" + folder_ / "s" + "' -q"),
                  "is a folder");
}

TEST_F(FaultImport, fullDisk) {
    // The shell's file size limit stands for a full disk; SIGXFSZ ignored turns it into an error.
    for (const std::string option : {"", " --small"}) {
        const std::string program = "'" RGBD_BINARY_DIR "/bin/rgbd-import' '" + folder_ / "s" +
                                    "' '" + rawlog() + "' -q" + option + " 2>'" + folder_ / "err" +
                                    "'";
        const int status = std::system(
            ("bash -c \"trap '' XFSZ; ulimit -f 8; " + program + "\" >/dev/null").c_str());
        EXPECT_EQ(WEXITSTATUS(status), 1) << option;
        EXPECT_THAT(readText(folder_ / "err"), HasSubstr("cannot write")) << option;
        expectNothingWritten();
    }
}

TEST_F(FaultImport, olderRawlogSurvivesAFailedImport) {
    ASSERT_EQ(import("--compact").exit_code, 0);
    cutFile(depthPath(3), 0.5);
    EXPECT_EQ(import("--compact").exit_code, 1);
    EXPECT_EQ(inspectRawlog(rawlog()).rgbd_frames, 4u);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "out_Images"), {}), 8);
}

class FaultArchive : public FaultImport {
  protected:
    void SetUp() override {
        FaultImport::SetUp();
        pack("");
    }

    void pack(const std::string& options) const {
        ASSERT_EQ(
            std::system(("tar -C '" + folder_ / "" + "' " + options + " -czf '" + archive() + "' s")
                            .c_str()),
            0);
    }

    std::string archive() const { return folder_ / "freiburg1.tgz"; }

    ProgramResult importArchive() const {
        return runProgram("rgbd-import", "'" + archive() + "' '" + rawlog() + "' --quiet");
    }
};

TEST_F(FaultArchive, goodArchiveGivesWhatItsFolderGives) {
    const ProgramResult result = importArchive();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const std::string from_archive = readText(rawlog());
    ASSERT_EQ(import().exit_code, 0);
    EXPECT_EQ(from_archive, readText(rawlog()));
    for (const auto& entry : fs::directory_iterator(folder_ / "")) {
        EXPECT_NE(entry.path().filename().string()[0], '.') << "the unpacked folder is left behind";
    }
}

TEST_F(FaultArchive, cutArchive) {
    cutFile(archive(), 0.6);
    expectRefused(importArchive(), "cannot unpack");
}

TEST_F(FaultArchive, archiveWithoutSequence) {
    fs::remove(folder_ / "s/rgb.txt");
    pack("");
    expectRefused(importArchive(), "no sequence in the archive");
}

TEST_F(FaultArchive, foreignFile) {
    folder_.write("freiburg1.tgz", "<html>404</html>");
    expectRefused(importArchive(), "cannot unpack");
}

TEST_F(FaultArchive, archiveThatClimbsOut) {
    pack("-P --transform 's,^s/rgb.txt,../climbed.txt,'");
    expectRefused(importArchive(), "cannot unpack");
    EXPECT_FALSE(fs::exists(folder_ / "climbed.txt"));
}

class FaultExport : public FaultImport {
  protected:
    void SetUp() override {
        FaultImport::SetUp();
        ASSERT_EQ(import().exit_code, 0);
    }

    ProgramResult exportTo(const std::string& rawlog_path, const std::string& folder,
                           const std::string& options = "") const {
        return runProgram("rawlog2tum",
                          "'" + rawlog_path + "' '" + folder + "' --quiet " + options);
    }

    void expectRefused(const ProgramResult& result, const std::string& reason) const {
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_THAT(result.err, HasSubstr(reason));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_FALSE(fs::exists(folder_ / "back"));
    }
};

TEST_F(FaultExport, missingAndForeignFiles) {
    expectRefused(exportTo(folder_ / "none.rawlog", folder_ / "back"), "there is no rawlog");
    expectRefused(exportTo(folder_ / "s", folder_ / "back"), "is a folder, not a rawlog");
    expectRefused(exportTo(folder_ / "s/rgb.txt", folder_ / "back"), "is not a rawlog");
    expectRefused(exportTo(colorPath(0), folder_ / "back"), "is not a rawlog");
}

TEST_F(FaultExport, truncatedRawlog) {
    cutFile(rawlog(), 0.7);
    expectRefused(exportTo(rawlog(), folder_ / "back"), "is cut off or damaged at entry");
}

TEST_F(FaultExport, missingExternalImage) {
    ASSERT_EQ(import("--compact").exit_code, 0);
    fs::remove(folder_ / ("out_Images/RGBD_" +
                          small_sequence::stampText(small_sequence::colorStamp(1)) + "_color.png"));
    expectRefused(exportTo(rawlog(), folder_ / "back"), "cannot be read");
}

TEST_F(FaultExport, foldersThatCannotBeUsed) {
    expectRefused(exportTo(rawlog(), folder_ / "s"), "is not empty");
    expectRefused(exportTo(rawlog(), rawlog()), "cannot make the folder");
    EXPECT_TRUE(fs::is_regular_file(rawlog()));
}

TEST_F(FaultExport, nothingWithinBounds) {
    expectRefused(exportTo(rawlog(), folder_ / "back", "--from 5"), "no frame");
}

}  // namespace
}  // namespace rgbd_graphslam
