#!/usr/bin/env bash
# Sets the project up on Debian 12 and runs it. Every step can be repeated; what is done is skipped.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

build=build/release
packages=(
    build-essential cmake ninja-build ccache pkg-config
    libmrpt-dev libmrpt-nanogui-dev mrpt-apps
    libeigen3-dev libopencv-dev libceres-dev liboctomap-dev octomap-tools
    libcli11-dev nlohmann-json3-dev libarchive-dev libjpeg-dev zlib1g-dev
    libcurl4-openssl-dev libnanoflann-dev gnuplot-nox
    libgl-dev libopengl-dev libegl1 libgl1-mesa-dri
    libgtest-dev libgmock-dev libbenchmark-dev python3 parallel
    python3-rosbag python3-sensor-msgs python3-tf2-msgs xvfb xauth
)

usage() {
    cat <<'END'
usage: ./run.sh COMMAND
  demo     install, build, run SLAM on the sample rawlog, evaluate it, render its map
  test     install, build, run every test
  bench    install, build, measure (see doc/benchmarks.md)
  build    install and build only
  install  install what is missing from Debian only
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
    for package in "${packages[@]}"; do
        installed "$package" || missing+=("$package")
    done
    if [ ${#missing[@]} -eq 0 ]; then
        say "Debian packages: all ${#packages[@]} are there"
        return
    fi
    say "Installing from Debian: ${missing[*]}"
    as_root apt-get update -q
    as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -q --no-install-recommends "${missing[@]}"
}

build_all() {
    say "Building into $build (the first time takes some minutes)"
    [ -f "$build/build.ninja" ] || cmake --preset "${build##*/}"
    cmake --build "$build"
}

run_tests() {
    say "Running the tests"
    ctest --test-dir "$build" --output-on-failure -j "$(nproc)" "$@"
}

run_demo() {
    local sample=rawlogs/office_sample.rawlog out=out/demo bin=$build/bin figures drift
    say "SLAM on $sample"
    figures=$("$bin/rgbd-slam" ini/default.ini "$sample" -o "$out")
    say "Evaluating against the exact truth in the rawlog"
    "$bin/rgbd-eval" ate "$out/trajectory.txt" "$sample" --plot "$out/ate.png" >"$out/ate.txt"
    drift=$("$bin/rgbd-eval" rpe "$out/trajectory.txt" "$sample" --fixed-delta |
        awk '/translational_error.rmse/ { m = $2 } /rotational_error.rmse/ { deg = $2 }
             END { printf "RPE RMSE      %.4f m, %.2f deg over 1 s", m, deg }')
    say "Rendering the map"
    "$bin/rgbd-viewer" "$out" --snapshot "$out/view.png" --zoom 1.45
    say "Results"
    sed -e "/^ATE RMSE/a $drift" -e '/^written/d' <<<"$figures"
    say "Everything is in $out"
    cat <<END
  $out/view.png         picture of the map
  $out/map.png          the map from above
  $out/ate.png          trajectory and truth; ate.txt has the figures
  $out/points.ply       coloured points (MeshLab, CloudCompare)
  $out/octree.bt        octree with free space (octovis)
  $out/grid.png, .yaml  floor plan for navigation (ROS)
  $out/scene.3Dscene    all in one: SceneViewer3D $out/scene.3Dscene
  $out/summary.json     figures of the run
doc/viewing.md shows how to look at the rest.
END
}

case "${1:-}" in
    demo) install_packages; build_all; run_demo ;;
    test) install_packages; build_all; shift; run_tests "$@" ;;
    bench) build=build/bench; install_packages; build_all; shift; exec tests/bench/run "$@" ;;
    build) install_packages; build_all ;;
    install) install_packages ;;
    *) usage; [ "${1:-}" = --help ] || exit 2 ;;
esac
