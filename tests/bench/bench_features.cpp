/** Feature extraction: the whole, its stages, OpenCV's ORB, and the memory it has to touch. */
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>
#include <opencv2/core/utility.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "../../libs/features/src/fast_detector.h"
#include "../../libs/features/src/patch_orientation.h"
#include "../../libs/features/src/smoothing.h"
#include "rgbd_graphslam/features/frame_builder.h"

namespace rgbd_graphslam {
namespace {

constexpr int border_px = 21;  // more than the largest patch

/** Blurred random squares: corners of every contrast all over the image. */
cv::Mat texturedImage() {
    cv::RNG random(7);
    cv::Mat image(480, 640, CV_8UC1, cv::Scalar(120));
    for (int i = 0; i < 900; ++i) {
        const cv::Rect box(random.uniform(-20, 640), random.uniform(-20, 480),
                           random.uniform(6, 60), random.uniform(6, 60));
        cv::rectangle(image, box, cv::Scalar(random.uniform(0, 255)), cv::FILLED);
    }
    cv::GaussianBlur(image, image, {3, 3}, 0.8);
    return image;
}

const RgbdImage& texturedFrame() {
    static const RgbdImage frame = [] {
        RgbdImage made;
        made.gray = texturedImage();
        made.depth.create(480, 640, CV_16UC1);
        cv::RNG(8).fill(made.depth, cv::RNG::UNIFORM, 1990, 2010);
        return made;
    }();
    return frame;
}

FeatureOptions optionsFor(const benchmark::State& state) {
    FeatureOptions options;
    options.count = static_cast<int>(state.range(0));
    return options;
}

cv::Size levelSize(const FeatureOptions& options, int level) {
    const double scale = std::pow(options.scale_factor, level);
    return {static_cast<int>(std::lround(640 / scale)), static_cast<int>(std::lround(480 / scale))};
}

std::vector<cv::Mat> sharpPyramid(const FeatureOptions& options) {
    std::vector<cv::Mat> levels = {texturedFrame().gray};
    for (int l = 1; l < options.levels; ++l) {
        cv::Mat next;
        cv::resize(levels.back(), next, levelSize(options, l), 0, 0, cv::INTER_LINEAR);
        levels.push_back(next);
    }
    return levels;
}

std::vector<FastCorner> cornersOf(const cv::Mat& level, int threshold) {
    const cv::Rect inner(border_px, border_px, level.cols - 2 * border_px,
                         level.rows - 2 * border_px);
    std::vector<FastCorner> corners;
    detectFast(level, inner, threshold, corners);
    return corners;
}

/** Bytes that extraction cannot avoid to read or write, had it no cache: the image is copied, every
 *  level but the last is shrunk, all are smoothed, and all are searched for corners. */
double pyramidTraffic(const FeatureOptions& options) {
    double all = 0;
    for (int l = 0; l < options.levels; ++l) all += levelSize(options, l).area();
    const double first = levelSize(options, 0).area();
    const double last = levelSize(options, options.levels - 1).area();
    const double copied_and_shrunk = first + (all - last) + all;
    const double smoothed = 2 * all, searched = all;
    return copied_and_shrunk + smoothed + searched;
}

void wholeFrame(benchmark::State& state) {
    Intrinsics camera;
    if (state.range(1)) camera.lens = BrownLens{{0.2624, -0.9531, -0.0054, 0.0026, 1.1633}};
    const FrameBuilder builder(optionsFor(state), camera);
    std::size_t keypoints = 0;
    for (auto _ : state) keypoints = builder.build(texturedFrame()).keypoints.size();
    state.counters["features"] = static_cast<double>(keypoints);
}
BENCHMARK(wholeFrame)
    ->ArgNames({"count", "distorted"})
    ->ArgsProduct({{500, 1000, 2000}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

void extraction(benchmark::State& state) {
    const FeatureOptions options = optionsFor(state);
    const OrbExtractor extractor(options);
    std::size_t corners = 0;
    for (auto _ : state) corners = extractor.extract(texturedFrame().gray).corners.size();
    state.counters["features"] = static_cast<double>(corners);
    state.counters["traffic_bytes"] = pyramidTraffic(options);
}
BENCHMARK(extraction)
    ->ArgName("count")
    ->Arg(500)
    ->Arg(1000)
    ->Arg(2000)
    ->Unit(benchmark::kMillisecond);

/** Fixed numbers of calls, for counting instructions: the difference of two runs leaves start-up
 * out. */
void extractionCalls(benchmark::State& state) {
    extraction(state);
}
BENCHMARK(extractionCalls)->Arg(500)->Arg(2000)->Iterations(1);
BENCHMARK(extractionCalls)->Arg(500)->Arg(2000)->Iterations(6);

void openCvOrb(benchmark::State& state) {
    const FeatureOptions options = optionsFor(state);
    const auto orb =
        cv::ORB::create(options.count, static_cast<float>(options.scale_factor), options.levels, 31,
                        0, 2, cv::ORB::HARRIS_SCORE, 31, options.fast_threshold);
    std::vector<cv::KeyPoint> keypoints;
    cv::Mat descriptors;
    for (auto _ : state) {
        orb->detectAndCompute(texturedFrame().gray, cv::noArray(), keypoints, descriptors);
    }
    state.counters["features"] = static_cast<double>(keypoints.size());
}
BENCHMARK(openCvOrb)->ArgName("count")->Arg(500)->Arg(1000)->Arg(2000)->Unit(
    benchmark::kMillisecond);

void stageShrinkAndSmooth(benchmark::State& state) {
    const FeatureOptions options;
    cv::Mat smoothed(texturedFrame().gray.size(), CV_8UC1);
    for (auto _ : state) {
        for (const cv::Mat& level : sharpPyramid(options)) smooth(level, smoothed);
    }
}
BENCHMARK(stageShrinkAndSmooth)->Unit(benchmark::kMillisecond);

void stageFast(benchmark::State& state) {
    const FeatureOptions options;
    const auto levels = sharpPyramid(options);
    std::size_t found = 0;
    for (auto _ : state) {
        found = 0;
        for (const cv::Mat& level : levels) {
            found += cornersOf(level, options.fast_threshold_min).size();
        }
    }
    state.counters["corners"] = static_cast<double>(found);
}
BENCHMARK(stageFast)->Unit(benchmark::kMillisecond);

void stageOrientation(benchmark::State& state) {
    const cv::Mat& image = texturedFrame().gray;
    const auto corners = cornersOf(image, 7);
    for (auto _ : state) {
        for (int i = 0; i < 1000; ++i) {
            const FastCorner& c = corners[i % corners.size()];
            benchmark::DoNotOptimize(patchOrientation(image, c.x, c.y));
        }
    }
}
BENCHMARK(stageOrientation)->Unit(benchmark::kMillisecond);

void stageDepth(benchmark::State& state) {
    const FeatureOptions options;
    const auto corners = cornersOf(texturedFrame().gray, 7);
    for (auto _ : state) {
        for (int i = 0; i < 1000; ++i) {
            const FastCorner& c = corners[i % corners.size()];
            benchmark::DoNotOptimize(foregroundDepth(texturedFrame().depth, 0.001,
                                                     static_cast<float>(c.x),
                                                     static_cast<float>(c.y), options));
        }
    }
}
BENCHMARK(stageDepth)->Unit(benchmark::kMillisecond);

/** A thousand patches found half a pixel from where they were looked for. */
void stageAlignment(benchmark::State& state) {
    const auto features = OrbExtractor(FeatureOptions{}).extract(texturedFrame().gray);
    std::vector<Patch> moved = features.patches;
    for (Patch& patch : moved) patch.corner += cv::Point2f(0.4F, -0.3F);
    const PatchMotion motion{1, static_cast<float>(0.1 * state.range(0))};
    std::size_t found = 0;
    for (auto _ : state) {
        found = 0;
        for (std::size_t i = 0; i < moved.size(); ++i) {
            found += alignPatch(features.patches[i], motion, moved[i]).has_value();
        }
    }
    state.counters["found"] = static_cast<double>(found);
}
BENCHMARK(stageAlignment)->ArgName("turned")->Arg(0)->Arg(3)->Unit(benchmark::kMillisecond);

/** The limit: moving as many bytes as extraction must touch, and nothing else. */
void copyOfPyramidTraffic(benchmark::State& state) {
    const auto half = static_cast<std::size_t>(pyramidTraffic(FeatureOptions()) / 2);
    std::vector<char> from(half, 1), to(half);
    for (auto _ : state) {
        std::memcpy(to.data(), from.data(), half);
        benchmark::ClobberMemory();
    }
    state.counters["traffic_bytes"] = 2.0 * static_cast<double>(half);
}
BENCHMARK(copyOfPyramidTraffic)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rgbd_graphslam

int main(int argc, char** argv) {
    cv::setNumThreads(1);  // one core's cost, as in the pipeline
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
