#include "rgbd_graphslam/core/console.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(WarningRecord, keepsWhatIsSaidWhileItLives) {
    sayWarning("before");
    const WarningRecord record;
    EXPECT_THAT(record.warnings(), IsEmpty());
    sayWarning("one");
    {
        const WarningRecord inner;
        sayWarning("two");
        EXPECT_THAT(inner.warnings(), ElementsAre("two"));
    }
    EXPECT_THAT(record.warnings(), ElementsAre("one", "two"));
}

}  // namespace
}  // namespace rgbd_graphslam
