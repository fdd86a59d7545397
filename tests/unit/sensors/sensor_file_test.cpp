#include "rgbd_graphslam/sensors/sensor_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {
using testing::HasSubstr;

/** As MRPT ships them. */
constexpr const char* of_rawlog_grabber = R"(// ------------------------------------
//  Config file for the "RawLogGrabber" application
[global]
rawlog_prefix = ./dataset
// Milliseconds between thread launches
time_between_launches = 800
use_sensoryframes = 0   // no
SF_max_time_span = 0.25
GRABBER_PERIOD_MS = 1000

[LASER]
driver = CHokuyoURG
process_rate = 90   // Hz
pose_x = 0.31       ; on the robot
COM_port_LIN = ttyACM0

[OLD]
driver = CCameraSensor
process_rate = 30
rawlog-grabber-ignore = true

[GPS]
driver = CGPSInterface
process_rate = 4
)";

std::string problemOf(const std::string& text) {
    try {
        parseSensorFile(text, "a.ini");
    } catch (const Error& e) {
        return e.what();
    }
    return "";
}

TEST(sensorFile, readsWhatRawlogGrabberReads) {
    const SensorFile file = parseSensorFile(of_rawlog_grabber, "a.ini");
    ASSERT_EQ(file.sensors.size(), 2u);
    EXPECT_EQ(file.sensors[0].name, "LASER");
    EXPECT_EQ(file.sensors[0].driver, "CHokuyoURG");
    EXPECT_EQ(file.sensors[0].process_rate_hz, 90);
    EXPECT_EQ(file.sensors[1].driver, "CGPSInterface");
    EXPECT_EQ(file.time_between_launches_ms, 800);
    EXPECT_EQ(file.config.read_double("LASER", "pose_x", 0), 0.31);
}

TEST(sensorFile, namesWhatIsWrong) {
    EXPECT_THAT(problemOf(""), HasSubstr("a.ini: no sensor"));
    EXPECT_THAT(problemOf("[global]\n"), HasSubstr("no sensor"));
    EXPECT_THAT(problemOf("[A]\nprocess_rate = 5\n"), HasSubstr("section [A]: no driver"));
    EXPECT_THAT(problemOf("[A]\ndriver = X\n"), HasSubstr("section [A]: no process_rate"));
    EXPECT_THAT(problemOf("[A]\ndriver = X\nprocess_rate = fast\n"),
                HasSubstr("process_rate = 'fast' makes no sense; give process_rate a number"));
    EXPECT_THAT(problemOf("[A]\ndriver = X\nprocess_rate = 0\n"), HasSubstr("makes no sense"));
    EXPECT_THAT(problemOf("[A]\ndriver = X\nprocess_rate = nan\n"), HasSubstr("makes no sense"));
    EXPECT_THAT(problemOf("driver = X\n"), HasSubstr("a.ini:1: a line before the first section"));
    EXPECT_THAT(problemOf("[A]\nwhat\n"), HasSubstr("a.ini:2: 'what' is neither"));
    EXPECT_THAT(problemOf("[A\n"), HasSubstr("is no section"));
    EXPECT_THAT(problemOf("[A]\na = 1\n[A]\n"), HasSubstr("a.ini:3: section [A] is there twice"));
    EXPECT_THAT(problemOf("[A]\ndriver = $env{HOME}\n"), HasSubstr("is not evaluated"));
    EXPECT_THAT(problemOf("[global]\ntime_between_launches = -1\n[A]\n"),
                HasSubstr("section [global]: time_between_launches"));
}

TEST(sensorFile, anyTextIsReadOrRefused) {
    const std::string text = of_rawlog_grabber;
    for (std::size_t i = 0; i < text.size(); i += 7) {
        for (const char c : {'\0', '[', ']', '=', '\\', '\n', '\xff'}) {
            std::string changed = text;
            changed[i] = c;
            for (const std::string& one : {changed, text.substr(0, i)}) {
                try {
                    EXPECT_FALSE(parseSensorFile(one, "a.ini").sensors.empty());
                } catch (const Error& e) {
                    EXPECT_THAT(e.what(), HasSubstr("a.ini"));
                }
            }
        }
    }
}

}  // namespace
}  // namespace rgbd_graphslam
