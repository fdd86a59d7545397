# SLAM and maps from Python, on the sample's images.
# PYTHON: interpreter. MODULE: folder of the module. EXPORT: rawlog2tum. RAWLOG: a recording. SCRIPT: the test.
# SCRATCH: a folder.
cmake_minimum_required(VERSION 3.22)
function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
    if(NOT code EQUAL 0)
        message(FATAL_ERROR "${ARGN}\nended with ${code} and said:\n${text}")
    endif()
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
run(${EXPORT} ${RAWLOG} ${SCRATCH} -q)
run(${PYTHON} ${SCRIPT} ${MODULE} ${SCRATCH})
