/** SLAM in a program of one's own: consumer INI RAWLOG. */
#include <rgbd_graphslam/dataset/rawlog_reader.h>
#include <rgbd_graphslam/graphslam/graph_slam_session.h>

#include <cstdio>
#include <optional>

using mrpt::obs::CObservation3DRangeScan;

int main(int, char** argv) {
    rgbd_graphslam::SlamOptions options;
    rgbd_graphslam::IniFile::fromFile(argv[1]).loadKnown(options.all());
    std::optional<rgbd_graphslam::GraphSlamSession> session;
    rgbd_graphslam::RawlogReader rawlog(argv[2]);
    int lost = 0;
    while (const auto observation = rawlog.next()) {
        const auto frame = std::dynamic_pointer_cast<CObservation3DRangeScan>(observation);
        if (!frame) continue;
        if (!session) session.emplace(options, *frame);
        lost += session->step(frame).origin == rgbd_graphslam::FrameOrigin::Lost;
    }
    session->finish();
    std::printf("%zu frames, %d lost, %zu keyframes\n", session->slam().frames().size(), lost,
                session->slam().keyframes().size());
}
