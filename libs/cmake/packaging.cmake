# Debian packages, made by `./run.sh package`:
#   rgbd-graphslam          programs, settings, manual pages, completion, sample, documentation
#   python3-rgbd-graphslam  Python module, if pybind11 is there
#   librgbd-graphslam-dev   headers, static libraries, CMake targets, examples
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME rgbd-graphslam)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
# As Debian's tools do, name whoever makes the packages.
set(maintainer "rgbd-graphslam developers")
set(maintainer_address rgbd-graphslam@localhost.localdomain)
if(DEFINED ENV{DEBFULLNAME})
    set(maintainer "$ENV{DEBFULLNAME}")
endif()
if(DEFINED ENV{DEBEMAIL})
    set(maintainer_address "$ENV{DEBEMAIL}")
endif()
set(CPACK_PACKAGE_CONTACT "${maintainer} <${maintainer_address}>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(components runtime dev)
if(RGBD_BUILD_PYTHON)
    list(APPEND components python)
endif()
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION TRUE)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME rgbd-graphslam)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
# gnuplot draws the plots of rgbd-eval; EGL and Mesa draw the viewer's pictures without a display.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "gnuplot-nox, libegl1, libgl1-mesa-dri")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
"Takes recordings of RGB-D cameras such as Kinect and RealSense and produces the
camera trajectory, a loop-closed pose graph, and 3-D and navigation maps. Tools
to import, evaluate, view and export are included.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME librgbd-graphslam-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
string(CONCAT CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
    "libmrpt-graphslam-dev, libmrpt-nav-dev, libmrpt-nanogui-dev, libmrpt-hwdrivers-dev, "
    "libeigen3-dev, libopencv-dev, "
    "libceres-dev, liboctomap-dev, nlohmann-json3-dev, libarchive-dev, libsqlite3-dev, "
    "zlib1g-dev, libcurl4-openssl-dev, libglfw3-dev, libgl-dev, libopengl-dev")
set(CPACK_COMPONENT_DEV_DESCRIPTION
"Headers, static libraries and CMake targets to embed RGB-D SLAM in programs:
find_package(rgbd_graphslam), then link to rgbd_graphslam::graphslam.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-rgbd-graphslam)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
"RGB-D SLAM on NumPy images: poses, point clouds and floor plans.")

# What Debian's policy wants of every package: a copyright file and a changelog.
string(TIMESTAMP date "%a, %d %b %Y 00:00:00 +0000" UTC)
set(changelog ${PROJECT_BINARY_DIR}/changelog.Debian)
file(CONFIGURE OUTPUT ${changelog} CONTENT [[
rgbd-graphslam (@PROJECT_VERSION@-@CPACK_DEBIAN_PACKAGE_RELEASE@) stable; urgency=medium

  * See CHANGELOG.md of the sources.

 -- @CPACK_PACKAGE_CONTACT@  @date@
]] @ONLY)
execute_process(COMMAND gzip -9nkf ${changelog} COMMAND_ERROR_IS_FATAL ANY)
foreach(component ${components})
    string(TOUPPER ${component} COMPONENT)
    set(documents ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME})
    install(FILES LICENSE RENAME copyright DESTINATION ${documents} COMPONENT ${component})
    install(FILES ${changelog}.gz DESTINATION ${documents} COMPONENT ${component})
endforeach()

include(CPack)
