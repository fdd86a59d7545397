# The programs of apps/examples do what they show, on the sample rawlog.
# EMBED, FOLLOW_STREAM, LOCALIZE: the programs. SLAM: rgbd-slam. RAWLOG: a recording. SCRATCH: a folder.
cmake_minimum_required(VERSION 3.22)

function(run output)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
    if(NOT code EQUAL 0)
        message(FATAL_ERROR "${ARGN}\nended with ${code} and said:\n${text}")
    endif()
    set(${output} "${text}" PARENT_SCOPE)
endfunction()

function(expect text pattern)
    if(NOT text MATCHES "${pattern}")
        message(SEND_ERROR "'${pattern}' does not appear in:\n${text}")
    endif()
endfunction()

# Frame 59 is 59 * 4 px * 1.968 m / 525 px = 0.885 m to the right of the first.
run(text ${EMBED})
expect("${text}" "1.967 s tracked   x 0.8[89][0-9] y -?0.00[0-9] z -?0.00[0-9] m\n[0-9]+ keyframes\n$")

# Twice the pace of the recording; a busy machine may drop frames, but every one is accounted for.
run(text ${FOLLOW_STREAM} ${RAWLOG} 2)
expect("${text}" "^keyframe 0 at -?0.00 -?0.00 -?0.00 m\nkeyframe 1 at ")
expect("${text}" "loop from keyframe [0-9]+ to [0-9]+, [0-9]+ inliers\n")
expect("${text}" "([0-9]+) frames tracked, ([0-9]+) dropped\n$")
string(REGEX REPLACE ".*\n([0-9]+) frames tracked, ([0-9]+) dropped\n$" "\\1+\\2" sum "${text}")
math(EXPR frames "${sum}")

file(REMOVE_RECURSE ${SCRATCH})
run(ignored ${SLAM} ${RAWLOG} -o ${SCRATCH}/map -q)
run(text ${LOCALIZE} ${SCRATCH}/map ${RAWLOG})
string(REGEX MATCHALL "[^\n]*free with [01][.][0-9]+\n" located "${text}")
list(LENGTH located count)
math(EXPR lost "${frames} - ${count}")
if(lost GREATER 1 OR lost LESS 0)
    message(SEND_ERROR "${count} of ${frames} frames are localized:\n${text}")
endif()
# The first camera is above the map's origin and looks along x.
expect("${text}" "x -?0.0[0-9] m y -?0.0[0-9] m heading -?[0-9][.][0-9] deg")
