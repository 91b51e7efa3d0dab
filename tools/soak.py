#!/usr/bin/env python3
"""Runs two small scenes for very many steps and judges what must not change with time.

    tools/soak.py -o soak                       200 000 steps each
    tools/soak.py -o soak --steps 2000          the short form
    tools/soak.py -o soak --only tablet         one of the two
    tools/soak.py -o soak --judge               the table once more, from what lies there

`spill` (scenes/soak/spill.json) lets liquid in and out all the time: its memory must stay flat, its count must balance in
every line of stats.csv, its ids must be distinct, its files readable. `tablet` (scenes/tablet.json) comes to rest after 5 s:
its kinetic energy must stay under the bound of the tablet's test and its centre of mass where it is. Prints a table; exits
with 1 when a check failed.
"""

import argparse
import csv
import json
import math
import os
import pathlib
import struct
import subprocess
import sys
import time

STEP = 0.008  # s: the longest step of these scenes, so that a run of N such steps takes N steps or more
SETTLED = 6.0  # s: the film has been at rest for a second
KINETIC_BOUND = 1.0  # J: what the tablet's test (tests/golden) calls quiet
DRIFT_BOUND = 0.01  # dx: of the centre of mass, once settled
MEMORY_BOUND = 1 << 20  # bytes over the whole run: five a step in 200 000
PAGE = os.sysconf("SC_PAGESIZE")


class Checks:
    """The table of what was held against what."""

    def __init__(self):
        self.rows = []

    def add(self, what, measured, bound, good):
        self.rows.append((what, measured, bound, "pass" if good else "FAIL"))

    def all_good(self):
        return all(row[3] == "pass" for row in self.rows)

    def print(self):
        rows = [("check", "measured", "bound", "verdict"), *self.rows]
        widths = [max(len(row[k]) for row in rows) for k in range(4)]
        for row in rows:
            print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())


def slope(points):
    """The least-squares slope of [(x, y)], or 0 where there is none."""
    mean_x = sum(x for x, _ in points) / max(1, len(points))
    mean_y = sum(y for _, y in points) / max(1, len(points))
    spread = sum((x - mean_x) ** 2 for x, _ in points)
    return sum((x - mean_x) * (y - mean_y) for x, y in points) / spread if spread > 0 else 0.0


def resident(process):
    """Bytes of a process that lie in memory, or None once it is gone."""
    try:
        return int(pathlib.Path(f"/proc/{process.pid}/statm").read_text().split()[1]) * PAGE
    except (OSError, IndexError):
        return None


def last_step(path):
    """The step of the last whole line of a stats.csv that may be growing, or None."""
    try:
        with open(path, "rb") as file:
            file.seek(max(0, path.stat().st_size - 4096))
            return int(file.read().split(b"\n")[-2].split(b",")[0])
    except (OSError, ValueError, IndexError):
        return None


def run(options, scene, folder, settings):
    """Runs a scene; returns its exit code and its memory over time as [(step, bytes)]."""
    command = [options.sessile, "run", scene, "-o", folder, "--progress", "none"]
    for setting in settings:
        command += ["--set", setting]
    samples = []
    with open(folder.with_suffix(".log"), "w") as log:
        process = subprocess.Popen(list(map(str, command)), stdout=log, stderr=subprocess.STDOUT)
        try:
            while process.poll() is None:
                step, memory = last_step(folder / "stats.csv"), resident(process)
                if step is not None and memory:
                    samples.append((step, memory))
                time.sleep(options.sample)
        finally:
            if process.poll() is None:
                process.terminate()
                process.wait()
    return process.returncode, samples


def stats(folder):
    """The lines of stats.csv as dictionaries, units taken off the names."""
    with open(folder / "stats.csv", newline="") as file:
        lines = list(csv.reader(file))
    names = [name.split(" [")[0] for name in lines[0]]
    if any(len(line) != len(names) for line in lines):
        raise ValueError("a line of stats.csv is not whole")
    return [dict(zip(names, line)) for line in lines[1:]]


