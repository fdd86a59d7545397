# Doxygen has nothing to say against the public headers and the documents.
# DOXYGEN: the program, or nothing. DOXYFILE, WARNINGS: of the target `doc`. SOURCE: the project.
if(NOT DOXYGEN)
    message(STATUS "SKIPPED: no doxygen")
    return()
endif()
file(REMOVE ${WARNINGS})
execute_process(COMMAND ${DOXYGEN} ${DOXYFILE} WORKING_DIRECTORY ${SOURCE}
    COMMAND_ERROR_IS_FATAL ANY)
file(READ ${WARNINGS} warnings)
if(warnings)
    message(FATAL_ERROR "doxygen warns:\n${warnings}")
endif()
