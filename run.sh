#!/usr/bin/env bash
# Sets the project up on Debian 12 and runs it. Every step can be repeated; what is done is skipped.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

build=build/release
# What the programs need, and what packages, tests and benchmarks need besides.
build_packages=(
    g++ cmake ninja-build
    libmrpt-graphslam-dev libmrpt-nav-dev libmrpt-nanogui-dev libmrpt-hwdrivers-dev
    libeigen3-dev libopencv-dev libceres-dev liboctomap-dev
    libcli11-dev nlohmann-json3-dev libarchive-dev libsqlite3-dev libjpeg-dev zlib1g-dev
    libcurl4-openssl-dev libnanoflann-dev gnuplot-nox
    libgl-dev libopengl-dev libegl1 libgl1-mesa-dri
)
package_packages=(dpkg-dev file pybind11-dev python3-dev python3-numpy)
test_packages=(
    ccache pkg-config mrpt-apps octomap-tools
    libgtest-dev libgmock-dev libbenchmark-dev python3 parallel doxygen
    python3-rosbag python3-sensor-msgs python3-nav-msgs python3-tf2-msgs zstd lz4 xvfb xauth
    colmap assimp-utils
    pybind11-dev python3-dev python3-numpy python3-pil
)

command -v npm >/dev/null || test_packages+=(nodejs npm)

usage() {
    cat <<'END'
usage: ./run.sh COMMAND
  demo     install and build what it needs, run SLAM on the sample rawlog, evaluate it, render its map
  test     install and build everything, run every test
  bench    install, build, measure (see doc/benchmarks.md)
  build    install and build everything
  package  install what it needs, make Debian packages in build/package; DEBFULLNAME and DEBEMAIL name
           their maintainer
  install  install all missing Debian packages
  install-build   install only those that the programs need
END
}

say() { printf '\n== %s\n' "$*"; }

as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    elif command -v sudo >/dev/null; then
        sudo "$@"
    else
        echo "run.sh: error: this needs root or sudo: $*" >&2
        exit 1
    fi
}

installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

install_packages() {
    local missing=()
    for package in "$@"; do
        installed "$package" || missing+=("$package")
    done
    if [ ${#missing[@]} -eq 0 ]; then
        say "Debian packages: all $# are installed"
        return
    fi
    say "Installing from Debian: ${missing[*]}"
    as_root apt-get update -q
    as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -q --no-install-recommends "${missing[@]}"
}

install_all() { install_packages "${build_packages[@]}" "${test_packages[@]}"; }

build_all() {
    say "Building into $build (the first build takes some minutes)"
    cmake --preset "${build##*/}" "$@"
    cmake --build "$build"
}

# The programs that the demo runs, and no tests.
build_demo() {
    say "Building the demo's programs into $build (the first build takes some minutes)"
    [ -f "$build/build.ninja" ] || cmake --preset "${build##*/}" -DRGBD_BUILD_TESTS=OFF
    cmake --build "$build" --target rgbd-slam rgbd-eval rgbd-viewer
}

make_packages() {
    say "Making Debian packages"
    cmake --preset package
    cmake --build build/package
    (cd build/package && rm -f ./*.deb && cpack -G DEB)
}

run_tests() {
    say "Running the tests"
    ctest --test-dir "$build" --output-on-failure -j "$(nproc)" "$@"
}

run_demo() {
    local sample=rawlogs/office_sample.rawlog out=out/demo bin=$build/bin figures drift
    say "SLAM on $sample"
    figures=$("$bin/rgbd-slam" "$sample" -o "$out")
    say "Evaluating against the exact truth in the rawlog"
    "$bin/rgbd-eval" ate "$out/trajectory.txt" "$sample" --plot "$out/ate.png" >"$out/ate.txt"
    drift=$("$bin/rgbd-eval" rpe "$out/trajectory.txt" "$sample" --fixed-delta |
        awk '/translational_error.rmse/ { m = $2 } /rotational_error.rmse/ { deg = $2 }
             END { printf "RPE RMSE      %.4f m, %.2f deg over 1 s", m, deg }')
    say "Rendering the map"
    "$bin/rgbd-viewer" "$out" --snapshot "$out/view.png"
    say "Results"
    sed -e "/^ATE RMSE/a $drift" -e '/^written/d' <<<"$figures"
    say "Everything is in $out"
    cat <<END
  $out/view.png         picture of the map
  $out/map.png          the map from above; map3d.jpg: in perspective
  $out/ate.png          trajectory and truth; ate.txt has the figures
  $out/points.ply       colored points (MeshLab, CloudCompare)
  $out/octree.bt        octree with free space (octovis)
  $out/grid.png, .yaml  floor plan for navigation (ROS)
  $out/scene.3Dscene    all in one: SceneViewer3D $out/scene.3Dscene
  $out/summary.json     figures of the run
doc/viewing.md shows how to look at the rest.
END
}

case "${1:-}" in
    demo) install_packages "${build_packages[@]}"; build_demo; run_demo ;;
    test) install_all; build_all -DRGBD_BUILD_TESTS=ON; shift; run_tests "$@" ;;
    bench) build=build/bench; install_all; build_all; shift; exec tests/bench/run "$@" ;;
    package) install_packages "${build_packages[@]}" "${package_packages[@]}"; make_packages ;;
    build) install_all; build_all -DRGBD_BUILD_TESTS=ON ;;
    install) install_all ;;
    install-build) install_packages "${build_packages[@]}" ;;
    "" | --help | -h | help) usage ;;
    *) echo "run.sh: error: unknown command '$1'" >&2; usage >&2; exit 2 ;;
esac
