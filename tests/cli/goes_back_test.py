"""Runs that go back to a good state where a step goes wrong, and that particles add up in every line."""
import json
import time

from frames import read_pvd, read_vtp
from sessile_cli import FAILED, tiny, unittest
from stability_test import Stability, crushing, thrown


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
        self.assertRegex(told["last_fault"], "was thrown|passed through")
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

    def test_not_for_ever(self):
        """A jet that hits a plate in steps too long for it, as long as it runs: it goes back time and again."""
        jet = {"shape": {"type": "rectangle", "width": 0.4, "depth": 0.4}, "placement": {"position": [0, 0, 0.6]},
               "velocity": [0, 0, -4], "interval": 0.15}
        scene = thrown(stability={"on_fault": "go_back", "hold": 1e-6, "keep_interval": 0.5}, emitters=[jet])
        scene["time"]["end"] = 1.5
        scene["bodies"] = []
        self.run_scene(scene)
        summary = self.summary()
        told = summary["stability"]
        self.assertGreater(told["went_back"], 2)
        self.assertLess(told["undone_steps"], summary["steps"], told)  # were hold all, some six times as many

    def test_the_same_for_any_number_of_threads(self):
        scene = self.write(thrown(stability={"on_fault": "go_back"}))
        for threads in (1, 3):
            self.call("run", scene, "-o", f"with{threads}", "--threads", threads, "--progress", "none")
        self.assert_same("with1", "with3")

    def test_the_same_when_it_had_ended_earlier(self):
        scene = self.write(thrown(stability={"on_fault": "go_back", "keep_interval": 0.06}))
        self.call("run", scene, "-o", "whole", "--progress", "none")
        for until in (0.02, 0.1, 0.16, 0.22, 0.28):
            folder = f"until{until}"
            self.call("run", scene, "-o", folder, "--until", until, "--progress", "none")
            self.call("run", "--resume", folder, "--until", 0.3, "--progress", "none")
            self.assert_same("whole", folder)

    def test_the_same_when_it_was_killed(self):
        """Each time it is killed while a checkpoint gets its name, one later than before."""
        scene = thrown(stability={"on_fault": "go_back", "keep_interval": 0.06})
        scene["output"]["checkpoint"] = {"interval": 0.02}
        self.write(scene)
        self.call("run", "s.json", "-o", "whole", "--progress", "none")
        went_on = 0
        for after in range(1, 7):
            held = self.folder / "held"
            held.unlink(missing_ok=True)
            run = self.start("run", *(["--resume", "out"] if went_on else ["s.json", "-o", "out"]), "--progress", "none",
                             faults={"CALL": "rename", "PATH": "checkpoint_", "AFTER": after, "HOLD": held})
            while run.poll() is None and not held.exists():
                time.sleep(0.002)
            if run.poll() is not None:
                break  # it has come to its end
            run.kill()
            run.wait()
            went_on += 1
        self.assertGreaterEqual(went_on, 3)
        self.call("run", "--resume", "out", "--progress", "none")
        self.assert_same("whole", "out")


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
