# APP answers --help and --version, and refuses what it does not know.
function(run result output)
    execute_process(COMMAND ${APP} ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE err)
    set(${result} "${code}" PARENT_SCOPE)
    set(${output} "${out}${err}" PARENT_SCOPE)
endfunction()

run(code text --help)
if(NOT code EQUAL 0 OR NOT text MATCHES "Usage:" OR NOT text MATCHES "--quiet.*--verbose")
    message(SEND_ERROR "--help ended with ${code} and said:\n${text}")
endif()

if(text MATCHES " (INT|UINT|FLOAT|TEXT)[ \n]")
    message(SEND_ERROR "--help names a type of programmers':\n${text}")
endif()

run(code text --version)
if(NOT code EQUAL 0 OR NOT text STREQUAL "${VERSION}\n")
    message(SEND_ERROR "--version ended with ${code} and said:\n${text}")
endif()

run(code text --no-such-option)
get_filename_component(name ${APP} NAME)
if(NOT code EQUAL 1 OR NOT text MATCHES "^${name}: error: '--no-such-option' is not understood here; [^\n]*\n$")
    message(SEND_ERROR "--no-such-option ended with ${code} and said:\n${text}")
endif()
