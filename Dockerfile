# All programs on a bare Debian 12:
#   docker build -t rgbd-graphslam .
#   docker run --rm -v "$PWD:/data" rgbd-graphslam rgbd-slam /usr/local/share/rgbd_graphslam/ini/default.ini X.rawlog -o out
FROM debian:bookworm
COPY . /src/rgbd-graphslam
WORKDIR /src/rgbd-graphslam
RUN ./run.sh install-build && rm -rf /var/lib/apt/lists/* \
    && cmake --preset release -DRGBD_BUILD_TESTS=OFF \
    && cmake --build build/release && cmake --install build/release && rm -rf build
WORKDIR /data
CMD ["rgbd-slam", "--help"]