def read_frame(path):
    """Step and {id: (x, y, z)} of a PLY frame; throws where it is not as long as its head says."""
    head, _, body = path.read_bytes().partition(b"end_header\n")
    letters, names, count, step = "<", [], 0, 0
    for line in head.decode().splitlines():
        words = line.split()
        if words[0] == "comment":
            step = int(words[-1])
        elif words[:2] == ["element", "vertex"]:
            count = int(words[2])
        elif words[0] == "property":
            letters += {"float": "f", "int": "i"}[words[1]]
            names.append(words[2])
    if len(body) != count * struct.calcsize(letters):
        raise ValueError(f"{path}: {len(body)} bytes for {count} particles")
    columns = [names.index(name) for name in ("id", "x", "y", "z")]
    particles = {}
    for row in struct.iter_unpack(letters, body):
        if row[columns[0]] in particles:
            raise ValueError(f"{path}: two particles with the id {row[columns[0]]}")
        particles[row[columns[0]]] = tuple(row[k] for k in columns[1:])
    if not all(math.isfinite(x) for place in particles.values() for x in place):
        raise ValueError(f"{path}: a place that is not finite")
    return step, particles


def centre(particles):
    return [math.fsum(place[k] for place in particles.values()) / len(particles) for k in range(3)]


def check_files(options, folder, rows, checks):
    """That everything written can be read, and that frames and stats.csv tell the same. Returns [(step, particles)]."""
    frames, faults = [], []
    counts = {int(row["step"]): row for row in rows}
    start = int(rows[0]["particles"]) + int(rows[0]["out"]) - int(rows[0]["emitted"])
    for path in sorted(folder.glob("frame_*.ply")):
        try:
            step, particles = read_frame(path)
        except (ValueError, KeyError) as fault:
            faults.append(str(fault))
            continue
        frames.append((step, particles))
        row = counts.get(step)  # the two schedules may round apart: then there is nothing to compare with
        if row is None:
            continue
        if int(row["particles"]) != len(particles):
            faults.append(f"{path.name}: {len(particles)} particles, not what stats.csv has at step {step}")
        elif particles and max(particles) >= start + int(row["emitted"]):
            faults.append(f"{path.name}: the id {max(particles)} was never given out")
    summary = json.loads((folder / "summary.json").read_text())
    if len(frames) != summary["frames"] or len(list(folder.glob("frame_*.vtp"))) != summary["frames"]:
        faults.append(f"{len(frames)} frames can be read of {summary['frames']}")
    compared = sum(step in counts for step, _ in frames)
    if compared < 0.9 * len(frames):
        faults.append(f"only {compared} of {len(frames)} frames have a line of stats.csv")
    last = max(0, summary["frames"] - 2)
    for arguments in (["check", folder / "scene.json"], ["mesh", folder, "--frames", f"{last}:", "--progress", "none"]):
        done = subprocess.run([str(options.sessile), *map(str, arguments)], capture_output=True, text=True)
        if done.returncode != 0:
            faults.append(f"sessile {arguments[0]}: {done.stderr.strip()}")
    for fault in faults[:5]:
        print(f"{folder.name}: {fault}", file=sys.stderr)
    checks.add(f"{folder.name}: files that cannot be read or disagree, of {len(frames)} frames", str(len(faults)), "0",
               not faults and bool(frames))
    return frames


def check_run(options, name, code, samples, rows, folder, checks):
    """What both runs owe."""
    summary = json.loads((folder / "summary.json").read_text())
    checks.add(f"{name}: exit code", str(code), "0", code == 0)
    checks.add(f"{name}: steps", str(summary["steps"]), f">= {options.steps}", summary["steps"] >= options.steps)
    finite = all(math.isfinite(float(row["kinetic_energy"])) for row in rows)
    checks.add(f"{name}: energies not finite", str(int(not finite)), "0", finite)
    start = int(rows[0]["particles"]) + int(rows[0]["out"]) - int(rows[0]["emitted"])
    unbalanced = sum(int(row["particles"]) != start + int(row["emitted"]) - int(row["out"]) for row in rows)
    checks.add(f"{name}: lines whose count does not balance, of {len(rows)}", str(unbalanced), "0", unbalanced == 0)
    checks.add(f"{name}: passages through a solid", str(summary["lost"]), "0", summary["lost"] == 0)
    late = [(step, memory) for step, memory in samples if step > summary["steps"] / 2]
    growth = slope(late) * summary["steps"]
    checks.add(f"{name}: memory, growth over the run by the slope of its second half ({len(late)} samples)",
               f"{growth / 1024:.0f} KiB" if len(late) > 2 else "too few samples", f"< {MEMORY_BOUND >> 10} KiB",
               len(late) > 2 and growth < MEMORY_BOUND)
    print(f"{name}: {summary['steps']} steps to {summary['simulated_time_s']:.0f} s, {summary['wall_time_s']['total']:.0f} s "
          f"of wall time; {summary['emitted']} let in, {summary['out']} out, {summary['particles']} at the end; memory "
          f"{min((m for _, m in samples), default=0) >> 10} to {max((m for _, m in samples), default=0) >> 10} KiB, peak "
          f"{summary['memory_bytes']['peak'] >> 10} KiB; {summary['unconverged_solves']} solves above their error")
    return summary


