# The viewer opens its window on a display without hardware (Xvfb) and shows a run: the scene, and the
# panels, each by itself, so that neither hides that the other is missing; it follows a run and may be killed without harm; without a display it says so in one line, and --snapshot works all the same.
# APP: rgbd-viewer. SLAM: rgbd-slam. RAWLOG, INI: a short run. SCRATCH: a folder for it all.
cmake_minimum_required(VERSION 3.22)

find_program(XVFB_RUN xvfb-run)
if(NOT XVFB_RUN)
    message(STATUS "SKIPPED: no xvfb-run (Debian's package xvfb)")
    return()
endif()
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})
set(ENV{XDG_CONFIG_HOME} ${SCRATCH}/config)

execute_process(COMMAND ${SLAM} --quiet --max-frames 40 ${INI} ${RAWLOG} -o ${SCRATCH}/out
    COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)

# One color packs into a few kB; a room or an image does not.
function(expect_picture file)
    if(NOT EXISTS ${file})
        message(FATAL_ERROR "${file} was not written")
    endif()
    file(SIZE ${file} bytes)
    if(bytes LESS 60000)
        message(FATAL_ERROR "${file} has ${bytes} bytes: it is blank or nearly so")
    endif()
endfunction()

function(expect_blank file)
    file(SIZE ${file} bytes)
    if(bytes GREATER 30000)
        message(FATAL_ERROR "${file} has ${bytes} bytes: it shows what is switched off")
    endif()
endfunction()

# The window with every switch of a list off, as NAME.png.
function(screenshot name)
    set(settings "[ViewerSettings]\n")
    foreach(switch ${ARGN})
        string(APPEND settings "${switch} = false\n")
    endforeach()
    file(WRITE ${SCRATCH}/config/rgbd-graphslam/viewer.ini "${settings}")
    execute_process(
        COMMAND ${XVFB_RUN} -a -s "-screen 0 1400x900x24"
            ${APP} ${SCRATCH}/out --screenshot ${SCRATCH}/${name}.png
        RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text TIMEOUT 120)
    if(NOT code EQUAL 0)
        message(FATAL_ERROR "the viewer ended with ${code} and said:\n${text}")
    endif()
endfunction()

set(panels view_panel image_panel plot_panel time_panel)
set(scene points floor trajectory truth keyframes loops)
screenshot(scene ${panels})
expect_picture(${SCRATCH}/scene.png)
screenshot(panels ${scene})
expect_picture(${SCRATCH}/panels.png)
screenshot(nothing ${panels} ${scene})
expect_blank(${SCRATCH}/nothing.png)
file(REMOVE ${SCRATCH}/config/rgbd-graphslam/viewer.ini)

# The time is for machines with much else to do: such a viewer has the lowest priority.
# A run that is followed: the result is shown when it ends, and it is the same as without a viewer;
# so it is when the viewer is killed.
file(WRITE ${SCRATCH}/follow.sh "
'${APP}' --follow out-followed --screenshot followed.png & viewer=$!
'${SLAM}' -q --max-frames 40 '${INI}' '${RAWLOG}' -o out-followed || exit 1
wait $viewer || exit 2
'${APP}' --follow out-killed & viewer=$!
(while ! [ -S out-killed/live.socket ]; do sleep 0.02; done; sleep 0.1; kill -9 $viewer) & killer=$!
'${SLAM}' -q --no-maps --max-frames 40 '${INI}' '${RAWLOG}' -o out-killed || exit 3
wait $killer || exit 4
cmp out/trajectory.txt out-followed/trajectory.txt && cmp out/trajectory.txt out-killed/trajectory.txt")
execute_process(COMMAND ${XVFB_RUN} -a -s "-screen 0 1400x900x24" sh ${SCRATCH}/follow.sh
    WORKING_DIRECTORY ${SCRATCH}
    RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text TIMEOUT 800)
if(NOT code EQUAL 0)
    message(FATAL_ERROR "following a run ended with ${code} and said:\n${text}")
endif()
expect_picture(${SCRATCH}/followed.png)

unset(ENV{DISPLAY})
unset(ENV{WAYLAND_DISPLAY})
execute_process(COMMAND ${APP} ${SCRATCH}/out
    RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text TIMEOUT 60)
if(code EQUAL 0 OR NOT text MATCHES "^rgbd-viewer: error: no window can be opened[^\n]*--snapshot[^\n]*\n$")
    message(FATAL_ERROR "without a display the viewer ended with ${code} and said:\n${text}")
endif()
execute_process(COMMAND ${APP} ${SCRATCH}/out --quiet --snapshot ${SCRATCH}/snapshot.png
    COMMAND_ERROR_IS_FATAL ANY TIMEOUT 120)
expect_picture(${SCRATCH}/snapshot.png)
