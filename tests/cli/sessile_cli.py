"""What the tests of the command line share: the program to test, scenes in a folder of their own, ways to call it."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.environ.get("SESSILE", "")
VERSION = os.environ.get("SESSILE_VERSION", "")
VARIANTS = os.environ.get("SESSILE_VARIANTS", "") == "1"  # whether the program was built for several instruction sets

FAULTS = os.environ.get("SESSILE_FAULTS", "")  # a library that makes calls of the C library fail, see faults.cpp

DONE, FAILED, BAD_INPUT, IN_USE, INTERRUPTED = 0, 1, 2, 3, 130


def ended_by(which):
    """The exit code of a run that a signal ended after the step at hand."""
    return 128 + which


def tiny(**changes):
    """A scene of 27 particles that runs in a moment: 8 steps of 5 ms, 5 frames with the first."""
    scene = {
        "spacing": 0.1,
        "time": {"end": 0.04, "fixed_dt": 0.005},
        "fluid": {"viscosity": 20},
        "forces": [{"type": "surface_feature"}],
        "bodies": [{"label": "block", "shape": {"type": "box", "size": [0.3, 0.3, 0.3]},
                    "placement": {"position": [0, 0, 0.5]}}],
        "solids": [{"label": "floor", "shape": {"type": "plate", "width": 1, "depth": 1}}],
        "output": {"frame_interval": 0.01, "stats_interval": 0.005, "formats": ["vtp", "ply"]},
    }
    scene.update(changes)
    return scene


class CliTest(unittest.TestCase):
    """Each test works in an empty folder, its current one for the program as well."""

    maxDiff = None

    def setUp(self):
        self.assertTrue(PROGRAM, "set SESSILE to the program's path")
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="sessile-cli-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def write(self, scene, name="s.json"):
        """Writes a scene, given as text or as an object; its name is what the program is told."""
        (self.folder / name).write_text(scene if isinstance(scene, str) else json.dumps(scene))
        return name

    def environment(self):
        return {**os.environ, "OMP_WAIT_POLICY": "passive", "OMP_NUM_THREADS": "1", "LC_ALL": "C"}

    def loaded(self, faults):
        """What the environment takes for a machine with these faults: CALL="fsync" and so on, see faults.cpp."""
        if not faults:
            return {}
        if not FAULTS:
            self.skipTest("SESSILE_FAULTS does not name the library of faults")
        return {"LD_PRELOAD": FAULTS, **{f"FAULT_{key}": str(value) for key, value in faults.items()}}

    def wait_for(self, *names, process=None):
        """Waits until these files are there."""
        until = time.monotonic() + 30
        while not all((self.folder / name).exists() for name in names):
            if process:
                self.assertIsNone(process.poll(), "it ended by itself")
            self.assertLess(time.monotonic(), until, f"no {names} appear")
            time.sleep(0.01)

    def call(self, *arguments, code=DONE, before="", timeout=60, program=PROGRAM, faults=None):
        """Runs the program, expects its exit code, returns (standard output, standard error). `before` is shell."""
        command = [program, *map(str, arguments)]
        if before:
            command = ["bash", "-c", before + '; exec "$@"', "bash", *command]
        result = subprocess.run(command, cwd=self.folder, env={**self.environment(), **self.loaded(faults)},
                                timeout=timeout, text=True,
                                stdin=subprocess.DEVNULL, capture_output=True)
        self.assertEqual(result.returncode, code, f"{command}\n{result.stdout}\n{result.stderr}")
        return result.stdout, result.stderr

    def refused(self, *arguments):
        """The lines on standard error of a call that must end as bad input and write nothing."""
        before = sorted(self.folder.rglob("*"))
        out, err = self.call(*arguments, code=BAD_INPUT)
        self.assertEqual(out, "")
        self.assertEqual(sorted(self.folder.rglob("*")), before, "a refused call wrote something")
        return err.splitlines()

    def start(self, *arguments, before="", faults=None, user=None):
        """The running program, ended with the test. `before` is shell, `faults` are for faults.cpp, `user` a number."""
        command = [PROGRAM, *map(str, arguments)]
        if before:
            command = ["bash", "-c", before + '; exec "$@"', "bash", *command]
        process = subprocess.Popen(command, cwd=self.folder, env={**self.environment(), **self.loaded(faults)}, text=True,
                                   user=user, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def summary(self, folder="out"):
        return json.loads((self.folder / folder / "summary.json").read_text())

    def results(self, folder):
        """What a run leaves behind, by name: bytes, but for times of the wall and memory. Without checkpoints."""
        found = {}
        for path in sorted((self.folder / folder).rglob("*")):
            name = str(path.relative_to(self.folder / folder))
            if path.is_dir() or name.startswith("checkpoints/") or path.name == ".sessile.lock":
                continue
            if name == "summary.json":
                summary = json.loads(path.read_text())
                for key in ("wall_time_s", "memory_bytes"):
                    del summary[key]
                found[name] = summary
            else:
                found[name] = path.read_bytes()
        return found

    def assert_same(self, folder, other):
        first, second = self.results(folder), self.results(other)
        self.assertEqual(sorted(first), sorted(second))
        for name, content in first.items():
            self.assertTrue(content == second[name], f"{name} differs in {other}")

    def names(self, folder="out"):
        return sorted(path.name for path in (self.folder / folder).iterdir())


__all__ = ["CliTest", "DONE", "FAILED", "BAD_INPUT", "IN_USE", "INTERRUPTED", "ended_by", "PROGRAM", "VARIANTS", "VERSION", "signal", "subprocess", "tiny", "unittest"]
