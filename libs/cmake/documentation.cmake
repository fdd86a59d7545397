# `cmake --build build/release --target doc`: API reference of the public headers, in api/html.
find_program(DOXYGEN doxygen)
if(DOXYGEN)
    file(GLOB include_folders libs/*/include)
    list(JOIN include_folders " " include_folders)
    configure_file(doc/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
    add_custom_target(doc COMMAND ${DOXYGEN} ${PROJECT_BINARY_DIR}/Doxyfile
        WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} COMMENT "Writing the API reference to api/html")
endif()
