"""Runs that go unstable: what is said, what is kept, going back, and that the particles add up in every line."""
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

    def results(self, folder):
        """All files but what tells of wall time and memory, and checkpoints."""
        found = {}
        for path in sorted((self.folder / folder).rglob("*")):
            name = str(path.relative_to(self.folder / folder))
            if path.is_dir() or name.startswith("checkpoints/") or "lock" in name:
                continue
            if name == "summary.json":
                summary = json.loads(path.read_text())
                for key in ("wall_time_s", "memory_bytes"):
                    del summary[key]
                found[name] = summary
            else:
                found[name] = path.read_bytes()
        return found

    def assert_same(self, first, second):
        a, b = self.results(first), self.results(second)
        self.assertEqual(sorted(a), sorted(b))
        for name, content in a.items():
            self.assertTrue(content == b[name], f"{name} differs between {first} and {second}")

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

    def test_at_passages_where_the_scene_says_so(self):
        shot = tiny(time={"end": 0.05, "fixed_dt": 0.01}, gravity=[0, 0, 0], stability={"speed": False},
                    bodies=[{"shape": {"type": "box", "size": [0.3, 0.3, 0.3]}, "placement": {"position": [0, 0, 0.5]},
                             "velocity": [0, 0, -100]}])
        _, err = self.run_scene(shot)
        self.assertEqual(err.count("passed through the solid \"floor\""), 1, "it is said once")
        self.assertRegex(err, r"warning: particle \d+ passed through the solid \"floor\" in step \d+ of 0\.01 s "
                              r"\(fixed, above the cfl bound\), to 0\.01 s, and 26 more with it; it is at \(")
        self.assertEqual(self.summary()["lost"], 27)
        self.assertNotIn("fault", self.names())
        shot["stability"]["passages"] = True
        _, err = self.run_scene(shot, code=FAILED)
        self.assertIn("sessile: particle", err)
        self.assertEqual(self.expect_dump()["kind"], "passage")

    def test_when_a_container_leaks_where_the_scene_says_so(self):
        scene = tiny(time={"end": 0.05, "fixed_dt": 0.01}, gravity=[0, 0, 0], stability={"speed": False, "escapes": True},
                     solids=[{"label": "cup", "shape": {"type": "container", "size": [1, 1, 1]}}],
                     bodies=[{"shape": {"type": "box", "size": [0.3, 0.3, 0.3]}, "velocity": [0, 0, -200]}])
        _, err = self.run_scene(scene, code=FAILED)
        self.assertRegex(err, r"particle \d+ left what holds the liquid, \"cup\" in step 1")
        self.assertEqual(self.expect_dump()["kind"], "escape")


class Dumps(Stability):
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


