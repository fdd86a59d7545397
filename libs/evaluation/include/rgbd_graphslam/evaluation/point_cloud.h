/** Colored points from RGB-D images, as the TUM benchmark's tools make them. */
#pragma once
#include <string>
#include <unordered_set>
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/ply.h"
#include "rgbd_graphslam/geometry/rgbd_image.h"
#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** How points are thinned. */
struct PointCloudOptions {
    int every_pixel = 1;     // take each n-th pixel across and down
    double max_depth_m = 0;  // leave out what is farther; 0: nothing
    double voxel_m = 0;      // keep one point in each cube of this side; 0: all points
};

/** Gathers the points of many images. */
class PointCloudBuilder {
  public:
    /** \throws Error for an option out of range */
    PointCloudBuilder(const Camera& camera, const PointCloudOptions& options);

    /** Adds the pixels that have a depth; with distortion, along their true rays.
     *  \param image with color, of the camera's size
     *  \throws Error when it is of another size */
    void add(const RgbdImage& image, const SE3& T_world_cam);

    const PlyModel& cloud() const { return cloud_; }

  private:
    bool isNew(const Eigen::Vector3d& p);

    PointCloudOptions options_;
    int width_, height_;
    std::vector<Eigen::Vector3d> rays_;  // of depth 1, row by row
    std::unordered_set<std::uint64_t> taken_voxels_;
    PlyModel cloud_;
};

/** The files of one RGB-D image and where it was taken. */
struct PosedImageFiles {
    std::string color, depth;
    SE3 T_world_cam;
};

/** Images of two lists ("stamp file") associated with each other and, by the stamp of the color
 *  image, with a trajectory; file names are relative to the lists' folders.
 *  \throws Error when nothing fits together */
std::vector<PosedImageFiles> posedImages(const std::string& color_list,
                                         const std::string& depth_list,
                                         const Trajectory& trajectory, double max_difference_s);

/** As posedImages, for a list of pairs that is already made ("stamp file stamp file"). */
std::vector<PosedImageFiles> posedImages(const std::string& pair_list, const Trajectory& trajectory,
                                         double max_difference_s);

/** \param depth_unit_m meters a unit of the depth image
 *  \throws Error naming the file when one cannot be read, depth is not 16-bit or sizes differ */
RgbdImage readRgbdImage(const std::string& color, const std::string& depth, double depth_unit_m);

}  // namespace rgbd_graphslam
