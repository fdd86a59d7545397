#include "rgbd_graphslam/export/ros2_messages.h"

#include <gmock/gmock.h>

#include "rgbd_graphslam/export/cdr_writer.h"

namespace rgbd_graphslam {
namespace {

using testing::HasSubstr;

TEST(CdrWriter, alignsNumbersToTheirSizeBehindTheHeader) {
    CdrWriter out;
    out.putText("ab").put(std::uint16_t{0x0102}).put(std::uint8_t{3}).put(2.0);
    const std::string expected(
        "\0\1\0\0"      // little-endian CDR
        "\3\0\0\0ab\0"  // length with the terminating zero
        "\0\2\1\3"      // one byte of padding before 16 bits
        "\0\0\0\0\0"    // five before 64
        "\0\0\0\0\0\0\0\x40",
        28);
    EXPECT_EQ(out.take(), expected);
}

TEST(Ros2Messages, definitionsHoldAllTypesOnce) {
    const Ros2Type type = ros2Type("nav_msgs/msg/Path");
    EXPECT_EQ(type.name, "nav_msgs/msg/Path");
    EXPECT_THAT(
        type.definition,
        testing::StartsWith("std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n====="));
    for (const char* used :
         {"geometry_msgs/PoseStamped", "geometry_msgs/Pose", "geometry_msgs/Point",
          "geometry_msgs/Quaternion", "std_msgs/Header", "builtin_interfaces/Time"}) {
        const std::string head = std::string("MSG: ") + used + "\n";
        const auto first = type.definition.find(head);
        ASSERT_NE(first, std::string::npos) << used;
        EXPECT_EQ(type.definition.find(head, first + 1), std::string::npos) << used;
    }
    EXPECT_EQ(type.definition.find("MSG: geometry_msgs/Vector3"), std::string::npos);
}

TEST(Ros2Messages, stampsAreExactToTheMicrosecond) {
    EXPECT_EQ(rosNanoseconds(1305031453.359684), 1305031453359684000);
    EXPECT_EQ(rosNanoseconds(-5), 0);
}

}  // namespace
}  // namespace rgbd_graphslam
