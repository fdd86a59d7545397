"""Measured figures as Markdown tables between the marks of a document."""

import re

MISSING = "–"


def fill(text, name, content):
    """Puts content between <!-- bench:name --> and <!-- /bench:name -->."""
    marks = re.compile(rf"(<!-- bench:{name} -->\n).*?(<!-- /bench:{name} -->)", re.S)
    if not marks.search(text):
        raise SystemExit(f"error: the document has no marks for '{name}'; restore them")
    return marks.sub(lambda m: f"{m[1]}{content}\n{m[2]}", text)


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(map(str, row)) + " |" for row in rows]
    return "\n".join(lines)


def number(value, digits):
    return MISSING if value is None else f"{value:.{digits}f}"


def _count(figures, key):
    return f"{figures[key]:.0f}"


def _located(figures):
    return "/".join(_count(figures, key) for key in ("tracked", "recovered", "lost"))


def _loops(figures):
    loops = _count(figures, "loops")
    known = figures["loops"] and figures["false_loops"] is not None
    return [f"{loops}, {_count(figures, 'false_loops')} false" if known else loops,
            number(figures["worst_loop_m"], 3)]


def _yes(value):
    if value is None:
        return MISSING
    return "yes" if value else "**NO**"


def _accuracy(figures):
    return [number(figures.get("ate_m"), 4), number(figures.get("rpe_m"), 4),
            number(figures.get("rpe_deg"), 3)]


def accuracy(results):
    head = ["sequence", "frames", "tracked/recovered/lost", "keyframes", "loops", "worst loop m",
            "ATE RMSE m", "RPE 1 s m", "RPE 1 s °", "runs same", "1, 2, 4 threads same"]
    rows = []
    for name, figures in results.items():
        rows.append([f"`{name}`", _count(figures, "frames"), _located(figures),
                     _count(figures, "keyframes"), *_loops(figures), *_accuracy(figures),
                     _yes(figures["same_in_all_runs"]), _yes(figures["same_with_threads"])])
    return table(head, rows)


def cost(results):
    head = ["sequence", "tracking ms CPU", "of it without reading", "whole process ms CPU",
            "frames/s", "peak MB", "beyond libraries MB", "start-up s"]
    digits = {"cpu_ms_a_frame": 1, "cpu_ms_without_reading": 1, "process_cpu_ms": 1,
              "frames_per_s": 0, "peak_mb": 0, "beyond_libraries_mb": 0, "start_up_s": 2}
    return table(head, [[f"`{name}`"] + [number(figures[key], d) for key, d in digits.items()]
                        for name, figures in results.items()])


def beside_peers(results, peers):
    """\\param peers configuration: clip -> system -> "ms ATE" """
    systems = list(dict.fromkeys(system for clip in peers.sections() for system in peers[clip]))
    rows = []
    for clip in filter(results.__contains__, peers.sections()):
        ours = results[clip]
        cells = [f"{number(ours['cpu_ms_without_reading'], 1)} ms, "
                 f"{number(ours.get('ate_m'), 4)} m"]
        for system in systems:
            ms, ate = peers[clip][system].split()
            cells.append(f"{ms} ms, {ate} m")
        rows.append([f"`{clip}`", *cells])
    return table(["clip", "rgbd-slam", *systems], rows)


def profile(name, figures):
    rows = []
    for stage, times in figures["stages"].items():
        cpu, wall = times["cpu_ms"], times["wall_ms"]
        a_frame = times["calls"] * cpu["mean"] / figures["frames"]
        rows.append([stage, times["calls"], number(a_frame, 2)] +
                    [number(t[key], 2) for t in (cpu, wall)
                     for key in ("mean", "median", "p95", "max")])
    head = ["stage", "calls", "CPU ms a frame"] + [
        f"{clock} {key}" for clock in ("CPU", "wall") for key in ("mean", "p50", "p95", "max")]
    return f"Of `{name}`, the last run; CPU and wall in ms a call.\n\n" + table(head, rows)


def ablations(by_variant):
    """\\param by_variant variant -> clip -> figures"""
    clips = list(next(iter(by_variant.values())))
    rows = []
    for variant, results in by_variant.items():
        cells = []
        for clip in clips:
            figures = results[clip]
            lost = f", {figures['lost']:.0f} lost" if figures["lost"] else ""
            cells.append(f"{number(figures.get('ate_m'), 4)} m, "
                         f"{number(figures['cpu_ms_a_frame'], 1)} ms{lost}")
        rows.append([variant, *cells])
    return table(["variant"] + [f"`{clip}`" for clip in clips], rows)


