"""`sessile run --resume` after SIGKILL, at any moment: nothing is lost, no file is torn."""
import random
import shutil
import time

from resume_cli import ResumeTest, lively
from sessile_cli import DONE, FAILED, unittest

# Where a kill falls: at any moment, or surely into a write that the library of faults holds back until then.
MOMENTS = (None,
           {"CALL": "fsync", "PATH": ".frame_"},
           {"CALL": "rename", "PATH": "checkpoint_"},
           {"CALL": "fsync", "PATH": ".checkpoint_"},
           {"CALL": "rename", "PATH": "surface_0"},
           {"CALL": "write", "PATH": ".checkpoint_"},
           {"CALL": "rename", "PATH": "frames.pvd"},
           {"CALL": "write", "PATH": "stats.csv"})


class Killed(ResumeTest):
    def begin(self, folder, faults):
        """Starts the run, or goes on with it, as a user would; returns the process, and whether it went on."""
        if self.checkpoints(folder):
            return self.start_resume(folder, faults=faults), True
        return self.start("run", self.write(lively(), "killed.json"), "-o", folder, "--progress", "none", faults=faults), False

    def test_twenty_kills_leave_no_trace(self):
        start = time.monotonic()
        self.run_scene(lively(), "whole")
        lasts = time.monotonic() - start
        chance = random.Random(6)
        halves = {"frame": 0, "checkpoint": 0}  # kills that left a half of one
        kills = resumes = finished = 0
        while kills < 20:
            faults = MOMENTS[kills % len(MOMENTS)]
            held = self.folder / "held"
            held.unlink(missing_ok=True)
            if faults:
                faults = dict(faults, HOLD=held, AFTER=chance.randrange(12))
            run, went_on = self.begin("killed", faults)
            until = time.monotonic() + (60 if faults else chance.uniform(0.02, 0.6 * lasts + 0.05))
            while run.poll() is None and not held.exists() and time.monotonic() < until:
                time.sleep(0.002)
            if run.poll() is not None:  # it came to its end before: that counts as well
                self.assertEqual(run.returncode, DONE, run.stderr.read())
                self.assert_same("whole", "killed")
                shutil.rmtree(self.folder / "killed")
                finished += 1
                continue
            run.kill()
            run.wait()
            kills += 1
            resumes += went_on
            self.assert_whole("killed")
            for kind in halves:
                halves[kind] += any((self.folder / "killed").rglob(f".{kind}_*.part"))
        self.assertGreater(resumes, 5, "hardly any run was killed after it had been resumed")
        self.assertGreaterEqual(halves["frame"], 1, "no kill fell into a frame")
        self.assertGreaterEqual(halves["checkpoint"], 3, "hardly any kill fell into a checkpoint")
        self.assertLess(finished, 10)
        self.begin("killed", None)[0].communicate(timeout=60)
        self.assert_same("whole", "killed")

    def test_a_torn_checkpoint_is_passed_over(self):
        self.run_scene(lively(), "whole")
        self.run_scene(lively(), "out", "--until", "0.1")
        newest = self.folder / "out/checkpoints" / self.checkpoints("out")[-1]
        newest.write_bytes(newest.read_bytes()[:-7])
        _, err = self.call("run", "--resume", "out", "--until", "0.2", "--progress", "plain")
        self.assertIn("damaged or cut short: its checksum does not match", err)
        self.assert_same("whole", "out")

    def test_one_that_a_newer_program_wrote_is_not_written_over(self):
        self.run_scene(lively(), "out", "--until", "0.1")
        newest = self.folder / "out/checkpoints" / self.checkpoints("out")[-1]
        content = newest.read_bytes()
        newest.write_bytes(content[:8] + (2).to_bytes(4, "little") + content[12:])
        before, names = self.results("out"), self.checkpoints("out")
        _, err = self.resume("out", "--until", "0.2", code=FAILED)
        self.assertIn("this checkpoint is of format 2, and this program reads up to format 1: a newer Sessile", err)
        self.assertNotIn("then go on with", err)
        self.assertEqual((self.results("out"), self.checkpoints("out")), (before, names))
        self.resume("out", "--at", "0.098", "--until", "0.2")  # who asks for an earlier one gets it

    def test_after_an_earlier_end(self):
        """The files that the earlier end completed stand beside those of the run that goes on."""
        self.run_scene(lively(), "whole")
        self.run_scene(lively(), "out", "--until", "0.1")
        for kill in ("out/frame_000013.vtp", "out/frame_000017.vtp"):
            self.kill(self.start_resume("out", "--until", "0.2"), kill)
            self.assert_whole("out")
        self.resume("out", "--until", "0.2")
        self.assert_same("whole", "out")

    def test_after_going_on_with_another_past(self):
        """Surfaces of the undone steps stay out of the file that holds them all."""
        scene = lively(output={"checkpoint": {"interval": 0.004, "keep": 100}})
        other = ("--at", "0.1", "--set", "gravity=[0,0,9]")
        for folder in ("whole", "out"):
            self.run_scene(scene, folder)
        self.resume("whole", *other)
        held = self.folder / "held"
        run = self.start_resume("out", *other, faults={"CALL": "fsync", "PATH": ".frame_000017", "HOLD": held})
        self.kill(run, "held")
        self.resume("out")
        self.assert_same("whole", "out")

    def test_before_the_first_frame_after_undone_ones(self):
        """The collection does not list frames that are gone."""
        scene = lively(output={"checkpoint": {"interval": 0.03, "keep": 100}})
        for folder in ("whole", "out"):
            self.run_scene(scene, folder)
        run = self.start_resume("out", "--at", "0.07", faults={"CALL": "fsync", "PATH": ".frame_", "HOLD": self.folder / "held"})
        self.kill(run, "held")
        self.assert_whole("out")
        self.resume("out")
        self.assert_same("whole", "out")

    def test_what_was_changed_stays_changed(self):
        """Also before the next checkpoint, which by default comes after ten minutes."""
        scene = lively(output={"checkpoint": {}})
        changes = ("--until", "0.3", "--set", "gravity=[0,0,5]")
        for folder in ("whole", "out"):
            self.run_scene(scene, folder)
        self.resume("whole", *changes)
        held = self.folder / "held"
        run = self.start_resume("out", *changes, faults={"CALL": "fsync", "PATH": ".frame_000025", "HOLD": held})
        self.kill(run, "held")
        self.resume("out")
        self.assert_same("whole", "out")

    def test_leaves_nothing_to_another_scene(self):
        """A new run in the folder of a killed one finds nothing of it."""
        other = lively(gravity=[0, 0, -3])
        self.run_scene(other, "whole")
        self.run_scene(lively(), "out", "--until", "0.1")
        self.kill(self.start_resume("out", "--until", "0.2"), "out/frame_000015.vtp")
        faults = {"CALL": "fsync", "PATH": ".frame_000012", "HOLD": self.folder / "held"}
        self.kill(self.start("run", self.write(other), "-o", "out", "--progress", "none", faults=faults), "held")
        self.resume("out")
        self.assert_same("whole", "out")


if __name__ == "__main__":
    unittest.main()
