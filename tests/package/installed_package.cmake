# Installs the build tree into a scratch prefix and builds a project against it that knows nothing
# of the source tree, then runs that project's program on the sample rawlog.
# BUILD, SOURCE, SCRATCH: folders; GENERATOR: of CMake; SANITIZE: the build's sanitizers, if any.
function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
    if(NOT code EQUAL 0)
        list(JOIN ARGN " " command)
        message(FATAL_ERROR "${command}\nended with ${code}:\n${text}")
    endif()
    set(output "${text}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix)
set(flags "")
if(SANITIZE)
    set(flags -DCMAKE_CXX_FLAGS=-fsanitize=${SANITIZE})
endif()
run(${CMAKE_COMMAND} -S ${SOURCE}/tests/package/consumer -B ${SCRATCH}/build -G ${GENERATOR}
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix ${flags})
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)

run(${SCRATCH}/build/consumer ${SCRATCH}/prefix/share/rgbd_graphslam/ini/default.ini
    ${SOURCE}/rawlogs/office_sample.rawlog)
if(NOT output MATCHES "([0-9]+) frames, ([0-9]+) lost, ([0-9]+) keyframes")
    message(FATAL_ERROR "the consumer said:\n${output}")
endif()
if(CMAKE_MATCH_1 LESS 50 OR CMAKE_MATCH_2 GREATER 0 OR CMAKE_MATCH_3 LESS 5)
    message(FATAL_ERROR "the consumer tracked badly:\n${output}")
endif()