def scenarios(results, failures):
    """\\param failures name -> why it never came to a trajectory"""
    head = ["scenario", "way m", "tracked/recovered/lost", "keyframes", "loops", "worst loop m",
            "ATE RMSE m", "RPE 1 s m", "RPE 1 s °", "tracking ms CPU", "outcome"]
    rows = [[f"`{name}`", number(figures["way_m"], 1), _located(figures),
             _count(figures, "keyframes"), *_loops(figures), *_accuracy(figures),
             number(figures["cpu_ms_a_frame"], 1), outcome(figures)]
            for name, figures in results.items()]
    rows += [[f"`{name}`"] + [MISSING] * 9 + [f"**FAILED**: {why}"]
             for name, why in failures.items()]
    return table(head, rows)


def outcome(figures):
    """A scenario is held when nine tenths of its frames have a pose and the error stays below a
    hundredth of the way, or 5 cm where that is more."""
    faults = []
    if figures["lost"] > 0.1 * figures["frames"]:
        faults.append(f"{figures['lost']:.0f} frames lost")
    if figures.get("ate_m") is None:
        faults.append("no trajectory to compare")
    elif figures["ate_m"] > max(0.05, 0.01 * figures["way_m"]):
        faults.append("drifted")
    return "**FAILED**: " + ", ".join(faults) if faults else "held"


SPECIAL = {"name", "run_name", "run_type", "repetitions", "repetition_index", "threads",
           "iterations", "real_time", "cpu_time", "time_unit", "family_index",
           "per_family_instance_index"}


def micro(entries):
    rows = []
    for name, entry in entries.items():
        counters = ", ".join(f"{key} {value:,.4g}" if value < 1e4 else f"{key} {value:,.0f}"
                             for key, value in entry.items() if key not in SPECIAL)
        rows.append([f"`{name}`", f"{entry['cpu_time']:.3g} {entry['time_unit']}", counters])
    return table(["benchmark", "CPU time", "counters"], rows)


def ratio(entries, theirs, ours):
    return entries[theirs]["cpu_time"] / entries[ours]["cpu_time"]


def adjustments(slam):
    """Our local adjustment beside Ceres' in one sentence."""
    ours, theirs = (slam[name]["cost_after"]
                    for name in ("localAdjustment", "localAdjustmentByCeres"))
    times = ratio(slam, "localAdjustmentByCeres", "localAdjustment")
    return (f"Local adjustment takes 1/{times:.1f} of Ceres' time and ends at "
            f"{ours / theirs:.6f} of Ceres' cost.")


def limit(features, instructions):
    """What extraction must cost and does.
    \\param instructions features -> [instructions, cache misses] of one extraction"""
    entry = features["extraction/count:1000"]
    traffic = entry["traffic_bytes"]
    copy_ms = features["copyOfPyramidTraffic"]["cpu_time"]
    rows = [["bytes of pyramid read and written a frame, without any cache",
             f"{traffic / 1e6:.2f} MB"],
            ["copying as many bytes, the lower limit", f"{copy_ms:.2f} ms"],
            ["extraction of 1000 features", f"{entry['cpu_time']:.2f} ms, "
             f"{entry['cpu_time'] / copy_ms:.1f} times the limit"],
            ["`cv::ORB` for as many", f"{features['openCvOrb/count:1000']['cpu_time']:.2f} ms, "
             f"{ratio(features, 'openCvOrb/count:1000', 'extraction/count:1000'):.1f} times ours"]]
    if instructions:
        (few, low), (many, high) = sorted(instructions.items())
        each = (high[0] - low[0]) / (many - few)
        rows += [["instructions a feature (selection, orientation, descriptor)", f"{each:,.0f}"],
                 ["instructions for the pyramid and its corners",
                  f"{(low[0] - few * each) / 1e6:.1f} million"],
                 [f"first-level cache misses at {few} features, in bytes",
                  f"{64 * low[1] / 1e6:.2f} MB"]]
    else:
        rows.append(["instructions", "valgrind is not installed"])
    return table(["", ""], rows)
