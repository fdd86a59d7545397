# For full builds with less CPU time: sources are compiled some at a time, so that the headers they share
# are parsed once. Off by default, since then a change rebuilds one file only, and every file has to
# include what it uses.
option(RGBD_FAST_BUILD "Compile several sources at a time" OFF)

# These share local names with other sources of their library and are compiled by themselves. A file
# that is refused with this option ("redefinition of ...") and not without it belongs to them.
set(rgbd_separate_sources
    accelerometer_check.cpp camera_file.cpp
    colmap.cpp depth_view.cpp drift.cpp fast_detector.cpp
    floor.cpp framing.cpp free_space.cpp furniture.cpp gyroscope_check.cpp intrinsics_file.cpp
    keyframe_alignment.cpp keyframe_sheet.cpp lag_check.cpp lens_warp.cpp
    map_accuracy.cpp map_adjustment.cpp mcap_file.cpp motion.cpp navigation_map.cpp
    nerfstudio.cpp numbered_files.cpp octree_builder.cpp orb_extractor.cpp panel_set.cpp
    picture_marks.cpp places.cpp plot_curve.cpp replay.cpp rgbd_observation.cpp rolling_shutter.cpp
    ros_images.cpp rpe.cpp scenario.cpp scene_overlay.cpp sensor_watch.cpp
    sequence_archive.cpp signed_axes.cpp stereo_depth.cpp stereo_frame.cpp stereo_matcher.cpp
    stereo_rectifier.cpp surface_nets.cpp surface_spread.cpp textured_mesh.cpp
    camera_file_test.cpp camera_properties_test.cpp cpu_budget_test.cpp
    drive_test.cpp folders_test.cpp framing_test.cpp graph_slam_session_test.cpp list_forms_test.cpp
    live_run_test.cpp marked_picture_test.cpp mesh_test.cpp mouse_gesture_test.cpp
    occupancy_volume_test.cpp picking_test.cpp pose_graph_test.cpp replay_clock_test.cpp
    run_checks_test.cpp saved_slam_test.cpp sequence_layout_test.cpp slam_job_test.cpp
    stereo_frame_test.cpp stereo_matcher_test.cpp stereo_slam_test.cpp)

# rgbd_build_fast(TARGET files...): `files` are the sources of the target.
function(rgbd_build_fast target)
    if(NOT RGBD_FAST_BUILD)
        return()
    endif()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    foreach(source ${ARGN})
        get_filename_component(name ${source} NAME)
        if(name IN_LIST rgbd_separate_sources)
            set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
        endif()
    endforeach()
endfunction()
