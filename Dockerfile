# The programs on a bare Debian 12, from the Debian package that this builds:
#   docker build -t rgbd-graphslam .
#   docker run --rm -v "$PWD:/data" rgbd-graphslam rgbd-slam X.rawlog -o out
FROM debian:bookworm AS build
COPY . /src/rgbd-graphslam
RUN /src/rgbd-graphslam/run.sh package

FROM debian:bookworm
COPY --from=build /src/rgbd-graphslam/build/package/rgbd-graphslam_*.deb /tmp/
RUN apt-get update && apt-get install -y --no-install-recommends /tmp/rgbd-graphslam_*.deb \
    && rm -rf /tmp/*.deb /var/lib/apt/lists/*
WORKDIR /data
CMD ["rgbd-slam", "--help"]
