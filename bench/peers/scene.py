"""A scene of scenes/bench as SPlisHSPlasH reads it: the one description of both is ours."""
import itertools
import json
import pathlib
import re
import struct

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes/bench"
METHODS = {"iisph": 3, "dfsph": 4}  # their numbers in a scene file
PARTICLE_MASS = 0.8                 # of rho0 dx^3: what SPlisHSPlasH gives a particle, and our scenes ask for


def read(name):
    """The scene as an object, its comments left out."""
    text = (SCENES / f"{name}.json").read_text()
    return json.loads(re.sub(r'("(?:\\.|[^"\\])*")|//[^\n]*', lambda match: match[1] or "", text))


def lattice(center, size, spacing, ends):
    """Coordinates along one axis: of cells that fill the size, or with `ends` of points from one end to the other."""
    count = round(size / spacing) + (1 if ends else 0)
    return [center + (i - (count - 1) / 2) * spacing for i in range(count)]


def fluid_points(scene):
    """Particles in the middles of the cells that fill each box."""
    points = []
    for body in scene["bodies"]:
        axes = [lattice(c, s, scene["spacing"], False) for c, s in zip(body["placement"]["position"], body["shape"]["size"])]
        points += itertools.product(*axes)
    return points


def surface_points(solid, spacing):
    """Points of a lattice on the faces of a box."""
    axes = [lattice(c, s, spacing, True) for c, s in zip(solid["placement"]["position"], solid["shape"]["size"])]
    faces = [{axis[0], axis[-1]} for axis in axes]
    return [point for point in itertools.product(*axes) if any(x in face for x, face in zip(point, faces))]


def write_bgeo(path, points):
    """Houdini's classic particle file, big-endian, without attributes; y is up there."""
    with open(path, "wb") as file:
        file.write(b"BgeoV" + struct.pack(">9i", 5, len(points), 0, 0, 0, 0, 0, 0, 0))
        for x, y, z in points:
            file.write(struct.pack(">4f", x, z, y, 1))
        file.write(b"\x00\xff")


def write_cube(path):
    """A body needs a mesh, though its samples are given."""
    corners = itertools.product((-0.5, 0.5), repeat=3)
    faces = ((1, 2, 4), (1, 4, 3), (5, 7, 8), (5, 8, 6), (1, 5, 6), (1, 6, 2), (3, 4, 8), (3, 8, 7), (1, 3, 7), (1, 7, 5),
             (2, 6, 8), (2, 8, 4))
    lines = ["v {} {} {}".format(*corner) for corner in corners] + ["f {} {} {}".format(*face) for face in faces]
    path.write_text("\n".join(lines) + "\n")


def refuse_what_has_no_counterpart(scene):
    """Only what this page translates may stand in the scene."""
    masses = {body.get("mass_factor", 1) for body in scene["bodies"]}
    if masses != {PARTICLE_MASS}:
        raise SystemExit(f"the scene's particles weigh {masses} rho0 dx^3, SPlisHSPlasH's {PARTICLE_MASS}")
    if "fixed_dt" not in scene["time"]:
        raise SystemExit("the scene has no fixed step")
    shapes = {body["shape"]["type"] for body in scene["bodies"]} | {solid["shape"]["type"] for solid in scene["solids"]}
    if not shapes <= {"box", "container"}:
        raise SystemExit(f"the scene has shapes other than boxes: {shapes}")
    if any(solid.get("viscosity", 1) != 0 for solid in scene["solids"]):
        raise SystemExit("the scene's walls are viscous")


def write(scene, method, folder):
    """Writes scene.json and the files it names into the folder; returns the counts of fluid and boundary particles."""
    refuse_what_has_no_counterpart(scene)
    folder.mkdir(parents=True, exist_ok=True)
    write_cube(folder / "cube.obj")
    fluid = fluid_points(scene)
    write_bgeo(folder / "fluid.bgeo", fluid)
    bodies, boundary = [], 0
    for number, solid in enumerate(scene["solids"]):
        samples = surface_points(solid, scene["spacing"])
        boundary += len(samples)
        write_bgeo(folder / f"solid_{number}.bgeo", samples)
        bodies.append({"geometryFile": "cube.obj", "particleFile": f"solid_{number}.bgeo", "translation": [0, 0, 0],
                       "rotationAxis": [1, 0, 0], "rotationAngle": 0, "scale": [1, 1, 1], "isDynamic": False,
                       "isWall": False, "mapInvert": False})
    pressure, density = scene["pressure"], scene["fluid"]["rest_density"]
    limits = {"minIterations": pressure.get("min_iterations", 2), "maxIterations": pressure.get("max_iterations", 200),
              "maxError": 100 * pressure["error"]}  # in percent
    result = {
        "Configuration": {
            "particleRadius": scene["spacing"] / 2, "timeStepSize": scene["time"]["fixed_dt"], "cflMethod": 0,
            "simulationMethod": METHODS[method], "boundaryHandlingMethod": 0, "gravitation": [0, -9.81, 0],
            "stopAt": 1e6, "IISPH": limits,
            "DFSPH": {**limits, "maxIterationsV": 200, "maxErrorV": 0.1, "enableDivergenceSolver": True}},
        "Materials": [{
            "id": "Fluid", "density0": density, "viscosityMethod": 1, "surfaceTensionMethod": 2,
            "Standard viscosity": {"viscosity": scene["fluid"]["viscosity"] / density, "viscosityBoundary": 0},
            "Akinci et al. 2013": {"surfaceTension": 1, "surfaceTensionBoundary": 1}}],
        "FluidModels": [{"id": "Fluid", "particleFile": "fluid.bgeo", "translation": [0, 0, 0], "scale": [1, 1, 1]}],
        "RigidBodies": bodies}
    (folder / "scene.json").write_text(json.dumps(result, indent=1))
    return len(fluid), boundary
