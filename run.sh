#!/usr/bin/env bash
# Sets the project up on Debian 12 and runs it. Every step can be repeated; what is done is skipped.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

build=build/release
packages=(
    build-essential cmake ninja-build ccache pkg-config
    libmrpt-dev libmrpt-nanogui-dev mrpt-apps
    libeigen3-dev libopencv-dev libceres-dev liboctomap-dev octomap-tools
    libcli11-dev nlohmann-json3-dev libarchive-dev gnuplot-nox
    libgtest-dev libgmock-dev libbenchmark-dev xvfb xauth
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
    if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
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
    local sample=rawlogs/office_sample.rawlog out=out/demo bin=$build/bin
    say "SLAM on $sample"
    "$bin/rgbd-slam" ini/default.ini "$sample" -o "$out"
    say "Evaluating against the exact truth in the rawlog"
    "$bin/rgbd-eval" ate "$out/trajectory.txt" "$sample" --plot "$out/ate.png"
    say "Rendering the map"
    "$bin/rgbd-viewer" "$out" --snapshot "$out/map.png"
    say "Everything is in $out"
    cat <<END
  $out/map.png          picture of the map
  $out/ate.png          trajectory with its error
  $out/points.ply       coloured points (MeshLab, CloudCompare)
  $out/octree.bt        octree with free space (octovis)
  $out/scene.3Dscene    everything (SceneViewer3D $out/scene.3Dscene)
  $out/summary.json     figures of the run
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
