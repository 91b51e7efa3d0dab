#!/usr/bin/env python3
"""Times splashsurf (the Python package pysplashsurf) and `sessile mesh` on one frame, in turn, and measures both meshes.

surfaces.py FOLDER [--frame N] [--threads N] [--runs N]     FOLDER: of `sessile run` with "ply" among its output.formats
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import tempfile
import time

try:
    import numpy
except ImportError as error:
    raise SystemExit(f"surfaces: missing package: {error} (pip install numpy pysplashsurf)")

SESSILE = pathlib.Path(__file__).resolve().parents[2] / "build/release/bin/sessile"
# In particle radii. Their smoothing is what splashsurf's own documentation advises.
COMMON = {"smoothing_length": 2.0, "cube_size": 0.75, "iso_surface_threshold": 0.6}
SMOOTHING = {"mesh_smoothing_iters": 25, "mesh_smoothing_weights": True, "normals_smoothing_iters": 10, "compute_normals": True}


def read_points(path):
    """x y z of a frame, whose properties all have four bytes."""
    data = path.read_bytes()
    start = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:start].decode()
    width = len(re.findall(r"^property ", header, re.M))
    return numpy.frombuffer(data[start:], "<f4").reshape(-1, width)[:, :3].copy()


def read_obj(path):
    vertices, triangles = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            triangles.append([int(word.split("/")[0]) - 1 for word in words[1:4]])
    return numpy.array(vertices), numpy.array(triangles)


def figures(vertices, triangles):
    """Volume, area and rms angle of neighbouring triangles [degrees]."""
    a, b, c = (vertices[triangles[:, k]] - vertices[0] for k in range(3))
    normals = numpy.cross(b - a, c - a)
    lengths = numpy.linalg.norm(normals, axis=1)
    edges = numpy.sort(numpy.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    owners = numpy.tile(numpy.arange(len(triangles)), 3)
    order = numpy.lexsort((edges[:, 1], edges[:, 0]))
    edges, owners = edges[order], owners[order]
    same = (edges[1:] == edges[:-1]).all(axis=1)
    first, second = owners[:-1][same], owners[1:][same]
    sound = (lengths[first] > 0) & (lengths[second] > 0)
    first, second = first[sound], second[sound]
    cosine = (normals[first] * normals[second]).sum(axis=1) / (lengths[first] * lengths[second])
    angle = numpy.degrees(numpy.sqrt((numpy.arccos(cosine.clip(-1, 1)) ** 2).mean()))
    return (a * numpy.cross(b, c)).sum() / 6, lengths.sum() / 2, angle


def run_splashsurf(points, radius):
    import pysplashsurf
    start = time.perf_counter()
    mesh, _ = pysplashsurf.reconstruction_pipeline(points, particle_radius=radius, **COMMON, **SMOOTHING)
    return time.perf_counter() - start, mesh


def run_sessile(folder, frame, threads, out):
    done = subprocess.run([SESSILE, "mesh", folder, "-o", out, "--format", "obj", f"--frames={frame}", "--again", "--threads",
                           str(threads), "--progress", "none"], capture_output=True, text=True)
    took = re.search(r"took ([0-9.]+) s to reconstruct", done.stdout)
    if done.returncode != 0 or took is None:
        raise SystemExit(f"surfaces: sessile mesh failed:\n{done.stdout}{done.stderr}")
    return float(took[1])


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("folder", type=pathlib.Path)
    arguments.add_argument("--frame", type=int, default=-1, help="by its place; -1 is the last (default)")
    arguments.add_argument("--threads", type=int, default=os.cpu_count())
    arguments.add_argument("--runs", type=int, default=5)
    given = arguments.parse_args()
    frames = sorted(given.folder.glob("frame_*.ply"))
    if not frames:
        raise SystemExit(f"surfaces: {given.folder} holds no frame_*.ply; run with --set 'output.formats=[\"ply\"]'")
    os.environ["RAYON_NUM_THREADS"] = str(given.threads)
    points = read_points(frames[given.frame])
    spacing = json.loads((given.folder / "summary.json").read_text())["scene"]["spacing"]
    times = {"splashsurf": [], "Sessile": []}
    with tempfile.TemporaryDirectory() as out:
        for _ in range(given.runs):
            seconds, mesh = run_splashsurf(points, spacing / 2)
            times["splashsurf"].append(seconds)
            times["Sessile"].append(run_sessile(given.folder, given.frame, given.threads, out))
        meshes = {"splashsurf": (numpy.asarray(mesh.mesh.vertices, float), numpy.asarray(mesh.mesh.triangles).astype(int)),
                  "Sessile": read_obj(next(pathlib.Path(out).rglob("*.obj")))}
    print(f"{len(points)} particles, {given.threads} threads, best of {given.runs}. Sessile's time holds reading the frame and its "
          "columns at the vertices.")
    for name, (vertices, triangles) in meshes.items():
        volume, area, angle = figures(vertices, triangles)
        print(f"{name:>10}: {min(times[name]):6.3f} s, {len(triangles):8d} triangles, volume {volume / len(points) / spacing**3:.3f}"
              f" of the particles', area {area:.4g} m^2, angle {angle:.1f} degrees")


if __name__ == "__main__":
    main()
