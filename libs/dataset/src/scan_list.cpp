#include "scan_list.h"

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "list_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"

namespace rgbd_graphslam {
namespace {

constexpr double degree = M_PI / 180;

/** What the comments above the first scan tell. */
std::map<std::string, std::string> headerOf(const std::string& path) {
    std::map<std::string, std::string> values;
    std::ifstream in(path);
    for (std::string line; std::getline(in, line) && !line.empty() && line[0] == '#';) {
        const auto equals = line.find('=');
        if (equals == std::string::npos) continue;
        std::istringstream key(line.substr(1, equals - 1));
        std::string name;
        if (key >> name) values[name] = line.substr(equals + 1);
    }
    return values;
}

/** The numbers of a header's line, brackets apart. */
std::vector<double> numbersOf(std::string text) {
    for (char& c : text) {
        if (c == '[' || c == ']' || c == ',') c = ' ';
    }
    std::istringstream in(text);
    std::vector<double> numbers;
    for (double value; in >> value;) numbers.push_back(value);
    return numbers;
}

/** All that scans have in common. */
mrpt::obs::CObservation2DRangeScan scannerOf(const std::string& path) {
    auto header = headerOf(path);
    const auto aperture = numbersOf(header["aperture_deg"]),
               range = numbersOf(header["max_range_m"]), pose = numbersOf(header["sensor_pose"]);
    if (aperture.size() != 1 || range.size() != 1 || (!pose.empty() && pose.size() != 6)) {
        throw Error("'" + path +
                        "' lacks '# aperture_deg = DEGREES', '# max_range_m = METERS' or "
                        "has a sensor_pose that is not [x y z yaw pitch roll]",
                    "write them above the first scan");
    }
    mrpt::obs::CObservation2DRangeScan scan;
    scan.sensorLabel = "LASER";
    scan.aperture = static_cast<float>(aperture[0] * degree);
    scan.maxRange = static_cast<float>(range[0]);
    scan.rightToLeft = true;
    if (!pose.empty()) {
        scan.sensorPose = mrpt::poses::CPose3D(pose[0], pose[1], pose[2], pose[3] * degree,
                                               pose[4] * degree, pose[5] * degree);
    }
    return scan;
}

void setRanges(const std::vector<float>& ranges, mrpt::obs::CObservation2DRangeScan& scan) {
    scan.resizeScan(ranges.size());
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        scan.setScanRange(i, ranges[i]);
        scan.setScanRangeValidity(i, ranges[i] > 0);
    }
}

}  // namespace

std::vector<mrpt::obs::CObservation::Ptr> readScanList(const std::string& path) {
    std::vector<mrpt::obs::CObservation::Ptr> scans;
    if (!std::filesystem::exists(path)) return scans;
    const auto scanner = scannerOf(path);
    const std::string form = "stamp range range ...";
    std::size_t beams = 0;
    forEachLine(path, [&](Line& line) {
        const double stamp_s = line.realNumber(form);
        std::vector<float> ranges;
        std::istringstream rest(line.rest());
        for (std::string word; rest >> word;) {
            const auto range = numberIn(word);
            if (!range) line.refuse("'" + word + "' is no range", form);
            ranges.push_back(static_cast<float>(*range));
        }
        if (beams == 0) beams = ranges.size();
        if (ranges.size() < 2 || ranges.size() != beams) {
            line.refuse("not as many ranges as in the first scan, or fewer than 2", form);
        }
        const auto scan = std::make_shared<mrpt::obs::CObservation2DRangeScan>(scanner);
        scan->timestamp = toMrptTime(stamp_s);
        setRanges(ranges, *scan);
        scans.push_back(scan);
    });
    return scans;
}

}  // namespace rgbd_graphslam
