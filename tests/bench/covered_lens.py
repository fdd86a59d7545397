#!/usr/bin/env python3
"""Covers the lens of a filmed robot at several places for several seconds and measures where SLAM
puts the camera afterwards.

The recipe: `rgbd-synth corridor-loop`, whose walls and floor repeat every 1.6 m, with some frames
replaced by a gray picture without depth (black) or by something flat before the lens (flat). A
frame's error is that of its motion since the last frame before the cover; the bound is 0.03 m and
2 % of the way driven blind."""

import argparse
import bisect
import csv
import math
import pathlib
import random
import struct
import subprocess
import sys
import zlib

BOUND_M, BOUND_SHARE = 0.03, 0.02
FRAMES_AFTER = 60
PERIOD_S = 1 / 30


def write_png(path, width, height, bits, channels, rows):
    """PNG of 1 (gray) or 3 channels; rows are bytes, big-endian where bits is 16."""
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    header = struct.pack(">IIBBBBB", width, height, bits, 2 if channels == 3 else 0, 0, 0, 0)
    pixels = b"".join(b"\0" + row for row in rows)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                     chunk(b"IDAT", zlib.compress(pixels, 1)) + chunk(b"IEND", b""))


def write_color(path, width, height, rows):
    write_png(path, width, height, 8, 3, [bytes(v for v in row for _ in range(3)) for row in rows])


def cover(folder, kind, width, height, index):
    """Makes the pictures of a covered lens. Returns the names of color and depth."""
    if kind == "black":
        color, depth = folder / "cover.png", folder / "nothing.png"
        if not color.exists():
            write_color(color, width, height, [bytes([110]) * width] * height)
            write_png(depth, width, height, 16, 1, [bytes(2 * width)] * height)
        return color.name, depth.name
    color, depth = folder / f"flat{index}.png", folder / f"near{index}.png"
    noise = random.Random(index)
    if not color.exists():
        write_color(color, width, height,
                    [bytes(110 + b % 5 - 2 for b in noise.randbytes(width))
                     for _ in range(height)])
        write_png(depth, width, height, 16, 1,
                  [b"".join(struct.pack(">H", 5000 + b % 17 - 8) for b in noise.randbytes(width))
                   for _ in range(height)])
    return color.name, depth.name


def lines_of(path):
    return [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]


def covered_folder(film, work, kind, size, first, count):
    """A folder like the film's up to shortly after the cover. Returns it with the stamps of the
    frames before and after."""
    width, height = size
    folder = work / "covered"
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("rgb", "depth"):
        link = folder / name
        if link.is_symlink():
            link.unlink()
        link.symlink_to((film / name).resolve())
    for name in ("groundtruth.txt", "accelerometer.txt", "gyroscope.txt", "odometry.txt",
                 "camera.ini"):
        if (film / name).exists():
            (folder / name).write_text((film / name).read_text())
    last = first + count + FRAMES_AFTER
    stamps = []
    for list_name, which in (("rgb.txt", 0), ("depth.txt", 1)):
        rows = lines_of(film / list_name)[:last]
        for i in range(first, min(first + count, len(rows))):
            rows[i][1] = cover(folder, kind, width, height, i - first)[which]
        (folder / list_name).write_text("".join(" ".join(row) + "\n" for row in rows))
        if which == 0:
            stamps = [float(row[0]) for row in rows]
    return folder, stamps


def quaternion_rotate(q, v):
    x, y, z, w = q
    tx, ty, tz = (2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0]))
    return (v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz,
            v[2] + w * tz + x * ty - y * tx)


class Path:
    """Poses by stamp."""

    def __init__(self, path):
        rows = [[float(word) for word in row] for row in lines_of(path)]
        self.stamps = [row[0] for row in rows]
        self.poses = [(tuple(row[1:4]), tuple(row[4:8])) for row in rows]

    def at(self, stamp, slack=0.02):
        """Interpolated pose, or None where there is none near."""
        i = bisect.bisect_left(self.stamps, stamp)
        if i < len(self.stamps) and abs(self.stamps[i] - stamp) < 1e-4:
            return self.poses[i]
        if i == 0 or i == len(self.stamps) or self.stamps[i] - self.stamps[i - 1] > slack:
            return None
        share = (stamp - self.stamps[i - 1]) / (self.stamps[i] - self.stamps[i - 1])
        (t0, q0), (t1, q1) = self.poses[i - 1], self.poses[i]
        sign = 1 if sum(a * b for a, b in zip(q0, q1)) >= 0 else -1
        q = [a + share * (sign * b - a) for a, b in zip(q0, q1)]
        norm = math.sqrt(sum(c * c for c in q))
        return (tuple(a + share * (b - a) for a, b in zip(t0, t1)), tuple(c / norm for c in q))


def motion(a, b):
    """Translation from pose a to b in a's own axes."""
    difference = tuple(y - x for x, y in zip(a[0], b[0]))
    x, y, z, w = a[1]
    return quaternion_rotate((-x, -y, -z, w), difference)


