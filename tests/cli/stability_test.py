"""Runs that go unstable: what is said, and what is kept."""
import csv
import json
import math

import png
from frames import read_pvd, read_vtp
from sessile_cli import FAILED, IN_USE, CliTest, tiny, unittest


def crushing(**changes):
    """Forces beyond all numbers: no step is short enough."""
    return tiny(gravity=[0, 0, -3e38], time={"end": 1e4, "fixed_dt": 1e3}, **changes)


def thrown(**changes):
    """A cube that meets a plate in steps far too long for it: pressure throws particles off."""
    stability = changes.pop("stability", {})
    return tiny(time={"end": 0.3, "fixed_dt": 0.05}, gravity=[0, 0, -9.81], stability=stability,
                bodies=[{"label": "block", "shape": {"type": "box", "size": [0.5, 0.5, 0.5]},
                         "placement": {"position": [0, 0, 0.5]}, "velocity": [0, 0, -4]}],
                solids=[{"label": "floor", "shape": {"type": "plate", "width": 2, "depth": 2}}],
                fluid={"viscosity": 1},
                output={"frame_interval": 0.05, "stats_interval": 0.05, "formats": ["vtp"]}, **changes)


class Stability(CliTest):
    def run_scene(self, scene, *arguments, folder="out", **how):
        return self.call("run", self.write(scene), "-o", folder, "--progress", "plain", *arguments, **how)

    def rows(self, folder="out"):
        with open(self.folder / folder / "stats.csv", newline="") as file:
            return list(csv.DictReader(file))

    def expect_dump(self, folder="out/fault"):
        """A folder of results with two frames, which the program opens. Returns fault.json."""
        self.assertEqual(self.names(folder), ["checkpoints", "fault.json", "frame_000000.vtp", "frame_000001.vtp",
                                              "frames.pvd", "scene.json", "solids.vtp", "stats.csv"])
        for when, name in read_pvd(self.folder / folder / "frames.pvd"):
            self.assertEqual(read_vtp(self.folder / folder / name)[2], when)
        fault = json.loads((self.folder / folder / "fault.json").read_text())
        for frame in (0, 1):
            self.call("picture", folder, "--frame", frame, "-o", "a.png", "--size", "120x80", "--fineness", 1,
                      "--progress", "none")
            self.assertEqual(png.image(self.folder / "a.png")[:2], (120, 80))
        checkpoints = self.names(folder + "/checkpoints")
        self.assertEqual(len(checkpoints), 1)
        self.call("check", f"{folder}/checkpoints/{checkpoints[0]}")
        return fault


