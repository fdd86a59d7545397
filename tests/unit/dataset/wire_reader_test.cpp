/** The two wire formats, byte by byte. */
#include "../../../libs/dataset/src/wire_reader.h"

#include <gtest/gtest.h>

#include "../../../libs/dataset/src/ros_messages.h"

namespace rgbd_graphslam {
namespace {

using namespace std::string_literals;

TEST(WireReader, ros1HasNoPadding) {
    const std::string bytes = "\x07\x01\x00\x00\x00\x02\x00\x00\x00hi"s;
    WireReader in(bytes);
    EXPECT_EQ(in.number<std::uint8_t>(), 7);
    EXPECT_EQ(in.number<std::uint32_t>(), 1u);
    EXPECT_EQ(in.text(), "hi");
    EXPECT_TRUE(in.atEnd());
    EXPECT_THROW(in.number<std::uint8_t>(), std::out_of_range);
}

TEST(WireReader, cdrAlignsFromBehindTheEncapsulationAndEndsTextsWithZero) {
    const std::string bytes =
        "\x00\x01\x00\x00"
        "\x07\x00\x00\x00\x03\x00\x00\x00hi\x00\x00\x00\x00\x00\x00"
        "\x00\x00\x00\x00\x00\x00\xf0\x3f"s;
    WireReader in(bytes, WireFormat::Cdr);
    EXPECT_EQ(in.number<std::uint8_t>(), 7);
    EXPECT_EQ(in.text(), "hi");
    EXPECT_EQ(in.number<double>(), 1.0) << "aligned to 8 at byte 16";
    EXPECT_TRUE(in.atEnd());
}

TEST(WireReader, cdrMayBeBigEndian) {
    const std::string bytes = "\x00\x00\x00\x00\x01\x02\x00\x00\x01\x02\x03\x04"s;
    WireReader in(bytes, WireFormat::Cdr);
    EXPECT_EQ(in.number<std::uint16_t>(), 0x0102);
    EXPECT_EQ(in.number<std::uint32_t>(), 0x01020304u);
}

TEST(WireReader, versionTwoOfCdrAlignsToFourAtMost) {
    const std::string bytes = "\x00\x07\x00\x00\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\xf0\x3f"s;
    WireReader in(bytes, WireFormat::Cdr);
    EXPECT_EQ(in.number<std::uint8_t>(), 1);
    EXPECT_EQ(in.number<double>(), 1.0);
}

TEST(WireReader, otherEncapsulationsAreRefused) {
    EXPECT_THROW(WireReader("\x00\x03\x00\x00"s, WireFormat::Cdr), std::out_of_range);
    EXPECT_THROW(WireReader("\x00"s, WireFormat::Cdr), std::out_of_range);
}

/** A length that the message cannot hold shall not fill the memory. */
TEST(WireReader, sequencesAreNoLongerThanTheMessage) {
    const std::string bytes = "\xff\xff\xff\x7f\x00\x00\x00\x00"s;
    WireReader in(bytes);
    EXPECT_THROW(in.lengthOfSequence<double>(), std::out_of_range);
    WireReader text(bytes);
    EXPECT_THROW(text.text(), std::out_of_range);
}

TEST(RosMessages, extrinsicsHaveAHeaderInRos1Only) {
    std::string numbers;
    for (int i = 0; i < 12; ++i) {
        const double value = i == 0 || i == 4 || i == 8 ? 1 : i == 9 ? 0.25 : 0;
        numbers.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    const std::string header(16, '\0'), encapsulation = "\x00\x01\x00\x00"s;
    for (const SE3& T :
         {ros::readExtrinsics(WireReader(header + numbers)),
          ros::readExtrinsics(WireReader(encapsulation + numbers, WireFormat::Cdr))}) {
        EXPECT_EQ(T.t.x(), 0.25);
        EXPECT_LT(T.angle(), 1e-9);
    }
}

}  // namespace
}  // namespace rgbd_graphslam
