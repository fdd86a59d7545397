/** Where each format is made. */
#pragma once
#include <memory>

#include "rgbd_graphslam/export/exporter.h"

namespace rgbd_graphslam {

std::unique_ptr<const Exporter> tumExporter();
std::unique_ptr<const Exporter> kittiExporter();
std::unique_ptr<const Exporter> eurocExporter();
std::unique_ptr<const Exporter> g2oExporter();
std::unique_ptr<const Exporter> nerfstudioExporter();
std::unique_ptr<const Exporter> colmapExporter();
std::unique_ptr<const Exporter> glbExporter();
std::unique_ptr<const Exporter> objExporter();
std::unique_ptr<const Exporter> ros2BagExporter();
std::unique_ptr<const Exporter> metricMapExporter();
std::unique_ptr<const Exporter> kmlExporter();
std::unique_ptr<const Exporter> geoJsonExporter();

}  // namespace rgbd_graphslam
