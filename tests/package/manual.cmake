# The manual page of APP names every option of its --help and pleases groff; its completion works.
get_filename_component(name ${APP} NAME)
execute_process(COMMAND ${APP} --help OUTPUT_VARIABLE help)
execute_process(COMMAND ${APP} --print-man-page OUTPUT_VARIABLE page OUTPUT_FILE ${SCRATCH}.1)
file(READ ${SCRATCH}.1 page)
string(REPLACE "\\-" "-" page "${page}")
execute_process(COMMAND ${APP} --print-bash-completion OUTPUT_FILE ${SCRATCH}.bash)

string(REGEX MATCHALL "\n  (-[a-z],)?--[a-z][a-z-]*" lines "${help}")
if(NOT lines)
    message(SEND_ERROR "--help of ${name} shows no option:\n${help}")
endif()
foreach(line ${lines})
    string(REGEX REPLACE "^.*(--[a-z-]+)$" "\\1" option "${line}")
    if(NOT page MATCHES "${option}")
        message(SEND_ERROR "${option} is not in the manual page of ${name}")
    endif()
endforeach()

find_program(GROFF groff)
if(GROFF)
    execute_process(COMMAND ${GROFF} -man -ww -z -Tutf8 ${SCRATCH}.1 ERROR_VARIABLE complaints)
    if(complaints)
        message(SEND_ERROR "groff about the manual page of ${name}:\n${complaints}")
    endif()
endif()

string(REPLACE "-" "_" function "_${name}")
execute_process(
    COMMAND bash -c "source ${SCRATCH}.bash; COMP_WORDS=(${name} --verb); COMP_CWORD=1; ${function}; echo \${COMPREPLY[@]}"
    OUTPUT_VARIABLE words OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT words STREQUAL "--verbose")
    message(SEND_ERROR "'${name} --verb' is completed to '${words}'")
endif()
