# A full build at half the CPU time: sources are compiled some at a time, so that the headers they share
# are parsed once. The presets for developers switch it off; there a change rebuilds one file only, and
# every file has to include what it uses.
option(RGBD_FAST_BUILD "Compile several sources at a time" ON)

# These have local names in common with their neighbors, and are compiled by themselves. A file that
# is refused with "redefinition of" belongs here.
set(rgbd_separate_sources
    free_space.cpp motion.cpp navigation_map.cpp nerfstudio.cpp octree_builder.cpp orb_pattern.cpp
    patch.cpp picture_marks.cpp places.cpp plot_curve.cpp rgbd_observation.cpp rpe.cpp
    surface_nets.cpp surface_spread.cpp map_adjustment.cpp view_scale.cpp
    cpu_budget_test.cpp drive_test.cpp frame_stream_test.cpp graph_slam_session_test.cpp
    list_forms_test.cpp mouse_gesture_test.cpp occupancy_volume_test.cpp replay_clock_test.cpp
    run_checks_test.cpp saved_slam_test.cpp se3_properties_test.cpp slam_job_test.cpp)

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