class Stops(Stability):
    def test_when_numbers_are_not_finite(self):
        _, err = self.run_scene(crushing(), code=FAILED)
        self.assertRegex(err, r"sessile: 27 of 27 particles have no finite position, velocity or pressure after step 1 of "
                              r"1000 s \(fixed, above the force bound\), to 1000 s; the first, particle \d+, stood at "
                              r"\([^)]+\) m\. A smaller time\.fixed_dt .* stability\.on_fault = \"go_back\" .*\n"
                              r"out/fault holds the last good state, of 0 s, and the faulty one")
        fault = self.expect_dump()
        self.assertEqual((fault["kind"], fault["step"], fault["particles"], fault["bound"]), ("not_finite", 1, 27, "fixed"))
        summary = self.summary()
        self.assertEqual((summary["status"], summary["stability"]["fault"]["kind"]), ("failed", "not_finite"))
        self.assertEqual(summary["particles"], 27, "none of them is taken out")
        # The next run into the folder takes the dump away, and nothing else.
        (self.folder / "out/fault/mine.txt").write_text("mine")
        self.run_scene(tiny())
        self.assertEqual(self.names("out/fault"), ["mine.txt"])
        self.assertIsNone(self.summary()["stability"]["fault"])

    def test_when_a_particle_is_thrown(self):
        _, err = self.run_scene(thrown(), code=FAILED)
        self.assertRegex(err, r"sessile: particle \d+ was thrown [\d.]+ m off its way, [\d.]+ support radii, in step \d+ of "
                              r"0\.05 s \(fixed, above the \w+ bound\), to [\d.]+ s; it is at \([^)]+\) m with \([^)]+\) m/s")
        fault = self.expect_dump()
        self.assertEqual(fault["kind"], "speed")
        # The faulty frame shows the particle where the message says.
        frame = {}
        read_vtp(self.folder / "out/fault/frame_000001.vtp", frame)
        shown = frame[""][frame["id"].index(fault["particle"])]
        for here, told in zip(shown, fault["position_m"]):
            self.assertTrue(math.isclose(here, told, rel_tol=1e-5, abs_tol=1e-6), (shown, fault["position_m"]))
        # A run goes on from the dump with another step.
        self.call("run", "--resume", "out/fault", "--set", "time.fixed_dt=0.002", "--progress", "none")
        self.assertEqual(self.summary("out/fault")["status"], "done")

    def test_when_the_liquid_collapses(self):
        # It attracts itself, and the solver hardly holds against it.
        scene = tiny(time={"end": 1, "fixed_dt": 0.002}, gravity=[0, 0, 0], solids=[], fluid={"viscosity": 200},
                     forces=[{"type": "becker2007", "tension": 10}], pressure={"type": "wcsph", "sound_speed": 0.1},
                     bodies=[{"shape": {"type": "box", "size": [0.6, 0.6, 0.6]}}], stability={"collapse_limit": 3})
        _, err = self.run_scene(scene, code=FAILED)
        self.assertRegex(err, r"sessile: the liquid has collapsed: particle \d+ has [\d.]+ times the rest density after step \d+ "
                              r"of 0\.002 s \(fixed[^)]*\), to [\d.]+ s(, and \d+ more with it)?; it is at .* or "
                              r"with wcsph a greater pressure\.sound_speed")
        self.assertEqual(self.expect_dump()["kind"], "collapse")

    def test_not_where_wcsph_compresses_the_liquid_but_says_so(self):
        scene = tiny(time={"end": 0.6, "fixed_dt": 0.005}, forces=[], pressure={"type": "wcsph", "sound_speed": 5},
                     stability={"escapes": False},
                     bodies=[{"shape": {"type": "box", "size": [0.8, 0.8, 0.8]}, "placement": {"position": [0, 0, 0.5]}}],
                     solids=[{"shape": {"type": "container", "size": [0.9, 0.9, 2]}, "placement": {"position": [0, 0, 1]}}])
        _, err = self.run_scene(scene)
        self.assertRegex(err, r"(?m)^warning: at [\d.]+ s the liquid is compressed by [\d.]+ % on average: a greater "
                              r"pressure\.sound_speed compresses it less$")
        scene["pressure"]["sound_speed"] = 50
        scene["time"] = {"end": 0.1, "fixed_dt": 0.0005}
        self.assertNotIn("compressed", self.run_scene(scene)[1])

    def test_when_the_liquid_stays_compressed(self):
        # A periodic block has nowhere to go: no pressure takes the 5 % that its masses are too great.
        box = {"min": [-0.4, -0.4, -0.4], "max": [0.4, 0.4, 0.4], "x": "periodic", "y": "periodic", "z": "periodic"}
        for iteration in ("jacobi", "conjugate"):
            with self.subTest(iteration):
                scene = tiny(time={"end": 1, "fixed_dt": 0.001}, gravity=[0, 0, 0], domain=box, solids=[], forces=[],
                             bodies=[{"shape": {"type": "box", "size": [0.8, 0.8, 0.8]}, "mass_factor": 1.05}],
                             pressure={"type": "iisph", "iteration": iteration, "max_iterations": 5},
                             stability={"density_steps": 40})
                _, err = self.run_scene(scene, code=FAILED)
                self.assertRegex(err, r"sessile: the liquid stays compressed, by [\d.]+ % on average, and 40 pressure solves in a "
                                      r"row ended above their error without getting better, up to step \d+ .*; most of all "
                                      r"particle \d+, by [\d.]+ %, at .* or more pressure\.max_iterations")
                self.assertEqual(self.expect_dump()["kind"], "density")

    def test_where_the_liquid_is_compressed_whatever_the_solver_says(self):
        # Its error lets a compression pass that no run should go on with.
        box = {"min": [-0.4, -0.4, -0.4], "max": [0.4, 0.4, 0.4], "x": "periodic", "y": "periodic", "z": "periodic"}
        scene = tiny(time={"end": 1, "fixed_dt": 0.001}, gravity=[0, 0, 0], domain=box, solids=[], forces=[],
                     bodies=[{"shape": {"type": "box", "size": [0.8, 0.8, 0.8]}, "mass_factor": 1.2}],
                     pressure={"type": "dfsph", "error": 0.5}, stability={"density_steps": 20})
        _, err = self.run_scene(scene, code=FAILED)
        self.assertRegex(err, r"sessile: the liquid stays compressed, by [\d.]+ % on average, and 20 pressure solves that say they "
                              r"reached their error went by without getting better, up to step 20 ")
        self.assertEqual(self.expect_dump()["kind"], "density")

    def test_where_dt_min_lets_a_particle_fly_too_far(self):
        scene = tiny(time={"end": 1e-2, "dt_min": 1e-3, "dt_max": 1e-2}, gravity=[0, 0, 0], solids=[],
                     bodies=[{"shape": {"type": "box", "size": [0.3, 0.3, 0.3]}, "velocity": [1e15, 0, 0]}])
        _, err = self.run_scene(scene, code=FAILED)
        self.assertRegex(err, r"sessile: particle \d+ went 1e\+12 m, [\d.e+]+ support radii, in step 1 of 0\.001 s \(dt_min, above "
                              r"the cfl bound\), to 0\.001 s; it is at \(.*\. A smaller time\.dt_min may carry it over this")
        self.assertIn("`sessile run --resume out/fault --set time.dt_min=0.0005` goes on from the good one\n", err)

    def test_at_passages_unless_the_scene_says_otherwise(self):
        shot = tiny(time={"end": 0.05, "fixed_dt": 0.01}, gravity=[0, 0, 0], stability={"speed": False, "passages": False},
                    bodies=[{"shape": {"type": "box", "size": [0.3, 0.3, 0.3]}, "placement": {"position": [0, 0, 0.5]},
                             "velocity": [0, 0, -100]}])
        _, err = self.run_scene(shot)
        self.assertEqual(err.count("passed through the solid \"floor\""), 1, "it is said once")
        self.assertRegex(err, r"warning: particle \d+ passed through the solid \"floor\" in step \d+ of 0\.01 s "
                              r"\(fixed, above the cfl bound\), to 0\.01 s, and 26 more with it; it is at \(")
        self.assertEqual(self.summary()["lost"], 27)
        self.assertNotIn("fault", self.names())
        del shot["stability"]["passages"]
        _, err = self.run_scene(shot, code=FAILED)
        self.assertIn("sessile: particle", err)
        self.assertIn("; with `--set stability.passages=false` it is a warning and a count; ", err)
        self.assertIn("`sessile run --resume out/fault --set stability.passages=false` goes on from the good one\n", err)
        self.assertEqual(self.expect_dump()["kind"], "passage")
        self.call("run", "--resume", "out/fault", "--set", "stability.passages=false", "--progress", "none")
        self.assertEqual(self.summary("out/fault")["lost"], 27)

    def test_when_a_container_leaks(self):
        scene = tiny(time={"end": 0.05, "fixed_dt": 0.01}, gravity=[0, 0, 0], stability={"speed": False},
                     solids=[{"label": "cup", "shape": {"type": "container", "size": [1, 1, 1]}}],
                     bodies=[{"shape": {"type": "box", "size": [0.3, 0.3, 0.3]}, "velocity": [0, 0, -200]}])
        _, err = self.run_scene(scene, code=FAILED)
        self.assertRegex(err, r"particle \d+ left what holds the liquid, \"cup\" in step 1")
        self.assertIn("`sessile run --resume out/fault --set stability.escapes=false` goes on from the good one\n", err)
        self.assertEqual(self.expect_dump()["kind"], "escape")


