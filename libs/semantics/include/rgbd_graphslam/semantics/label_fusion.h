/** Labels of many views in one map. */
#pragma once
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "rgbd_graphslam/geometry/se3.h"
#include "rgbd_graphslam/mapping/depth_view.h"
#include "rgbd_graphslam/mapping/voxel_table.h"
#include "rgbd_graphslam/semantics/label_vote.h"

namespace rgbd_graphslam {

/** A piece of labeled surface. */
struct LabeledVoxel {
    LabelVote vote;
    Eigen::Vector3f offset = Eigen::Vector3f::Zero();  // sum over readings, in voxels
    std::uint32_t readings = 0, views = 0;
};

/** Where an image saw a voxel. */
struct LabelSight {
    std::uint64_t voxel;  // its key
    std::uint16_t u, v;   // px
};

/** Readings of depth images with the labels of the pixels that they belong to. */
class LabelFusion {
  public:
    explicit LabelFusion(double voxel_m) : voxel_m_(voxel_m) {}

    /** \param labels CV_16UC1 of the view's size, 0 = no class. Pixels beside those of another
     *         class say nothing: outlines in label images and in depth differ by a pixel or two
     *  \return a thinned list of what the image showed where */
    std::vector<LabelSight> insert(const SE3& T_world_cam, const DepthView& view,
                                   const cv::Mat& labels);

    const VoxelTable<LabeledVoxel>& voxels() const { return voxels_; }
    double voxelSize() const { return voxel_m_; }

    /** Mean of the readings in an entry's voxel, m. */
    Eigen::Vector3f position(const VoxelTable<LabeledVoxel>::Entry& entry) const;

  private:
    /** What one image shows in a voxel. */
    struct FrameVoxel {
        std::array<std::uint16_t, 2> labels{};  // a third class in one voxel is left out
        std::array<int, 2> readings{};
        void add(int label);
    };

    double voxel_m_;
    VoxelTable<LabeledVoxel> voxels_;
    VoxelTable<FrameVoxel> frame_;
};

}  // namespace rgbd_graphslam
