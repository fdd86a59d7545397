/** Label images from a folder to the map: rgbd-import, rgbd-slam, rgbd-map. */
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "../support/small_onnx.h"
#include "../support/synthetic_film.h"
#include "../support/tum_folder.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;

/** Points of labels.ply: class by place, in steps of a voxel. */
std::map<std::array<int, 3>, int> labelsOf(const std::string& ply) {
    constexpr std::size_t record = 12 + 3 + 2 + 4 + 2 + 4;
    constexpr float voxel_m = 0.02F;
    std::ifstream in(ply, std::ios::binary);
    for (std::string line; line != "end_header" && std::getline(in, line);) continue;
    std::map<std::array<int, 3>, int> labels;
    for (std::array<char, record> bytes; in.read(bytes.data(), record);) {
        std::array<float, 3> p{};
        std::uint16_t label = 0;
        std::memcpy(p.data(), bytes.data(), 12);
        std::memcpy(&label, bytes.data() + 15, 2);
        std::array<int, 3> at{};
        for (std::size_t i = 0; i < 3; ++i) at[i] = static_cast<int>(std::floor(p[i] / voxel_m));
        labels[at] = label;
    }
    return labels;
}

/** Imports a film and runs SLAM on it. \return the output folder */
std::string mapped(const std::string& film, const std::string& folder,
                   const std::string& options = "") {
    runOrFail("rgbd-import", "'" + film + "' '" + folder + ".rawlog' -q");
    runOrFail("rgbd-slam", "'" + folder + ".rawlog' -o '" + folder + "' -q " + options);
    return folder;
}

/** In every fifth image all classes are confused with others. */
void spoilLabels(const std::string& film) {
    int number = 0;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(film + "/label")) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
        if (++number % 5 != 0) continue;
        cv::Mat1b labels = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
        for (auto& label : labels) label = static_cast<std::uint8_t>(1 + (label + number) % 20);
        cv::imwrite(file.string(), labels);
    }
}

json objectsOf(const std::string& run) {
    return json::parse(std::ifstream(run + "/objects.json"))["objects"];
}

double distance(const json& a, const json& b) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const double d = a["center_m"][i].get<double>() - b["center_m"][i].get<double>();
        sum += d * d;
    }
    return std::sqrt(sum);
}

/** Share of the larger objects of `some` for which `others` have one of the same class nearby.
 *  \param reach how far apart the centers may be, of the longest side or m */
double shareKnown(const json& some, const json& others, double reach_of_size, double reach_m) {
    int large = 0, same = 0;
    for (const json& object : some) {
        if (object["voxels"].get<int>() < 100) continue;
        ++large;
        const double size_m =
            std::max(object["size_m"][0].get<double>(), object["size_m"][2].get<double>());
        same += std::any_of(others.begin(), others.end(), [&](const json& other) {
            return other["class"] == object["class"] &&
                   distance(object, other) < std::max(reach_m, reach_of_size * size_m);
        });
    }
    return large > 0 ? static_cast<double>(same) / large : 0;
}

TEST(Labels, wrongImagesAreOutvotedByRightOnes) {
    const std::string film = filmOf("office", "--frames 300 --size 320x240 --labels");
    if (HasFatalFailure()) return;
    const TestFolder folder;
    const std::string exact = mapped(film, folder / "exact");
    fs::copy(film, folder / "film", fs::copy_options::recursive);
    spoilLabels(folder / "film");
    const std::string doubtful = mapped(folder / "film", folder / "doubtful");
    if (HasFatalFailure()) return;

    const auto truth = labelsOf(exact + "/labels.ply"), labels = labelsOf(doubtful + "/labels.ply");
    ASSERT_GT(truth.size(), 10000u);
    std::size_t both = 0, right = 0;
    for (const auto& [place, label] : truth) {
        const auto found = labels.find(place);
        if (found == labels.end()) continue;
        ++both;
        right += found->second == label;
    }
    const double share = static_cast<double>(right) / static_cast<double>(both);
    // Found where it is to 5 cm; invented where there is nothing of the class.
    const double found = shareKnown(objectsOf(exact), objectsOf(doubtful), 0, 0.05);
    const double invented = 1 - shareKnown(objectsOf(doubtful), objectsOf(exact), 0.5, 0);
    std::printf("%.1f %% of the voxels right, %.0f %% of the objects found, %.0f %% invented\n",
                100 * share, 100 * found, 100 * invented);
    EXPECT_GE(share, 0.95);
    EXPECT_GE(found, 0.9);
    EXPECT_LE(invented, 0.05);
    EXPECT_TRUE(fs::exists(doubtful + "/labels.png"));
}

TEST(Labels, peopleThatAreLabeledDisturbNeitherTrackingNorMap) {
    const std::string film = filmOf("crowd", "--frames 300 --size 320x240 --labels");
    if (HasFatalFailure()) return;
    const TestFolder folder;
    const std::string run =
        mapped(film, folder / "masked", "--set SemanticOptions.moving_classes=person");
    if (HasFatalFailure()) return;
    const json summary = json::parse(std::ifstream(run + "/summary.json"));
    const double ate_m = summary["ate"]["rmse_m"].get<double>();
    std::printf("crowd with masks: ATE %.4f m\n", ate_m);
    EXPECT_LE(ate_m, 0.04);
    for (const json& object : objectsOf(run)) EXPECT_NE(object["class"], "person");
    const auto labels = labelsOf(run + "/labels.ply");
    std::size_t people = 0;
    for (const auto& [place, label] : labels) people += label == 21;
    EXPECT_LE(people, labels.size() / 1000) << "people are in no map";
}

TEST(Labels, aNetworkLabelsKeyframes) {
    const std::string film = filmOf("office", "--frames 60 --every 2 --size 320x240");
    if (HasFatalFailure()) return;
    const TestFolder folder;
    // Class 1 is what is darker than it is bright, class 2 the rest.
    writeSmallOnnx(folder / "light.onnx", 320, 240, {0, 0, 0, -1, -1, -1, 1, 1, 1},
                   {-9, 1.5F, -1.5F});
    folder.write("names.ini", "[1]\nname = dark\n[2]\nname = bright\n");
    const std::string run =
        mapped(film, folder / "run",
               "--set 'SemanticOptions.model=" + folder / "light.onnx" +
                   "' --set 'SemanticOptions.model_labels=" + folder / "names.ini" + "'");
    if (HasFatalFailure()) return;
    const auto labels = labelsOf(run + "/labels.ply");
    std::array<std::size_t, 3> counts{};
    for (const auto& [place, label] : labels) ++counts.at(static_cast<std::size_t>(label));
    EXPECT_GT(counts[1], labels.size() / 20);
    EXPECT_GT(counts[2], labels.size() / 20);
    EXPECT_EQ(json::parse(std::ifstream(run + "/objects.json"))["classes"]["2"], "bright");

    mapped(film, folder / "run");
    if (HasFatalFailure()) return;
    for (const char* name : {"labels.ply", "labels.png", "objects.json"})
        EXPECT_FALSE(fs::exists(run + "/" + name)) << name << " of the run before";
}

}  // namespace
}  // namespace rgbd_graphslam
