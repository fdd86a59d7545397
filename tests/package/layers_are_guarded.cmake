# Proves that layers.cmake notices each kind of violation. SCRATCH: folder to make houses in.

# Runs the check on a house of one library with one include.
function(check layer include result message)
    file(REMOVE_RECURSE ${SCRATCH})
    file(WRITE ${SCRATCH}/libs/${layer}/src/room.cpp "#include ${include}\n")
    execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${SCRATCH}
        -P ${CMAKE_CURRENT_LIST_DIR}/layers.cmake RESULT_VARIABLE code OUTPUT_QUIET ERROR_VARIABLE error)
    set(${result} ${code} PARENT_SCOPE)
    set(${message} "${error}" PARENT_SCOPE)
endfunction()

function(expect_refused layer include)
    check(${layer} ${include} code error)
    if(code EQUAL 0 OR NOT error MATCHES "room.cpp")
        message(SEND_ERROR "${layer} includes ${include} unnoticed:\n${error}")
    endif()
endfunction()

expect_refused(core "\"rgbd_graphslam/geometry/se3.h\"")
expect_refused(mapping "\"rgbd_graphslam/job/slam_job.h\"")
expect_refused(slam "\"rgbd_graphslam/dataset/rawlog_reader.h\"")
expect_refused(estimation "\"rgbd_graphslam/slam/slam_map.h\"")
expect_refused(estimation "\"rgbd_graphslam/dataset/rawlog_reader.h\"")
expect_refused(features "<mrpt/obs/CObservation3DRangeScan.h>")
expect_refused(slam "<fstream>")
expect_refused(viewer "<mrpt/gui/CDisplayWindow3D.h>")
expect_refused(mapping "\"rgbd_graphslam/nowhere/thing.h\"")

check(mapping "\"rgbd_graphslam/dataset/rawlog_reader.h\"" code error)
if(NOT code EQUAL 0)
    message(SEND_ERROR "mapping may not include dataset, which lies below it:\n${error}")
endif()
