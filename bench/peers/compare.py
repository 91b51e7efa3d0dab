#!/usr/bin/env python3
"""Times SPlisHSPlasH and Sessile on the same scenes, in turn, and checks that they do the same work. See README.md."""
import argparse
import json
import os
import pathlib
import statistics
import subprocess

import scene as scenes
import wheel

SESSILE = wheel.HERE.parents[1] / "build/release/bin/sessile"
CASES = {"s1": 250, "s2_250k": 40}  # steps
STAGES = ("neighbors", "density", "forces", "time_step", "pressure", "integration")
DIFFERENCES = """\
What differs all the same:
- Errors: its IISPH ends when a signed mean is small, in which deficits at the surface cancel compression; ours counts
  compression only, and takes more iterations for it.
- Tension: its Akinci 2013 with coefficients 1; ours the scene's surface_feature (cohesion, area, adhesion).
- Start: its first step sets up the boundary, and is made but not timed. Ours are all timed, without output and measures.
- Threads wait as OMP_WAIT_POLICY says; unset, its spin and ours soon sleep. Set it for both when other work runs beside."""


def run(command, environment):
    done = subprocess.run([str(word) for word in command], env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        tail = "\n".join((done.stdout + done.stderr).strip().splitlines()[-5:])
        wheel.fail(f"{command[0]} ended with {done.returncode}:\n{tail}")
    return done.stdout


def run_peer(python, folder, steps, environment):
    out = run([python, wheel.HERE / "splishsplash_run.py", folder / "scene.json", steps, folder / "out"], environment)
    lines = [line for line in out.splitlines() if line.startswith("{")]
    if not lines:
        wheel.fail(f"SPlisHSPlasH said nothing of its run:\n{out[-500:]}")
    result = json.loads(lines[-1])
    result["ms"] = 1e3 * result["seconds"] / steps
    result["steps"] += 1  # the first, which is not timed
    return result


def run_ours(program, name, scene, method, folder, steps, environment):
    dt = scene["time"]["fixed_dt"]
    pressure = {"error": scene["pressure"]["error"], "type": method, **{
        key: scene["pressure"][key] for key in ("min_iterations", "max_iterations") if key in scene["pressure"]}}
    if method == scene["pressure"]["type"]:
        pressure = scene["pressure"]
    run([program, "run", scenes.SCENES / f"{name}.json", "-o", folder, "--until", (steps + 1) * dt, "--progress", "none",
         "--set", "pressure=" + json.dumps(pressure)], environment)
    summary = json.loads((folder / "summary.json").read_text())
    seconds = sum(summary["wall_time_s"][stage] for stage in STAGES)
    return {"ms": 1e3 * seconds / summary["steps"], "steps": summary["steps"], "particles": summary["particles"],
            "boundary": summary["wall_particles"], "dt": summary["simulated_time_s"] / summary["steps"],
            "time": summary["simulated_time_s"], "error": summary["scene"]["pressure"]["error"],
            "iterations": summary["iterations_per_step"],
            "divergence_iterations": summary["divergence_iterations"] / summary["steps"], "not_finite": 0,
            "unconverged": summary["unconverged_solves"], "lost": summary["lost"]}


def faults(peer, ours, expected):
    """Where the two did not do the same work."""
    found = []
    for what in ("particles", "boundary", "steps"):
        if not peer[what] == ours[what] == expected[what]:
            found.append(f"{what}: SPlisHSPlasH {peer[what]}, Sessile {ours[what]}, expected {expected[what]}")
    for what in ("dt", "error"):
        if abs(peer[what] / ours[what] - 1) > 1e-4:
            found.append(f"{what}: SPlisHSPlasH {peer[what]:g}, Sessile {ours[what]:g}")
    if abs(peer["mass"] / (expected["mass"]) - 1) > 1e-4:
        found.append(f"particle mass: SPlisHSPlasH {peer['mass']:g} kg, Sessile {expected['mass']:g} kg")
    if peer["cfl_method"] != 0:
        found.append("SPlisHSPlasH chose its time steps itself")
    if peer["not_finite"]:
        found.append(f"SPlisHSPlasH ended with {peer['not_finite']} particles at no finite place")
    return found


def line(name, runs):
    times = [run["ms"] for run in runs]
    turns = f"{runs[0]['iterations']:.2f}" + (f" + {runs[0]['divergence_iterations']:.2f}" if runs[0]["divergence_iterations"] else "")
    print(f"  {name:<22}{statistics.median(times):>10.1f}{min(times):>10.1f} .. {max(times):<10.1f}{turns:>14}")


def compare(name, arguments, python, environment):
    scene = scenes.read(name)
    steps = arguments.steps or (3 if arguments.quick else CASES[name])
    all_faults, results = [], {}
    print(f"\n{scene['title']}, {steps} steps of {1e3 * scene['time']['fixed_dt']:g} ms, "
          f"error {100 * scene['pressure']['error']:g} %\n"
          f"  {'':<22}{'ms/step':>10}{'least .. greatest':>24}{'iterations':>14}", flush=True)
    folders = {}
    for method in arguments.methods:
        folders[method] = wheel.BUILD / f"{name}_{method}"
        fluid, boundary = scenes.write(scene, method, folders[method])
        results[method] = ([], [])
    mass = scenes.PARTICLE_MASS * scene["fluid"]["rest_density"] * scene["spacing"] ** 3
    expected = {"particles": fluid, "boundary": boundary, "steps": steps + 1, "mass": mass}
    for _ in range(arguments.runs):
        for method, (theirs, ours) in results.items():
            theirs.append(run_peer(python, folders[method], steps, environment))
            ours.append(run_ours(arguments.sessile, name, scene, method, folders[method] / "sessile", steps, environment))
            all_faults += faults(theirs[-1], ours[-1], expected)
    for method, (theirs, ours) in results.items():
        line(f"SPlisHSPlasH {method}", theirs)
        line(f"Sessile {method}", ours)
    for method, (theirs, ours) in results.items():
        ratios = [a["ms"] / b["ms"] for a, b in zip(theirs, ours)]
        print(f"  {method}: SPlisHSPlasH takes {statistics.median(ratios):.2f} times as long "
              f"({min(ratios):.2f} .. {max(ratios):.2f} in {len(ratios)} pairs)")
    for fault in dict.fromkeys(all_faults):
        print(f"  NOT THE SAME WORK: {fault}")
    if not all_faults:
        print(f"  The same work: {fluid} particles, {boundary} boundary particles, {steps + 1} steps, dt and error bound.")
    return all_faults, {method: {"splishsplash": theirs, "sessile": ours} for method, (theirs, ours) in results.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--case", action="append", choices=CASES, help="what to run (default: all)")
    parser.add_argument("--methods", type=lambda text: text.split(","), default=list(scenes.METHODS), help="default: iisph,dfsph")
    parser.add_argument("--runs", type=int, default=5, help="pairs of runs, in turn (default: 5)")
    parser.add_argument("--steps", type=int, default=0, help="timed steps of a run (default: 250 of S1, 40 of the block)")
    parser.add_argument("--quick", action="store_true", help="3 steps, one pair: does it work?")
    parser.add_argument("--threads", type=int, default=os.cpu_count(), help="threads of each program (default: all)")
    parser.add_argument("--sessile", type=pathlib.Path, default=SESSILE, help="our program (default: the release build)")
    parser.add_argument("--version", default=wheel.VERSION, help=f"of the wheel (default: {wheel.VERSION})")
    arguments = parser.parse_args()
    if arguments.quick:
        arguments.runs = 1
    if arguments.runs < 1 or arguments.steps < 0 or arguments.threads < 1:
        parser.error("--runs and --threads must be at least 1, --steps not negative")
    for method in arguments.methods:
        if method not in scenes.METHODS:
            parser.error(f"{method} is none of {', '.join(scenes.METHODS)}")
    if not arguments.sessile.exists():
        wheel.fail(f"{arguments.sessile} is not there: build it first, or give --sessile")
    python = wheel.install(arguments.version)
    environment = {**os.environ, "OMP_NUM_THREADS": str(arguments.threads)}
    print(f"SPlisHSPlasH {arguments.version} (wheel): {wheel.instruction_set(python)}")
    print("Sessile: " + " ".join(run([arguments.sessile, "info"], environment).split()))
    every_fault, everything = [], {}
    for name in arguments.case or CASES:
        found, everything[name] = compare(name, arguments, python, environment)
        every_fault += found
    print("\n" + DIFFERENCES)
    (wheel.BUILD / "results.json").write_text(json.dumps(everything, indent=1) + "\n")
    print(f"\nEvery run is in {wheel.BUILD / 'results.json'}")
    raise SystemExit(1 if every_fault else 0)


if __name__ == "__main__":
    main()
