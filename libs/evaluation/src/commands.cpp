#include "rgbd_graphslam/evaluation/commands.h"

#include <filesystem>
#include <set>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/progress.h"
#include "rgbd_graphslam/dataset/camera_file.h"
#include "rgbd_graphslam/dataset/rawlog_info.h"
#include "rgbd_graphslam/evaluation/consistency.h"

namespace rgbd_graphslam {
namespace {

Trajectory truthOf(const TrajectoryRequest& request) {
    if (request.files.size() < 2) throw Error("an estimate and a truth are needed");
    return readTrajectory(request.files.back());
}

PerAxis perAxis(const TrajectoryRequest& request) {
    return request.per_axis ? PerAxis::Yes : PerAxis::No;
}

/** Names of the estimates in tables: short ones, unless these would be the same. */
std::vector<std::string> labelsOf(const std::vector<std::string>& paths) {
    std::vector<std::string> stems;
    stems.reserve(paths.size());
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

void plotErrors(const TrajectoryRequest& request, const std::vector<ErrorPanel>& panels) {
    if (!request.errors_plot.empty()) plotErrorsOverTime(panels, request.errors_plot);
    if (!request.distribution_plot.empty()) {
        plotErrorDistribution(panels, request.distribution_plot);
    }
}

/** \param name or file */
CameraSetup cameraNamed(const std::string& name) {
    const auto known = cameraByName(name);
    return known ? *known : readCameraFile(name);
}

CameraSetup cameraOf(const PointCloudRequest& request) {
    CameraSetup setup = cameraNamed(request.camera);
    if (request.depth_units > 0) setup.depth_units = request.depth_units;
    return setup;
}

std::vector<PosedImageFiles> imagesOf(const PointCloudRequest& request) {
    const bool pairs = !request.pairs.empty();
    if (request.trajectory.empty()) {
        if (pairs) throw Error("'" + request.pairs + "' needs poses", "give --trajectory");
        return {{request.color, request.depth, {}}};
    }
    const auto trajectory = readTrajectory(request.trajectory);
    return pairs ? posedImages(request.pairs, trajectory, request.max_difference_s)
                 : posedImages(request.color, request.depth, trajectory, request.max_difference_s);
}

/** Evaluates each estimate of a request; errors name its file.
 *  \param evaluate gives what was found about an estimate under a label */
template <class Evaluate>
auto evaluateAll(const TrajectoryRequest& request, Evaluate evaluate) {
    const std::vector<std::string> files(request.files.begin(), request.files.end() - 1);
    const auto labels = labelsOf(files);
    std::vector<decltype(evaluate(std::string(), Trajectory()))> evaluated;
    for (std::size_t k = 0; k < files.size(); ++k) {
        const auto estimate = readTrajectory(files[k]);
        evaluated.push_back(naming(files[k], [&] { return evaluate(labels[k], estimate); }));
    }
    return evaluated;
}

/** \param file a movers.csv; empty: it is not known */
std::optional<MoverWays> waysIn(const std::string& file) {
    if (file.empty()) return std::nullopt;
    return MoverWays(readMoverBoxes(file));
}

template <class Evaluated>
std::string tableOf(const std::vector<Evaluated>& evaluated, const TrajectoryRequest& request) {
    std::vector<Report> reports;
    reports.reserve(evaluated.size());
    for (const auto& each : evaluated) {
        reports.push_back(reportOf(each.label, each.result, perAxis(request)));
    }
    return format(reports, request.format);
}

}  // namespace

Trajectory readTrajectory(const std::string& path) {
    if (std::filesystem::path(path).extension() != ".rawlog") return readTumTrajectory(path);
    auto truth = truthOf(path);
    if (truth.empty()) {
        throw Error("'" + path + "' holds no ground truth", "give the truth as a text file");
    }
    return truth;
}

std::string runAte(const AteRequest& request) {
    const auto truth = truthOf(request);
    const auto evaluated =
        evaluateAll(request, [&](const std::string& label, const Trajectory& estimate) {
            return EvaluatedAte{label, estimate, evaluateAte(estimate, truth, request.options)};
        });
    if (!request.plot.empty()) plotTrajectories(truth, evaluated, request.plane, request.plot);
    plotErrors(request, errorPanels(evaluated));
    return tableOf(evaluated, request);
}

std::string runRpe(const RpeRequest& request) {
    const auto truth = truthOf(request);
    const auto evaluated =
        evaluateAll(request, [&](const std::string& label, const Trajectory& estimate) {
            return EvaluatedRpe{label, evaluateRpe(estimate, truth, request.options)};
        });
    const auto style =
        request.options.fixed_delta ? ErrorPanel::Style::Lines : ErrorPanel::Style::Points;
    plotErrors(request, errorPanels(evaluated, style));
    return tableOf(evaluated, request);
}

std::string runDrift(const DriftRequest& request) {
    const auto truth = truthOf(request);
    return format(evaluateAll(request,
                              [&](const std::string& label, const Trajectory& estimate) {
                                  return reportOf(label,
                                                  evaluateDrift(estimate, truth, request.options));
                              }),
                  request.format);
}

std::string runConsistency(const ConsistencyRequest& request) {
    const auto claims = readClaimedPoses(request.run_folder);
    const auto truth = readTrajectory(request.truth);
    const TruthAccuracy accuracy{request.truth_std_m, request.truth_std_deg * M_PI / 180};
    const auto result =
        naming(request.run_folder, [&] { return evaluateConsistency(claims, truth, accuracy); });
    return format({reportOf(labelsOf({request.run_folder}).front(), result)}, request.format);
}

std::string runAssociate(const AssociateRequest& request) {
    return associationText(readStampedList(request.first), readStampedList(request.second),
                           request.options);
}

std::string runPointCloud(const PointCloudRequest& request) {
    const CameraSetup setup = cameraOf(request);
    const auto images = imagesOf(request);
    PointCloudBuilder builder(setup.camera, request.options);
    Progress progress("points", images.size(), "images");
    std::size_t used = 0;
    for (std::size_t k = 0; k < images.size(); k += request.every_image) {
        const auto& [color, depth, T_world_cam] = images[k];
        builder.add(readRgbdImage(color, depth, setup.depthUnitInMetres()), T_world_cam);
        progress.update(k + 1);
        ++used;
    }
    progress.finish();
    writePly(request.output, builder.cloud());
    return "images " + std::to_string(used) + "\npoints " +
           std::to_string(builder.cloud().vertices.size()) + "\n";
}

Similarity alignmentOf(const SurfaceRequest& request) {
    if (request.estimate.empty()) return {};
    return naming(request.estimate, [&] {
        return evaluateAte(readTrajectory(request.estimate), readTrajectory(request.truth))
            .alignment;
    });
}

std::optional<SurfaceSight> sightOf(const SurfaceRequest& request, const PlyModel& surface) {
    if (request.camera.empty()) return std::nullopt;
    return SurfaceSight(surface, cameraNamed(request.camera).camera, readTrajectory(request.truth),
                        request.sight);
}

std::string runMap(const MapRequest& request) {
    MapAccuracyOptions options = request.options;
    options.alignment = alignmentOf(request);
    const PlyModel surface = readPly(request.surface);
    const auto sight = sightOf(request, surface);
    options.sight = sight ? &*sight : nullptr;
    const auto movers = waysIn(request.movers);
    options.movers = movers ? &*movers : nullptr;
    const auto accuracy = evaluateMap(readPly(request.map), surface, options);
    const std::string label = std::filesystem::path(request.map).stem();
    return format({reportOf(label, accuracy)}, request.format);
}

std::string runGrid(const GridRequest& request) {
    GridAccuracyOptions options = request.options;
    options.alignment = alignmentOf(request);
    const auto movers = waysIn(request.movers);
    options.movers = movers ? &*movers : nullptr;
    const auto accuracy =
        evaluateGrid(occupiedCells(request.map), readPly(request.surface), options);
    const std::string label = std::filesystem::path(request.map).stem();
    return format({reportOf(label, accuracy)}, request.format);
}

std::string runMasks(const MasksRequest& request) {
    namespace fs = std::filesystem;
    const fs::path movers =
        fs::path(request.truth + "/").parent_path().parent_path() / "movers.csv";
    const auto boxes =
        fs::exists(movers) ? readMoverBoxes(movers.string()) : std::vector<MoverBox>();
    const auto accuracy = evaluateMasks(request.estimated, request.truth, boxes, request.options);
    return format({reportOf(labelsOf({request.estimated}).front(), accuracy)}, request.format);
}

}  // namespace rgbd_graphslam
