#!/usr/bin/env python3
"""Compares methods over a grid of scene values, and says for each where it stays sound.

    tools/sweep.py scenes/violent.json --vary 'fluid.viscosity=20,5,1' \\
        --vary 'bodies[0].placement.position[2]=1.55,3.55,6.55' -o sweep -- --methods akinci2013,paper --search-dt

Runs `sessile compare SCENE --set ... ` for every combination, in sweep/0, sweep/1 ..., and writes sweep/sweep.md: one line per
combination, one column per method. What follows `--` goes to compare. Runs that are done are not made again.
"""

import argparse
import itertools
import json
import pathlib
import subprocess
import sys


def split_values(text):
    path, sign, values = text.partition("=")
    if not sign or not path or not values:
        raise argparse.ArgumentTypeError(f"{text!r} is not PATH=VALUE,VALUE...")
    return path, values.split(",")


def options():
    words = sys.argv[1:]
    cut = words.index("--") if "--" in words else len(words)
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scene")
    parser.add_argument("--vary", type=split_values, action="append", required=True, metavar="PATH=VALUE,VALUE...")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, metavar="DIR")
    parser.add_argument("--sessile", default="build/release/bin/sessile", help="the program (default: %(default)s)")
    chosen = parser.parse_args(words[:cut])
    chosen.compare = words[cut + 1:]
    return chosen


def verdict(method):
    """One cell: the verdict of the method's own steps, and the largest sound fixed one."""
    if not method["runs"]:
        return "not reached"
    first = method["runs"][0]
    text = "sound" if first["sound"] else f"**unsound** at {first['verdict_time_s']:.3g} s"
    text += f", {1e3 * first['dt_mean_s']:.2g} ms on average"
    if first["lost"]:
        text += f", {first['lost']} lost"
    if method["searched"]:
        largest = method["largest_sound_dt_s"]
        text += "; no fixed step" if largest is None else f"; fixed up to {1e3 * largest:g} ms"
    return text


def main():
    chosen = options()
    paths = [path for path, _ in chosen.vary]
    lines, names = [], []
    for number, values in enumerate(itertools.product(*(values for _, values in chosen.vary))):
        folder = chosen.output / str(number)
        command = [chosen.sessile, "compare", chosen.scene, "-o", str(folder), *chosen.compare]
        for path, value in zip(paths, values):
            command += ["--set", f"{path}={value}"]
        print(" ".join(f"{path}={value}" for path, value in zip(paths, values)), flush=True)
        code = subprocess.run(command).returncode
        if code != 0:
            sys.exit(f"{' '.join(command)}: exit code {code}")
        report = json.loads((folder / "comparison.json").read_text())
        names = [method["name"] for method in report["methods"]]
        lines.append(list(values) + [verdict(method) for method in report["methods"]])
    table = [paths + names, ["---"] * (len(paths) + len(names))] + lines
    text = "".join("| " + " | ".join(line) + " |\n" for line in table)
    chosen.output.mkdir(parents=True, exist_ok=True)
    (chosen.output / "sweep.md").write_text(f"Scene `{chosen.scene}`\n\n{text}")
    print(text, end="")


if __name__ == "__main__":
    main()
