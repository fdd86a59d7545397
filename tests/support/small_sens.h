/** ScanNet's .sens files, made on the spot. */
#pragma once
#include <zlib.h>

#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>
#include <vector>

namespace rgbd_graphslam {

/** Images are given; color becomes PNG, so that pixels can be compared, depth is packed by zlib.
 */
struct SmallSens {
    /** CV_8UC3 and CV_16UC1 of one size. */
    std::vector<std::pair<cv::Mat, cv::Mat>> frames;
    std::uint64_t stamp_step_us = 33333;
    float fx = 30, depth_fx = 30;

    /** Frame i is at x = i / 2; frame 1 has no pose. */
    std::string bytes() const {
        std::string out;
        put<std::uint32_t>(out, 4);
        put<std::uint64_t>(out, 4);
        out += "name";
        for (const float focal : {fx, 1.f, depth_fx, 1.f}) putMatrix(out, focal);
        put<std::int32_t>(out, 1);
        put<std::int32_t>(out, 1);
        for (int i = 0; i < 2; ++i) {
            put<std::uint32_t>(out, frames.at(0).first.cols);
            put<std::uint32_t>(out, frames.at(0).first.rows);
        }
        put<float>(out, 1000);
        put<std::uint64_t>(out, frames.size());
        for (std::size_t i = 0; i < frames.size(); ++i) putFrame(out, i);
        put<std::uint64_t>(out, 0);  // no IMU frames
        return out;
    }

  private:
    template <class Number>
    static void put(std::string& out, Number number) {
        out.append(reinterpret_cast<const char*>(&number), sizeof number);
    }

    static void putMatrix(std::string& out, float focal) {
        const float m[16] = {focal, 0, 15.5, 0, 0, focal, 11.5, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        for (const float number : m) put(out, number);
    }

    void putFrame(std::string& out, std::size_t i) const {
        const float lost = -std::numeric_limits<float>::infinity();
        const float x = 0.5f * static_cast<float>(i);
        const float pose[16] = {1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        for (const float number : pose) put(out, i == 1 ? lost : number);
        const auto& [color, depth] = frames[i];
        std::vector<unsigned char> png;
        cv::imencode(".png", color, png);
        const uLong depth_bytes = static_cast<uLong>(depth.total() * depth.elemSize());
        std::string packed(compressBound(depth_bytes), '\0');
        uLongf packed_bytes = packed.size();
        compress(reinterpret_cast<Bytef*>(packed.data()), &packed_bytes, depth.data, depth_bytes);
        put<std::uint64_t>(out, 7 + i * stamp_step_us);
        put<std::uint64_t>(out, 0);
        put<std::uint64_t>(out, png.size());
        put<std::uint64_t>(out, packed_bytes);
        out.append(png.begin(), png.end());
        out.append(packed, 0, packed_bytes);
    }
};

}  // namespace rgbd_graphslam