class GoesBack(Stability):
    def test_checkpoints_keep_their_interval(self):
        scene = tiny(time={"end": 0.1, "fixed_dt": 0.001}, stability={"on_fault": "go_back"},
                     output={"frame_interval": 0.05, "checkpoint": {"interval": 0.02}})
        self.run_scene(scene, faults={"CALL": "log", "NOTE": self.folder / "log"})
        calls = [line.split(" ") for line in (self.folder / "log").read_text().splitlines()]
        written = sum(call[0] == "rename" and "/checkpoint_" in call[2] for call in calls)
        self.assertIn(written, range(4, 8))
        # Its last checkpoint is an older state, but the run has come to its end.
        before = self.results("out")
        _, err = self.call("run", "--resume", "out")
        self.assertEqual(err, "out is at 0.1 s, its end; --until lets it go on\n")
        self.assertEqual(self.results("out"), before)

    def test_and_comes_to_the_end(self):
        self.run_scene(thrown(), code=FAILED, folder="fixed")
        _, err = self.run_scene(thrown(stability={"on_fault": "go_back"}), folder="back")
        self.assertRegex(err, r"warning: particle \d+ was thrown .*\. The run goes back to [\d.]+ s and on in steps of at most "
                              r"0\.025 s \(1 of 5\)")
        summary = self.summary("back")
        self.assertEqual(summary["status"], "done")
        told = summary["stability"]
        self.assertGreaterEqual(told["went_back"], 1)
        self.assertGreaterEqual(told["undone_steps"], told["went_back"])
        self.assertIsNone(told["fault"])
        self.assertIn("was thrown", told["last_fault"])
        self.assertEqual(json.loads((self.folder / "back/scene.json").read_text())["time"]["fixed_dt"], 0.05)
        # Nothing tells of the steps that failed: times only grow, frames are where stats say.
        times = [float(row["time [s]"]) for row in self.rows("back")]
        self.assertEqual(times, sorted(set(times)))
        self.assertEqual(len(read_pvd(self.folder / "back/frames.pvd")), summary["frames"])
        self.assertLess(max(float(row["max_speed [m/s]"]) for row in self.rows("back")), 20)

    def test_as_often_as_it_may(self):
        _, err = self.run_scene(crushing(stability={"on_fault": "go_back", "retries": 3, "dt_factor": 0.25}), code=FAILED)
        self.assertEqual(err.count("The run goes back to 0 s"), 3)
        self.assertIn("steps of at most 250 s (1 of 3)", err)
        self.assertIn("steps of at most 15.625 s (3 of 3)", err)
        self.assertIn("The run had gone back 3 times in a row, at last to steps of at most 15.625 s, in vain.", err)
        self.assertEqual(self.summary()["stability"]["went_back"], 3)
        self.expect_dump()

    def test_the_same_for_any_number_of_threads(self):
        scene = self.write(thrown(stability={"on_fault": "go_back"}))
        for threads in (1, 3):
            self.call("run", scene, "-o", f"with{threads}", "--threads", threads, "--progress", "none")
        self.assert_same("with1", "with3")

    def test_the_same_when_it_was_interrupted(self):
        scene = self.write(thrown(stability={"on_fault": "go_back", "keep_interval": 0.06}))
        self.call("run", scene, "-o", "whole", "--progress", "none")
        for until in (0.02, 0.1, 0.16, 0.22, 0.28):
            folder = f"until{until}"
            self.call("run", scene, "-o", folder, "--until", until, "--progress", "none")
            self.call("run", "--resume", folder, "--until", 0.3, "--progress", "none")
            self.assert_same("whole", folder)


class Counts(Stability):
    def test_add_up_in_every_line(self):
        """At every step: what started and was let in is there or has left."""
        jet = {"shape": {"type": "rectangle", "width": 0.3, "depth": 0.3}, "placement": {"position": [0, 0, 1.1]},
               "velocity": [0, 0, -3], "interval": 0.04}
        for edges in ("open", "closed", "periodic"):
            box = {"min": [-0.45, -0.45, -0.3], "max": [0.45, 0.45, 1.2], "x": edges, "y": edges, "z": "open"}
            scene = tiny(time={"end": 0.5}, domain=box, emitters=[jet],
                         output={"frame_interval": 0.1, "stats_interval": 0, "formats": ["vtp"]},
                         solids=[{"label": "floor", "shape": {"type": "plate", "width": 0.5, "depth": 0.5}}])
            self.run_scene(scene)
            rows = self.rows()
            start = int(rows[0]["particles"]) - int(rows[0]["emitted"])
            self.assertEqual(start, 27)
            for row in rows:
                self.assertEqual(start + int(row["emitted"]) - int(row["out"]), int(row["particles"]), row["step"])
            self.assertGreater(int(rows[-1]["emitted"]), 50)
            self.assertGreater(int(rows[-1]["out"]), 0, edges)
            last = {}
            read_vtp(self.folder / "out" / read_pvd(self.folder / "out/frames.pvd")[-1][1], last)
            self.assertEqual(len(last["id"]), int(rows[-1]["particles"]))
            self.assertEqual(len(set(last["id"])), len(last["id"]), "each particle is there once")


if __name__ == "__main__":
    unittest.main()
