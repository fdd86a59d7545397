#!/usr/bin/env python3
"""How far SLAM lets itself be deceived by what moves or is fixed to the picture.

Each scenario of rgbd-synth is filmed twice, as it is and `--without-movers`, and mapped with several
numbers of features; the table tells what the deceit costs. Every result is a file in the work
folder: a run that was stopped goes on where it was."""

import argparse
import concurrent.futures
import json
import math
import pathlib
import shutil
import statistics
import subprocess
import sys
import time

SCENARIOS = ("crowd", "follow-me", "door", "chair-moved", "pushed-cart", "starts-in-crowd", "lift",
             "under-desk", "ceiling-lamp", "arm-in-view", "dirty-lens")
SESSIONS = {"chair-moved": 2}
FOLLOWED_M = 0.1
ATE = "absolute_translational_error"
ROOT = pathlib.Path(__file__).resolve().parents[2]


class Bench:
    def __init__(self, options):
        self.programs, self.work, self.size = options.programs, options.work, options.size
        self.films = options.films or options.work / "films"
        self.frames = ["--frames", str(options.frames)] if options.frames else []
        self.settings = [word for setting in options.set for word in ("--set", setting)]

    def call(self, program, *arguments):
        return subprocess.run([self.programs / program, *arguments], check=True, text=True,
                              capture_output=True).stdout

    def figures(self, *arguments):
        report = json.loads(self.call("rgbd-eval", *arguments, "--format", "json"))
        return {name: figure["value"] for name, figure in report[0]["figures"].items()}

    def film(self, scenario, seed, movers, session):
        """Folder of a film, which is made where it is missing, with its rawlog beside it."""
        several = f"-session{session}" if scenario in SESSIONS else ""
        folder = self.films / f"{scenario}-s{seed}{several}{'' if movers else '-without'}"
        if not folder.exists():
            part = folder.with_suffix(".part")
            shutil.rmtree(part, ignore_errors=True)
            self.call("rgbd-synth", scenario, part, "--size", self.size, "--seed", str(seed),
                      "--session", str(session), *self.frames, "--quiet",
                      *([] if movers else ["--without-movers"]))
            part.rename(folder)
        return folder

    def map(self, folder, out, features, *options):
        rawlog = out.with_suffix(".rawlog")
        self.call("rgbd-import", folder, rawlog, "--quiet")
        self.call("rgbd-slam", ROOT / "ini/default.ini", rawlog, "-o", out, "--quiet", "--set",
                  f"FeatureOptions.count={features}", *self.settings, *options)
        rawlog.unlink()

    def measure(self, scenario, seed, features, movers):
        """Maps all sessions, each in the map of the one before, and judges the last."""
        out, earlier = None, []
        for session in range(1, SESSIONS.get(scenario, 1) + 1):
            deceit = movers or session < SESSIONS.get(scenario, 1)
            folder = self.film(scenario, seed, deceit, session)
            out = self.work / "runs" / f"{scenario}-{seed}-{features}-{movers}-{session}"
            shutil.rmtree(out, ignore_errors=True)
            self.map(folder, out, features, *earlier)
            earlier = ["--map", out, "--extend"]
        result = self.judge(folder, out)
        for run in out.parent.glob(f"{scenario}-{seed}-{features}-{movers}-*"):
            shutil.rmtree(run)
        return result

    def judge(self, folder, out):
        path, truth = out / "trajectory.txt", folder / "groundtruth.txt"
        result = self.figures("ate", path, truth) | self.figures("consistency", out, truth)
        placed = ("--estimate", path, "--truth", truth, "--movers", folder / "movers.csv")
        points = self.figures("map", out / "points.ply", folder / "surface.ply", *placed)
        grid = self.figures("grid", out / "grid.yaml", folder / "surface.ply", *placed)
        return result | points | {f"grid.{name}": value for name, value in grid.items()}

    def job(self, task):
        """One result, unless an earlier run has it. What fails is a result, too."""
        scenario, seed, features, movers = task
        path = self.work / f"{scenario}-{seed}-{features}-{'with' if movers else 'without'}.json"
        if path.exists():
            return
        try:
            result = self.measure(*task)
        except subprocess.CalledProcessError as failure:
            result = {"failure": failure.stderr.strip().splitlines()[-1:]}
        part = path.with_suffix(".part")
        part.write_text(json.dumps(result, indent=1), encoding="utf-8")
        part.rename(path)
        print(path.stem, result.get("failure") or f"{result[f'{ATE}.rmse']:.4f}", file=sys.stderr,
              flush=True)

    def result(self, *task):
        scenario, seed, features, kind = task
        path = self.work / f"{scenario}-{seed}-{features}-{kind}.json"
        return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None