class Dumps(Stability):
    def test_that_cannot_be_written_leave_nothing(self):
        for path in ("fault/.scene.json", "fault/.fault.json", "fault/.frame_000001", "fault/stats.csv", "checkpoint_"):
            with self.subTest(path):
                scene = thrown()
                scene["output"]["checkpoint"] = {"keep": 0}
                _, err = self.run_scene(scene, code=FAILED, faults={"CALL": "write", "PATH": path, "ERROR": 28})
                self.assertRegex(err, r"\nThe state of the fault could not be kept: cannot write out/fault/\S+: No space left on device; "
                                      r"make room on that disk; what had been written is whole\n")
                self.assertNotIn("fault", self.names())

    def test_do_not_go_over_results_that_bear_their_name(self):
        self.run_scene(tiny(), folder="out/fault")
        before = self.results("out/fault")
        _, err = self.run_scene(thrown(), code=FAILED)
        self.assertIn("The state of the fault could not be kept: out/fault holds results of another run, which are left alone\n", err)
        self.assertEqual(self.results("out/fault"), before)

    def test_leave_results_alone_that_bear_their_name(self):
        self.run_scene(tiny(), folder="out/fault")
        before = self.results("out/fault")
        self.run_scene(tiny())
        self.assertEqual(self.results("out/fault"), before)

    def test_are_results_once_a_run_has_gone_on_from_them(self):
        self.run_scene(thrown(), code=FAILED)
        self.call("run", "--resume", "out/fault", "--set", "time.fixed_dt=0.002", "--progress", "none")
        self.assertNotIn("fault.json", self.names("out/fault"))
        before = self.results("out/fault")
        self.run_scene(tiny())
        self.assertEqual(self.results("out/fault"), before)

    def test_are_not_taken_from_a_run_that_goes_on_from_them(self):
        self.run_scene(thrown(), code=FAILED)
        first = self.start("run", "--resume", "out/fault", "--set", "time.fixed_dt=0.002", "--until", "1e4", "--progress", "none")
        self.wait_for("out/fault/frame_000002.vtp", process=first)
        before = self.names()
        _, err = self.run_scene(tiny(), code=IN_USE)
        self.assertIn("out/fault: process", err)
        self.assertEqual(self.names(), before)
        self.assertIsNone(first.poll())

    def test_do_not_go_into_a_folder_that_took_the_place_of_the_runs(self):
        # The run waits in its first line of stats.csv, and its first step goes wrong.
        process = self.start("run", self.write(crushing()), "-o", "out", "--progress", "none",
                             faults={"CALL": "write", "PATH": "stats.csv", "AFTER": 1, "COUNT": 1, "HOLD": self.folder / "held"})
        self.wait_for("held", "out/frame_000000.vtp", "out/frame_000000.ply", "out/frames.pvd", process=process)
        (self.folder / "out").rename(self.folder / "moved")
        (self.folder / "out/fault").mkdir(parents=True)
        for name in ("fault.json", "stats.csv"):
            (self.folder / "out/fault" / name).write_text("mine")
        (self.folder / "held").unlink()
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, FAILED)
        self.assertRegex(err, r"27 of 27 particles have no finite position.*\. Besides, the folder out has been renamed while it was "
                              r"written into; what is there is whole: .*/moved;")
        for name in ("fault.json", "stats.csv"):
            self.assertEqual((self.folder / "out/fault" / name).read_text(), "mine")


if __name__ == "__main__":
    unittest.main()
