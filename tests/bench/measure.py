"""Runs programs and takes their figures; every figure is the median over the runs."""

import dataclasses
import hashlib
import json
import os
import pathlib
import re
import statistics
import subprocess
import tempfile
import time

THREADS = (1, 2, 4)


class Failure(Exception):
    """A program ended with an error; the text is its own line."""


@dataclasses.dataclass
class Cost:
    """What a process cost: wall and CPU seconds, largest resident memory in MB."""

    wall_s: float
    cpu_s: float
    peak_mb: float


def cost_of(command):
    """Runs a command. Raises Failure with the first line of its complaint."""
    with tempfile.TemporaryFile("w+") as complaints:
        start = time.perf_counter()
        process = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL,
                                   stderr=complaints)
        _, status, usage = os.wait4(process.pid, 0)
        wall_s = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            complaints.seek(0)
            lines = [line for line in complaints.read().splitlines() if "error:" in line]
            raise Failure(lines[0] if lines else f"exit code {process.returncode}")
    return Cost(wall_s, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)


def median_cost(command, runs):
    costs = [cost_of(command) for _ in range(runs)]
    return Cost(*(statistics.median(column) for column in zip(*map(dataclasses.astuple, costs))))


class Bench:
    """rgbd-slam and rgbd-eval of one build on sequences."""

    def __init__(self, programs, ini, work, runs):
        self.programs, self.ini, self.work, self.runs = programs, ini, work, runs
        self.libraries_mb = median_cost([programs / "rgbd-slam", "--version"], 3).peak_mb

    def run(self, sequence, *options):
        """One run: its figures by name, and the trajectory's digest."""
        out = self.work / "out" / sequence.name
        cost = cost_of([self.programs / "rgbd-slam", self.ini, sequence.rawlog, "-o", out,
                        "--no-maps", "--quiet", *options])
        summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
        figures = _figures(summary, cost)
        figures["beyond_libraries_mb"] = cost.peak_mb - self.libraries_mb
        digest = hashlib.sha256((out / "trajectory.txt").read_bytes()).hexdigest()
        return figures, digest, summary["stages"]

    def measure(self, sequence, *options):
        """Medians over the runs after a warm-up, and the errors of the last run."""
        self.run(sequence, *options)
        runs = [self.run(sequence, *options) for _ in range(self.runs)]
        figures = {key: _median(run[0][key] for run in runs) for key in runs[0][0]}
        figures.update(self._errors(sequence))
        digests = {digest for _, digest, _ in runs}
        figures["same_in_all_runs"] = len(digests) == 1 if len(runs) > 1 else None
        figures["stages"] = runs[-1][2]
        return figures

    def same_with_threads(self, sequence):
        """Whether 1, 2 and 4 threads give the same bytes."""
        return len({self.run(sequence, "--threads", str(n))[1] for n in THREADS}) == 1

    def start_up_s(self, sequence):
        """Wall time of a run over one frame, reading and writing included."""
        out = self.work / "out" / "start-up"
        return median_cost([self.programs / "rgbd-slam", self.ini, sequence.rawlog, "-o", out,
                            "--no-maps", "--quiet", "--max-frames", "1"], self.runs).wall_s

    def _errors(self, sequence):
        if not sequence.truth:
            return {}
        trajectory = self.work / "out" / sequence.name / "trajectory.txt"
        ate = self._evaluate("ate", trajectory, sequence.truth)
        rpe = self._evaluate("rpe", "--fixed-delta", trajectory, sequence.truth)
        return {
            "ate_m": ate.get("absolute_translational_error.rmse"),
            "rpe_m": rpe.get("translational_error.rmse"),
            "rpe_deg": rpe.get("rotational_error.rmse"),
        }

    def _evaluate(self, *arguments):
        """Figures by name; none when there are too few poses for any."""
        result = subprocess.run([self.programs / "rgbd-eval", *arguments, "--format", "json"],
                                capture_output=True, text=True, check=False)
        if result.returncode != 0:
            return {}
        return {key: figure["value"]
                for key, figure in json.loads(result.stdout)[0]["figures"].items()}


def _median(values):
    """None where a run has no such figure."""
    values = list(values)
    return None if None in values else statistics.median(values)


def _figures(summary, cost):
    frames = summary["frames"]
    reading_ms = sum(stage["calls"] * stage["cpu_ms"]["mean"]
                     for name, stage in summary["stages"].items() if name in ("read", "decode"))
    figures = {key: summary[key] for key in
               ("frames", "tracked", "recovered", "lost", "keyframes", "loops", "false_loops",
                "path_m", "frames_per_s", "cpu_ms_a_frame")}
    errors_m = [edge[3] for edge in summary["loop_edges"] if edge[3] is not None]
    figures["worst_loop_m"] = max(errors_m, default=None)
    figures["cpu_ms_without_reading"] = summary["cpu_ms_a_frame"] - reading_ms / frames
    figures["process_cpu_ms"] = 1e3 * cost.cpu_s / frames
    figures["peak_mb"] = cost.peak_mb
    return figures


def google_benchmark(program, *options):
    """Benchmarks by name, each a dict of CPU time, its unit and the counters."""
    result = subprocess.run([program, "--benchmark_format=json", *options], check=True,
                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return {entry["name"]: entry for entry in json.loads(result.stdout)["benchmarks"]}


def _callgrind(program, count, calls):
    """Instructions and first-level data cache misses of a whole process."""
    result = subprocess.run(
        ["valgrind", "--tool=callgrind", "--cache-sim=yes", "--callgrind-out-file=/dev/null",
         program, f"--benchmark_filter=extractionCalls/{count}/iterations:{calls}$"],
        check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    return [int(re.search(rf"{name}:\s+([\d,]+)", result.stderr)[1].replace(",", ""))
            for name in (r"I\s+refs", r"D1\s+misses")]


def instructions_of_extraction(program, counts=(500, 2000), calls=(1, 6)):
    """(instructions, first-level cache misses) of one extraction for each number of features; the
    difference of two processes leaves start-up out."""
    costs = {}
    for count in counts:
        few, many = (_callgrind(program, count, n) for n in calls)
        costs[count] = [(b - a) / (calls[1] - calls[0]) for a, b in zip(few, many)]
    return costs


def way_m(truth):
    """Length of a trajectory file."""
    places = [tuple(map(float, line.split()[1:4]))
              for line in pathlib.Path(truth).read_text(encoding="utf-8").splitlines()
              if line and not line.startswith("#")]
    return sum(sum((a - b) ** 2 for a, b in zip(p, q)) ** 0.5 for p, q in zip(places, places[1:]))