def output_settings(end, frames, stats_lines):
    return [f"time.end={end}", f"output.frame_interval={end / frames}", f"output.stats_interval={end / stats_lines}",
            'output.formats=["vtp","ply"]', 'output.fields=["id","velocity"]']


def soak(options, name, scene, checks):
    folder = options.output / name
    end = STEP * options.steps
    frames = max(4, min(400, options.steps // 200))
    if options.judge:
        lines = (folder / "memory.csv").read_text().split()[1:]
        code, samples = 0, [tuple(map(int, line.split(","))) for line in lines]
    else:
        code, samples = run(options, scene, folder, output_settings(end, frames, 10 * frames))
        (folder / "memory.csv").write_text("step,bytes\n" + "".join(f"{step},{memory}\n" for step, memory in samples))
    rows = stats(folder)
    check_run(options, name, code, samples, rows, folder, checks)
    return rows, check_files(options, folder, rows, checks)


def soak_spill(options, checks):
    rows, frames = soak(options, "spill", options.scenes / "soak" / "spill.json", checks)
    newest = [max(particles) for _, particles in frames if particles]
    grows = len(newest) > 1 and all(a <= b for a, b in zip(newest, newest[1:])) and newest[0] < newest[-1]
    checks.add("spill: greatest id in a frame, from the first frame to the last", f"{newest[0]} .. {newest[-1]}", "grows", grows)
    out = int(rows[-1]["out"])
    checks.add("spill: particles that left", str(out), "> 0", out > 0)


def soak_tablet(options, checks):
    rows, frames = soak(options, "tablet", options.scenes / "tablet.json", checks)
    times = {int(row["step"]): float(row["time"]) for row in rows}
    rest = [row for row in rows if float(row["time"]) >= SETTLED]
    greatest = max((float(row["kinetic_energy"]) for row in rest), default=math.inf)
    checks.add(f"tablet: greatest kinetic energy after {SETTLED:g} s", f"{greatest:.3g} J", f"< {KINETIC_BOUND:g} J",
               greatest < KINETIC_BOUND)
    centres = [(times[step], centre(particles)) for step, particles in frames if times.get(step, 0) >= SETTLED]
    spacing = json.loads((options.output / "tablet" / "scene.json").read_text())["spacing"]
    drift = max((math.dist(at, centres[0][1]) / spacing for _, at in centres), default=math.inf)
    checks.add(f"tablet: drift of the centre of mass after {SETTLED:g} s", f"{drift:.2g} dx", f"< {DRIFT_BOUND:g} dx",
               len(centres) > 1 and drift < DRIFT_BOUND)


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, metavar="DIR")
    parser.add_argument("--steps", type=int, default=200000, help="of each run (default: %(default)s)")
    parser.add_argument("--only", choices=["spill", "tablet"], help="one of the two")
    parser.add_argument("--sample", type=float, default=1.0, metavar="SECONDS", help="between looks at the memory")
    parser.add_argument("--judge", action="store_true", help="run nothing, judge what an earlier call left in DIR")
    parser.add_argument("--scenes", type=pathlib.Path, default=root / "scenes", help="folder of the scenes")
    parser.add_argument("--sessile", default="build/release/bin/sessile", help="the program (default: %(default)s)")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    checks = Checks()
    for name, work in (("spill", soak_spill), ("tablet", soak_tablet)):
        if options.only in (None, name):
            work(options, checks)
    checks.print()
    return 0 if checks.all_good() else 1


if __name__ == "__main__":
    sys.exit(main())
