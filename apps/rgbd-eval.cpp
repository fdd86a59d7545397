/** rgbd-eval: how good trajectories, maps and associations are. */
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <set>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/evaluation/plots.h"
#include "rgbd_graphslam/evaluation/report.h"
#include "rgbd_graphslam/evaluation/stamped_list.h"

namespace {
using namespace rgbd_graphslam;

/** What `ate` and `rpe` have in common. */
struct TrajectoryRequest {
    std::vector<std::string> files;  // estimates, then the truth
    ReportFormat format = ReportFormat::Text;
    bool per_axis = false;
    std::string errors_plot, distribution_plot;

    std::vector<std::string> estimates() const { return {files.begin(), files.end() - 1}; }
    PerAxis perAxis() const { return per_axis ? PerAxis::Yes : PerAxis::No; }
};

struct AteRequest : TrajectoryRequest {
    AteOptions options;
    std::string plot;
    PlotPlane plane = PlotPlane::XY;
};

struct RpeRequest : TrajectoryRequest {
    RpeOptions options;
};

struct AssociateRequest {
    std::string first, second;
    AssociationOptions options;
};

/** Names of the estimates in tables: short ones, unless these would be the same. */
std::vector<std::string> labelsOf(const std::vector<std::string>& paths) {
    std::vector<std::string> stems;
    for (const auto& path : paths) stems.push_back(std::filesystem::path(path).stem());
    const std::set<std::string> distinct(stems.begin(), stems.end());
    return distinct.size() == paths.size() ? stems : paths;
}

/** Calls evaluate(); its errors name the file. */
template <class Evaluate>
auto naming(const std::string& file, Evaluate evaluate) {
    try {
        return evaluate();
    } catch (const Error& e) {
        throw Error(file + ": " + e.what());
    }
}

void print(const std::vector<Report>& reports, ReportFormat format) {
    std::fputs(rgbd_graphslam::format(reports, format).c_str(), stdout);
}

void plotErrors(const TrajectoryRequest& request, const std::vector<ErrorPanel>& panels) {
    if (!request.errors_plot.empty()) plotErrorsOverTime(panels, request.errors_plot);
    if (!request.distribution_plot.empty())
        plotErrorDistribution(panels, request.distribution_plot);
}

void runAte(const AteRequest& request) {
    const auto truth = readTumTrajectory(request.files.back());
    const auto labels = labelsOf(request.estimates());
    std::vector<EvaluatedAte> evaluated;
    std::vector<Report> reports;
    for (std::size_t k = 0; k < labels.size(); ++k) {
        const auto estimate = readTumTrajectory(request.files[k]);
        const auto result =
            naming(request.files[k], [&] { return evaluateAte(estimate, truth, request.options); });
        evaluated.push_back({labels[k], estimate, result});
        reports.push_back(reportOf(labels[k], result, request.perAxis()));
    }
    print(reports, request.format);
    if (!request.plot.empty()) plotTrajectories(truth, evaluated, request.plane, request.plot);
    plotErrors(request, errorPanels(evaluated));
}

void runRpe(const RpeRequest& request) {
    const auto truth = readTumTrajectory(request.files.back());
    const auto labels = labelsOf(request.estimates());
    std::vector<EvaluatedRpe> evaluated;
    std::vector<Report> reports;
    for (std::size_t k = 0; k < labels.size(); ++k) {
        const auto result = naming(request.files[k], [&] {
            return evaluateRpe(readTumTrajectory(request.files[k]), truth, request.options);
        });
        evaluated.push_back({labels[k], result});
        reports.push_back(reportOf(labels[k], result, request.perAxis()));
    }
    print(reports, request.format);
    const auto style =
        request.options.fixed_delta ? ErrorPanel::Style::Lines : ErrorPanel::Style::Points;
    plotErrors(request, errorPanels(evaluated, style));
}

void runAssociate(const AssociateRequest& request) {
    std::fputs(associationText(readStampedList(request.first), readStampedList(request.second),
                               request.options)
                   .c_str(),
               stdout);
}

void describeTrajectories(CLI::App& command, TrajectoryRequest& request) {
    command
        .add_option("files", request.files,
                    "EST... TRUTH: estimates, then the truth (TUM text files)")
        ->required()
        ->expected(2, -1);
    const std::map<std::string, ReportFormat> formats{{"text", ReportFormat::Text},
                                                      {"csv", ReportFormat::Csv},
                                                      {"json", ReportFormat::Json},
                                                      {"latex", ReportFormat::Latex}};
    command.add_option("--format", request.format, "of the table: text, csv, json or latex")
        ->transform(CLI::CheckedTransformer(formats));
    command.add_flag("--per-axis", request.per_axis, "errors along x, y and z too");
    command.add_option("--plot-errors", request.errors_plot, "errors over time (.png or .svg)");
    command.add_option("--plot-distribution", request.distribution_plot,
                       "distribution of the errors (.png or .svg)");
}

void addAte(CLI::App& app, AteRequest& request) {
    auto* command = app.add_subcommand("ate", "absolute trajectory error");
    describeTrajectories(*command, request);
    auto& options = request.options;
    command->add_option("--max-difference", options.max_difference_s, "between stamps (s)");
    command->add_option("--offset", options.offset_s, "added to the estimate's stamps (s)");
    command->add_option("--scale", options.scale, "factor on the estimate's positions");
    command->add_flag("--fit-scale", options.fit_scale, "align with the scale that fits best");
    command->add_option("--plot", request.plot, "truth, estimate and difference (.png or .svg)");
    const std::map<std::string, PlotPlane> planes{
        {"xy", PlotPlane::XY}, {"xz", PlotPlane::XZ}, {"yz", PlotPlane::YZ}};
    command->add_option("--plane", request.plane, "of --plot: xy, xz or yz")
        ->transform(CLI::CheckedTransformer(planes));
    command->callback([&request] { runAte(request); });
}

void addRpe(CLI::App& app, RpeRequest& request) {
    auto* command = app.add_subcommand("rpe", "relative pose error");
    describeTrajectories(*command, request);
    auto& options = request.options;
    command->add_flag("--fixed-delta", options.fixed_delta,
                      "pairs of poses --delta apart; without it all pairs");
    command->add_option("--delta", options.delta, "distance of the two poses of a pair");
    const std::map<std::string, DeltaUnit> units{{"s", DeltaUnit::Seconds},
                                                 {"m", DeltaUnit::Metres},
                                                 {"rad", DeltaUnit::Radians},
                                                 {"deg", DeltaUnit::Degrees},
                                                 {"f", DeltaUnit::Frames}};
    command->add_option("--delta-unit", options.unit, "s, m, rad, deg or f (frames)")
        ->transform(CLI::CheckedTransformer(units));
    command->add_option("--max-pairs", options.max_pairs, "draw as many; 0: take all");
    command->add_option("--seed", options.seed, "of the drawing");
    command->add_option("--offset", options.offset_s, "added to the estimate's stamps (s)");
    command->add_option("--scale", options.scale, "factor on the estimate's positions");
    command->callback([&request] { runRpe(request); });
}

void addAssociate(CLI::App& app, AssociateRequest& request) {
    auto* command = app.add_subcommand("associate", "pair the lines of two lists by stamp");
    command->add_option("first", request.first, "list, e.g. rgb.txt")->required();
    command->add_option("second", request.second, "list, e.g. depth.txt")->required();
    auto& options = request.options;
    command->add_option("--max-difference", options.max_difference_s, "between stamps (s)");
    command->add_option("--offset", options.offset_s, "added to the second list's stamps (s)");
    command->add_flag("--first-only", options.first_only, "print lines of the first list only");
    command->callback([&request] { runAssociate(request); });
}

int run(int argc, char** argv) {
    CLI::App app("Evaluates RGB-D trajectories and maps as the TUM RGB-D benchmark does.");
    app.require_subcommand(1);
    app.option_defaults()->always_capture_default();
    AteRequest ate;
    RpeRequest rpe;
    AssociateRequest association;
    addAte(app, ate);
    addRpe(app, rpe);
    addAssociate(app, association);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return rgbd_graphslam::runMain("rgbd-eval", [&] { return run(argc, argv); });
}