def distance(a, b):
    return math.sqrt(sum((x - y) ** 2 for x, y in zip(a, b)))


def sigma_of(row):
    """Standard deviation of a frame's place, or None where its run tells none."""
    try:
        return math.sqrt(sum(float(row[f"std_{axis}_m"]) ** 2 for axis in "xyz"))
    except (KeyError, ValueError):
        return None


def errors_after(truth, estimate, rows, stamps, first, count):
    """(worst error since the cover, way driven blind, largest jump of frames not lost, largest
    error in the standard deviations that the frame claims)"""
    before = stamps[first - 1]
    a, b = truth.at(before), estimate.at(before)
    if b is None:
        return math.inf, 0, math.inf, math.inf
    worst, jump, sigmas = 0, 0, 0
    last = before
    for stamp in stamps[first:]:
        row = rows.get(f"{stamp:.4f}")
        if row is None or row["origin"] == "lost" or estimate.at(stamp) is None:
            continue
        error = distance(motion(a, truth.at(stamp)), motion(b, estimate.at(stamp)))
        worst = max(worst, error)
        sigmas = max(sigmas, error / (sigma_of(row) or math.inf))
        jump = max(jump, distance(motion(truth.at(last), truth.at(stamp)),
                                  motion(estimate.at(last), estimate.at(stamp))))
        last = stamp
    way = sum(distance(truth.at(s)[0], truth.at(e)[0])
              for s, e in zip(stamps[first - 1:first + count], stamps[first:first + count + 1]))
    return worst, way, jump, sigmas


def run(programs, ini, folder, work, options):
    rawlog, out = work / "covered.rawlog", work / "out"
    importer = programs / "rgbd-import"
    quiet = {"check": True, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    subprocess.run([importer, folder, rawlog, "--quiet"], **quiet)
    subprocess.run([programs / "rgbd-slam", ini, rawlog, "-o", out, "--no-maps", "--quiet",
                    *options], **quiet)
    with open(out / "frames.csv", encoding="utf-8") as lines:
        rows = {f"{float(row['stamp_s']):.4f}": row for row in csv.DictReader(lines)}
    return Path(out / "trajectory.txt"), rows


def numbers(text):
    return [float(word) for word in text.split(",")]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", type=pathlib.Path, help="folder of rgbd-slam and the others")
    parser.add_argument("work", type=pathlib.Path, help="scratch folder; the film is kept there")
    parser.add_argument("--scenario", default="corridor-loop")
    parser.add_argument("--seed", default="1")
    parser.add_argument("--size", default="320x240")
    parser.add_argument("--kind", choices=("black", "flat"), default="black")
    parser.add_argument("--places", default="60,105,150,195,240,285,330,375,420,465",
                        help="first covered frames")
    parser.add_argument("--lengths", default="1,2,3,4,5", help="seconds")
    parser.add_argument("--film", type=pathlib.Path, help="of the scenario, instead of a new one")
    parser.add_argument("--set", action="append", default=[], help="as for rgbd-slam")
    arguments = parser.parse_args()
    root = pathlib.Path(__file__).resolve().parents[2]
    places = [int(p) for p in numbers(arguments.places)]
    lengths = numbers(arguments.lengths)
    frames = max(places) + round(max(lengths) / PERIOD_S) + FRAMES_AFTER
    name = f"{arguments.scenario}-{arguments.seed}-{arguments.size}-{frames}"
    film = arguments.film or arguments.work / name
    if not (film / "rgb.txt").exists():
        subprocess.run([arguments.programs / "rgbd-synth", arguments.scenario, film, "--quiet",
                        "--size", arguments.size, "--frames", str(frames), "--seed",
                        arguments.seed], check=True)
    truth = Path(film / "groundtruth.txt")
    size = tuple(int(side) for side in arguments.size.split("x"))
    options = [word for setting in arguments.set for word in ("--set", setting)]
    failures = 0
    print("first s blind-m error-m bound-m jump-m sigmas tracked recovered weak uncertain lost verdict")
    for first in places:
        for seconds in lengths:
            count = round(seconds / PERIOD_S)
            folder, stamps = covered_folder(film, arguments.work, arguments.kind, size, first,
                                            count)
            estimate, rows = run(arguments.programs, root / "ini/default.ini", folder,
                                   arguments.work, options)
            error, way, jump, sigmas = errors_after(truth, estimate, rows, stamps, first, count)
            bound = BOUND_M + BOUND_SHARE * way
            failed = error > bound
            failures += failed
            states = [row["origin"] for row in rows.values()]
            counts = [states.count(s)
                      for s in ("tracked", "recovered", "dead_reckoned", "uncertain", "lost")]
            print(f"{first} {seconds:g} {way:.2f} {error:.4f} {bound:.4f} {jump:.4f} {sigmas:.1f}", *counts,
                  "FAILED" if failed else "ok", flush=True)
    total = len(places) * len(lengths)
    print(f"{total - failures} of {total} within the bound")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main())
