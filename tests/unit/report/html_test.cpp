#include "rgbd_graphslam/report/html.h"

#include <gtest/gtest.h>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

TEST(HtmlEscaped, leavesNothingThatCouldBeMarkup) {
    EXPECT_EQ(htmlEscaped("a<b>&\"c'"), "a&lt;b&gt;&amp;&quot;c&#39;");
    EXPECT_EQ(htmlEscaped("Büro 3 – Süd"), "Büro 3 – Süd");
}

TEST(HtmlEscaped, replacesWhatIsNoText) {
    EXPECT_EQ(htmlEscaped("a\xff"
                          "b\x1b["),
              "a\xEF\xBF\xBD"
              "b\xEF\xBF\xBD[");
    EXPECT_EQ(htmlEscaped("\xC0\xBC"), "\xEF\xBF\xBD\xEF\xBF\xBD");  // an overlong <
    EXPECT_EQ(htmlEscaped("\xE2\x82"), "\xEF\xBF\xBD\xEF\xBF\xBD");  // cut off
}

TEST(DataUri, isBase64) {
    EXPECT_EQ(dataUri("text/plain", "light work."), "data:text/plain;base64,bGlnaHQgd29yay4=");
    EXPECT_EQ(dataUri("text/plain", "light work"), "data:text/plain;base64,bGlnaHQgd29yaw==");
    EXPECT_EQ(dataUri("a/b", std::string("\xff\x00\x80", 3)), "data:a/b;base64,/wCA");
}

TEST(EmbeddedImage, isNothingForNoPicture) {
    EXPECT_EQ(embeddedImage("image/png", "", "map"), "");
    EXPECT_EQ(embeddedImage("image/png", "abc", "a \"map\""),
              "<img alt=\"a &quot;map&quot;\" src=\"data:image/png;base64,YWJj\">");
}

TEST(FilledTemplate, putsEachValueInItsPlace) {
    EXPECT_EQ(filled("<b>{{x}}</b>{{y}}{{x}}", {{"x", "1"}, {"y", "{{x}}"}}), "<b>1</b>{{x}}1");
}

TEST(FilledTemplate, refusesNamesThatDoNotFit) {
    EXPECT_THROW(filled("{{x}}", {}), Error);
    EXPECT_THROW(filled("text", {{"x", "1"}}), Error);
    EXPECT_THROW(filled("{{x}}{{x}}", {{"x", "1"}, {"y", "2"}}), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