def median_of(results, name):
    values = [result[name] for result in results if name in result]
    return statistics.median(values) if values else math.nan


def worst_of(results, name, worst=max):
    values = [result[name] for result in results if name in result]
    return worst(values) if values else math.nan


def row_of(bench, scenario, features, seeds):
    """Figures over the seeds that are finished with and without movers."""
    pairs = [(bench.result(scenario, seed, features, "with"),
              bench.result(scenario, seed, features, "without")) for seed in seeds]
    pairs = [pair for pair in pairs if all(pair)]
    if not pairs:
        return None
    deceived = [pair[0] for pair in pairs if "failure" not in pair[0]]
    ratios = [a[f"{ATE}.rmse"] / b[f"{ATE}.rmse"] for a, b in pairs
              if "failure" not in a and "failure" not in b]
    failed = sum("failure" in each for pair in pairs for each in pair)
    followers = sum(result[f"{ATE}.max"] > FOLLOWED_M for result in deceived)
    return [scenario, str(features), str(len(pairs)) + (f" ({failed} failed)" if failed else ""),
            f"{median_of([pair[1] for pair in pairs], f'{ATE}.rmse'):.4f}",
            f"{median_of(deceived, f'{ATE}.rmse'):.4f}",
            f"{statistics.median(ratios):.2f}" if ratios else "-",
            f"{worst_of(deceived, f'{ATE}.max'):.3f}", str(followers),
            f"{worst_of(deceived, 'worst_translational_error'):.3f}",
            f"{100 - worst_of(deceived, 'within_3_sigma', min):.1f}",
            f"{worst_of(deceived, 'largest_jump'):.3f}",
            f"{median_of(deceived, 'nees_in_95_percent_band'):.0f}",
            f"{median_of(deceived, 'points_beyond'):.2f}",
            f"{median_of(deceived, 'points_on_movers_ways'):.2f}",
            f"{median_of(deceived, 'grid.on_movers_ways'):.0f} of "
            f"{median_of(deceived, 'grid.occupied'):.0f}"]


HEADER = ("scenario", "features", "seeds", "ATE calm m", "ATE m", "ratio", "worst m", "followed",
          "worst tracked m", "beyond 3 sigma %", "largest jump m", "NEES in band %",
          "points beyond 10 cm %", "on movers' ways %", "cells on movers' ways")


def table(bench, options):
    lines = ["| " + " | ".join(HEADER) + " |", "|" + "---|" * len(HEADER)]
    for scenario in options.scenarios:
        for features in options.features:
            row = row_of(bench, scenario, features, options.seeds)
            if row:
                lines.append("| " + " | ".join(row) + " |")
    return "\n".join(lines)


def words(text):
    return text.split(",")


def numbers(text):
    return [int(word) for word in text.split(",")]


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", type=pathlib.Path, help="folder of rgbd-slam and the others")
    parser.add_argument("work", type=pathlib.Path, help="results, which later runs take up")
    parser.add_argument("--scenarios", type=words, default=SCENARIOS)
    parser.add_argument("--seeds", type=numbers, default=list(range(1, 11)), help="e.g. 1,2,3")
    parser.add_argument("--features", type=numbers, default=[1000, 1500, 2000])
    parser.add_argument("--size", default="320x240")
    parser.add_argument("--frames", type=int, default=0, help="0: the scenario's own number")
    parser.add_argument("--films", type=pathlib.Path, help="folder of films; default: in the work folder")
    parser.add_argument("--jobs", type=int, choices=(1, 2), default=2, help="at the same time")
    parser.add_argument("--minutes", type=float, default=math.inf, help="begin nothing after these")
    parser.add_argument("--set", action="append", default=[], help="as for rgbd-slam")
    return parser.parse_args()


def main():
    options = parse()
    bench = Bench(options)
    for folder in (options.work / "runs", bench.films):
        folder.mkdir(parents=True, exist_ok=True)
    end = time.monotonic() + 60 * options.minutes
    # Both films of a scenario are taken on one thread: they may share a first session.
    films = [(scenario, seed) for seed in options.seeds for scenario in options.scenarios]

    def run(film):
        for features in options.features:
            for movers in (True, False):
                if time.monotonic() < end:
                    bench.job((*film, features, movers))

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(run, films))
    print(table(bench, options))


if __name__ == "__main__":
    main()
