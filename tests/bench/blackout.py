#!/usr/bin/env python3
"""How far inertial sensors and wheels carry a run through blackouts, and what comes after.

For films of `rgbd-synth blackout` and `blackout-robot`: the error of the last dead-reckoned pose,
2 s, 5 s and 10 s into the blackout as far as it lasts, before the map is seen again (that of the motion since
the last frame before it); the ATE of the whole, and the largest step between neighboring poses there."""

import argparse
import pathlib
import re
import statistics
import subprocess
import sys

sys.dont_write_bytecode = True
from covered_lens import Path, distance, lines_of, motion  # noqa: E402

ENDS_S = (2, 5, 10)


def covered(film):
    """Stamps of the frames, and which are dark, by the size of their depth pictures."""
    stamps = [float(row[0]) for row in lines_of(film / "rgb.txt")]
    sizes = [(film / row[1]).stat().st_size for row in lines_of(film / "depth.txt")]
    dark = 0.2 * statistics.median(sizes)
    return stamps, [size < dark for size in sizes]


def run(program, *arguments):
    done = subprocess.run([str(program), *map(str, arguments)], capture_output=True, text=True)
    if done.returncode not in (0, 3):
        sys.exit(f"{program} {arguments}: {done.stderr}")
    return done.stdout


def ate(bin_folder, estimate, truth):
    text = run(bin_folder / "rgbd-eval", "ate", estimate, truth)
    return float(re.search(r"rmse\D*([0-9.]+)", text).group(1))


def measure(film, work, bin_folder, options):
    stamps, dark = covered(film)
    rawlog = work / f"{film.name}.rawlog"
    if not rawlog.exists():
        run(bin_folder / "rgbd-import", film, rawlog, "-q")
    truth = Path(film / "groundtruth.txt")
    first = dark.index(True) if True in dark else None
    slam = [rawlog, "--no-maps", "-q", *options]
    out = work / f"{film.name}-out"
    run(bin_folder / "rgbd-slam", *slam, "-o", out)
    result = {"ate": ate(bin_folder, out / "trajectory.txt", film / "groundtruth.txt")}
    if first is None:
        return result
    end = first + dark[first:].count(True)
    whole = Path(out / "trajectory.txt")
    steps = [distance(motion(*pair), motion(truth.at(a), truth.at(b)))
             for a, b in zip(whole.stamps, whole.stamps[1:])
             if stamps[first] - 0.2 < a < stamps[end] + 0.5
             for pair in [(whole.at(a), whole.at(b))]]
    result["jump"] = max(steps) if steps else None
    for seconds in ENDS_S:
        last = max(i for i in range(first, end)
                   if stamps[i] - stamps[first] < seconds + 0.02)
        if stamps[last] - stamps[first] < seconds - 0.2:
            continue
        cut = work / f"{film.name}-cut"
        run(bin_folder / "rgbd-slam", *slam, "--max-frames", last + 1, "-o", cut)
        found = Path(cut / "trajectory.txt")
        a, b = stamps[first - 1], stamps[last]
        way = sum(distance(truth.at(s)[0], truth.at(t)[0])
                  for s, t in zip(stamps[first - 1:last], stamps[first:last + 1]))
        here = found.at(b)
        result[f"{seconds}s"] = (distance(motion(found.at(a), here),
                                          motion(truth.at(a), truth.at(b))) if here else None)
        result[f"way{seconds}s"] = way
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("films", nargs="+", type=pathlib.Path)
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("blackout-work"))
    parser.add_argument("--set", action="append", default=[], help="as of rgbd-slam")
    arguments = parser.parse_args()
    arguments.work.mkdir(parents=True, exist_ok=True)
    options = [word for each in arguments.set for word in ("--set", each)]
    results = []
    for film in arguments.films:
        results.append(measure(film, arguments.work, arguments.bin, options))
        print(film.name, *(f"{key} {value:.4f}" if value is not None else f"{key} lost"
                           for key, value in results[-1].items()), flush=True)
    for key in dict.fromkeys(key for result in results for key in result):
        values = [result[key] for result in results if result.get(key) is not None]
        lost = sum(1 for result in results if key in result and result[key] is None)
        print(f"median {key} {statistics.median(values):.4f}, worst {max(values):.4f}"
              + (f", {lost} lost" if lost else "") if values else f"{key}: {lost} lost")


if __name__ == "__main__":
    main()
