# Every public header says at its top what it holds, and every class says what it is. ROOT: folder that
# holds libs/.
cmake_minimum_required(VERSION 3.22)

set(missing "")
file(GLOB headers RELATIVE ${ROOT} ${ROOT}/libs/*/include/rgbd_graphslam/*/*.h)
foreach(header ${headers})
    file(READ ${ROOT}/${header} text)
    string(REGEX REPLACE "[][;]" "," text "${text}")  # CMake's lists would break there
    if(NOT text MATCHES "^/\\*\\* ")
        list(APPEND missing "${header}: no docstring at its top")
    endif()
    string(REGEX MATCHALL "[^\n]*\n(template[^\n]*\n)?(class|struct|enum class) [A-Za-z0-9_]+[^\n;]*{"
        definitions "${text}")
    foreach(definition ${definitions})
        if(NOT definition MATCHES "\\*/\n")
            string(REGEX REPLACE "^[^\n]*\n" "" definition "${definition}")
            list(APPEND missing "${header}: no docstring of ${definition}")
        endif()
    endforeach()
endforeach()

if(NOT headers)
    message(FATAL_ERROR "no headers found under ${ROOT}/libs")
endif()
if(missing)
    list(JOIN missing "\n  " text)
    message(FATAL_ERROR "public headers have docstrings (CONTRIBUTING.md), but:\n  ${text}")
endif()
