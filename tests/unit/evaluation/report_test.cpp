#include "rgbd_graphslam/evaluation/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "../../support/made_trajectories.h"

namespace rgbd_graphslam {
namespace {
using testing::HasSubstr;

Report made(const std::string& name, double error_m) {
    return {name, {{"compared_pose_pairs", 12, "pairs", 0}, {"error.rmse", error_m, "m"}}};
}

TEST(Report, namesTheFiguresAsTheTumTools) {
    const auto text =
        format({reportOf("a", evaluateAte(circle(), circle()), PerAxis::No)}, ReportFormat::Text);
    EXPECT_THAT(text, HasSubstr("compared_pose_pairs 101 pairs\n"));
    EXPECT_THAT(text, HasSubstr("absolute_translational_error.rmse 0.000000 m\n"));
    EXPECT_THAT(text, HasSubstr("scale_that_would_fit 1.000000\n"));
    EXPECT_THAT(text, testing::Not(HasSubstr(".x.")));
}

TEST(Report, tellsTheAxesWhenAsked) {
    auto estimate = circle(1001);
    for (std::size_t k = 0; k < estimate.size(); ++k) {
        estimate[k].T_world_cam.t.z() += k % 2 ? 0.01 : -0.01;
    }
    const auto ate = evaluateAte(estimate, circle(1001));
    const auto text = format({reportOf("a", ate, PerAxis::Yes)}, ReportFormat::Text);
    EXPECT_THAT(text, HasSubstr("absolute_translational_error.x.mean 0.0000"));
    EXPECT_THAT(text, HasSubstr("absolute_translational_error.z.mean 0.0100"));
}

TEST(Report, tellsTheAxesOfRelativeErrors) {
    RpeOptions options;
    options.fixed_delta = true;
    const auto rpe = evaluateRpe(straight(1.02, M_PI / 180), straight(1, 0), options);
    const auto text = format({reportOf("a", rpe, PerAxis::Yes)}, ReportFormat::Text);
    EXPECT_THAT(text, HasSubstr("rotational_error.x.max 0.000000 deg\n"));
    EXPECT_THAT(text, HasSubstr("rotational_error.z.mean 1.000000 deg\n"));
}

TEST(Report, putsSeveralEstimatesSideBySide) {
    EXPECT_EQ(format({made("first", 0.5), made("b", 123.25)}, ReportFormat::Text),
              "                        first           b\n"
              "compared_pose_pairs        12          12 pairs\n"
              "error.rmse           0.500000  123.250000 m\n");
}

TEST(Report, isCsv) {
    EXPECT_EQ(format({made("a,\"b\"", 0.5), made("c", 2)}, ReportFormat::Csv),
              "name,compared_pose_pairs [pairs],error.rmse [m]\n"
              "\"a,\"\"b\"\"\",12,0.500000\n"
              "c,12,2.000000\n");
}

TEST(Report, isJson) {
    const auto json = nlohmann::json::parse(
        format({made("a", 0.5), made("b", std::nan(""))}, ReportFormat::Json));
    ASSERT_EQ(json.size(), 2u);
    EXPECT_EQ(json[0]["name"], "a");
    EXPECT_EQ(json[0]["figures"]["error.rmse"]["value"], 0.5);
    EXPECT_EQ(json[0]["figures"]["error.rmse"]["unit"], "m");
    EXPECT_TRUE(json[1]["figures"]["error.rmse"]["value"].is_null());
    const auto counted = nlohmann::json::parse(
        format({rgbd_graphslam::Report{"c", {{"poses", 3, "", 0}}}}, ReportFormat::Json));
    EXPECT_TRUE(counted[0]["figures"]["poses"]["value"].is_number_integer());
}

TEST(Report, isLatex) {
    const auto text = format({made("fr1_desk", 0.5), made("b", 2)}, ReportFormat::Latex);
    EXPECT_THAT(text, HasSubstr("\\begin{tabular}{lrr}"));
    EXPECT_THAT(text, HasSubstr(" & fr1\\_desk & b \\\\"));
    EXPECT_THAT(text, HasSubstr("error rmse (m) & 0.500000 & 2.000000 \\\\"));
}

}  // namespace
}  // namespace rgbd_graphslam
