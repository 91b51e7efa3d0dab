"""Runs a scene of SPlisHSPlasH for some steps, without a window, and prints what it did as a line of JSON.

Started by compare.py with the Python of the virtual environment: splishsplash_run.py SCENE STEPS FOLDER
"""
import ctypes
import json
import math
import sys
import time


def load():
    # The wheel brings parts of OpenGL's dispatch of its own. Unless the system's library comes first, as a whole, the
    # two mix and the import ends in a segmentation fault.
    try:
        ctypes.CDLL("libGL.so.1", mode=ctypes.RTLD_GLOBAL)
    except OSError as error:
        raise SystemExit(f"missing library: {error} (on Debian: apt-get install libgl1)")
    try:
        import pysplishsplash
    except ImportError as error:
        raise SystemExit(f"missing library: {error} (on Debian: apt-get install libgl1 libglu1-mesa libx11-6)")
    return pysplishsplash


def main():
    sph = load()
    if len(sys.argv) == 2 and sys.argv[1] == "--only-import":
        return
    scene, steps, folder = sys.argv[1], int(sys.argv[2]), sys.argv[3]
    base = sph.Exec.SimulatorBase()
    base.init(sceneFile=scene, useGui=False, outputDir=folder, initialPause=False, useCache=False, stopAt=1e6)
    base.initSimulation()
    simulation, clock = sph.Simulation.getCurrent(), sph.TimeManager.getCurrent()
    solver, fluid = simulation.getTimeStep(), simulation.getFluidModel(0)
    divergence = getattr(solver, "SOLVER_ITERATIONS_V", None)
    ends, iterations, divergence_iterations = [], [], []

    def after_each_step():
        ends.append(time.perf_counter())
        iterations.append(solver.getValueUInt(solver.SOLVER_ITERATIONS))
        if divergence is not None:
            divergence_iterations.append(solver.getValueUInt(divergence))
        if len(ends) > steps:
            base.setValueFloat(base.STOP_AT, 1e-6)  # any time that has passed; 0 would mean never

    base.setTimeStepCB(after_each_step)
    base.runSimulation()
    boundaries = [simulation.getBoundaryModel(i).numberOfParticles() for i in range(simulation.numberOfBoundaryModels())]
    positions = [fluid.getPosition(i) for i in range(fluid.numActiveParticles())]
    # The first step sets up the boundary as well: it is made, and not timed.
    print(json.dumps({
        "seconds": ends[steps] - ends[0], "steps": steps, "dt": clock.getTimeStepSize(), "time": clock.getTime(),
        "particles": fluid.numActiveParticles(), "boundary": sum(boundaries), "mass": fluid.getMass(0),
        "support_radius": simulation.getSupportRadius(), "solver": type(solver).__name__,
        "error": solver.getValueFloat(solver.MAX_ERROR) / 100,
        "iterations": sum(iterations[1:]) / steps,
        "divergence_iterations": sum(divergence_iterations[1:]) / steps,
        "cfl_method": simulation.getValueInt(simulation.CFL_METHOD),
        "not_finite": sum(not all(map(math.isfinite, x)) for x in positions),
        "mean_height": sum(float(x[1]) for x in positions) / len(positions)}), flush=True)


if __name__ == "__main__":
    main()
