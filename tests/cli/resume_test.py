"""`sessile run --resume`: a run that is interrupted or goes on later leaves the files of one that never stopped."""
import fcntl
import json
import re
import shutil
import time

from frames import read_pvd
from resume_cli import ResumeTest, lively
from sessile_cli import BAD_INPUT, FAILED, IN_USE, signal, unittest


class Interrupted(ResumeTest):
    def test_goes_on_at_any_number_of_threads(self):
        self.run_scene(lively(), "whole")
        run = self.start("run", self.write(lively(), "out.json"), "-o", "out", "--progress", "none", "--threads", "2")
        while not list((self.folder / "out").glob("frame_00000[3-9].vtp")):
            self.assertIsNone(run.poll(), "the run ended too early to be interrupted")
            time.sleep(0.002)
        run.send_signal(signal.SIGTERM)
        self.assertEqual(run.wait(60), 128 + signal.SIGTERM)
        self.assertIn("it goes on with: sessile run --resume out", run.stderr.read())
        self.assertEqual(self.summary()["status"], "interrupted")
        self.resume("out", "--threads", "3")
        self.assert_same("whole", "out")

    def test_a_run_that_was_done_goes_on_to_a_later_end(self):
        for end in ("0.08", "0.13"):  # one of them on a frame, one between two
            self.run_scene(lively(), "out", "--until", end)
            out, err = self.resume("out")
            self.assertIn("its end; --until lets it go on", err)
            self.run_scene(lively(), "whole")
            self.resume("out", "--until", "0.2")
            self.assert_same("whole", "out")

    def test_goes_back_to_an_earlier_checkpoint(self):
        scene = lively(output={"checkpoint": {"interval": 0.03, "keep": 100}})
        self.run_scene(scene, "whole")
        self.run_scene(scene, "out")
        kept = self.checkpoints("out")
        self.assertGreater(len(kept), 5)
        self.resume("out", "--at", "0.12")
        self.assert_same("whole", "out")
        self.assertEqual(self.checkpoints("out"), kept)
        out, err = self.resume("out", "--at", "0.001", code=FAILED)
        self.assertRegex(err, r"out: there is no checkpoint to go on from at 0.001 s; the earliest is of 0\.03\d* s")
        self.assert_same("whole", "out")

    def test_at_the_time_of_a_checkpoint(self):
        """Times are sums of steps: 0.12 is 0.12000000000000004."""
        scene = lively(time={"end": 0.2, "fixed_dt": 0.005}, output={"checkpoint": {"interval": 0.03, "keep": 100}})
        self.run_scene(scene, "out")
        for name in self.checkpoints("out")[::-1]:
            said = re.search(r"simulated time  (\S+) of", self.call("check", f"out/checkpoints/{name}")[0])[1]
            self.resume("out", "--at", said, "--until", said)  # so that nothing but its files stay
            self.assertEqual(self.checkpoints("out")[-1], name)
            self.assert_whole("out")

    def test_an_end_before_where_it_is(self):
        self.run_scene(lively(), "out")
        before = self.results("out")
        _, err = self.resume("out", "--until", "0.05", code=BAD_INPUT)
        self.assertRegex(err, r"time.end: the run is at 0\.2\d* s already, beyond 0\.05 s; --at goes on from an earlier")
        self.assertEqual(self.results("out"), before)

    def test_an_end_that_rounding_comes_short_of(self):
        self.run_scene(lively(time={"end": 0.06, "fixed_dt": 0.005}), "out")
        self.assertLess(self.summary()["simulated_time_s"], 0.06)
        before = self.results("out")
        self.assertIn("its end; --until lets it go on", self.resume("out")[1])
        self.assertEqual(self.results("out"), before)

    def test_keeps_the_newest_only(self):
        self.run_scene(lively(), "out")
        self.assertEqual(len(self.checkpoints("out")), 3)
        self.run_scene(lively(output={"checkpoint": {"keep": 0}}), "out")
        self.assertFalse((self.folder / "out/checkpoints").exists())


class Changes(ResumeTest):
    def setUp(self):
        super().setUp()
        self.run_scene(lively(), "out", "--until", "0.1")

    def test_what_may_change(self):
        self.resume("out", "--set", "output.frame_interval=0.05", "--until", "0.2")
        times = [row.split('"')[1] for row in re.findall(r"timestep=\S+", (self.folder / "out/frames.pvd").read_text())]
        self.assertEqual(len(times), 11 + 2)
        self.assertEqual(json.loads((self.folder / "out/scene.json").read_text())["output"]["frame_interval"], 0.05)

    def test_what_may_not(self):
        before = self.results("out")
        for setting, message in {
            "spacing=0.05": "spacing: cannot change while the simulation runs, only from its start",
            "output.formats=[\"ply\"]": "output.formats: cannot change when a run is resumed, as its folder would hold files of two kinds",
            "output.fields=[\"id\"]": "output.fields: cannot change when a run is resumed, as its folder would hold files of two kinds",
            "output.surface.cube_size=1": "output.surface.cube_size: cannot change when a run is resumed",
            "time.fixed_dt=-1": "time.fixed_dt: must be above 0 s, found -1",
        }.items():
            _, err = self.call("run", "--resume", "out", "--until", "0.2", "--set", setting, code=BAD_INPUT)
            self.assertIn(message, err)
        self.assertEqual(self.results("out"), before, "a refused call changed something")

    def test_surfaces_end_where_others_have_taken_their_place(self):
        """`sessile mesh` makes its own surfaces of the frames: those of the run are gone, and it says so."""
        for change in (lambda: self.call("mesh", "out", "--set", "cube_size=1"), lambda: self.call("mesh", "out"),
                       lambda: shutil.rmtree(self.folder / "out/surface")):
            change()
            before, names = self.results("out"), self.checkpoints("out")
            _, err = self.resume("out", "--until", "0.2", code=FAILED)
            self.assertIn("out/surface: the 6 surfaces that the run had made are not there any more, or others are", err)
            self.assertNotIn("then go on with", err)
            self.assertEqual((self.results("out"), self.checkpoints("out")), (before, names), "a refused call changed something")
        self.resume("out", "--until", "0.2", "--set", "output.surface.formats=[]")
        self.assertEqual(self.summary()["frames"], 21)

    def test_nothing_is_touched_where_files_are_missing(self):
        (self.folder / "out/surface/.sessile.lock").touch()
        with open(self.folder / "out/surface/.sessile.lock") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            before, names = self.results("out"), self.checkpoints("out")
            self.resume("out", "--at", "0.098", "--until", "0.2", code=IN_USE)
            self.assertEqual((self.results("out"), self.checkpoints("out")), (before, names))
        (self.folder / "out/stats.csv").unlink()
        before = self.results("out")
        _, err = self.resume("out", "--at", "0.098", "--until", "0.2", code=FAILED)
        self.assertEqual(err, "sessile: cannot go on with out/stats.csv: No such file or directory\n")
        self.assertEqual((self.results("out"), self.checkpoints("out")), (before, names))

    def test_usage(self):
        for words, message in {
            (): "a SCENE, or --resume DIR, is required",
            ("out.json", "--resume", "out"): "excludes",
            ("--resume", "out", "-o", "other"): "excludes",
            ("out.json", "--at", "1"): "requires --resume",
        }.items():
            _, err = self.call("run", *words, code=BAD_INPUT)
            self.assertIn(message, err)
        _, err = self.call("run", "--resume", "nowhere", code=FAILED)
        self.assertEqual(err, "sessile: nowhere: there is no checkpoint to go on from\n")

    def test_a_shorter_stats_file_is_refused(self):
        stats = self.folder / "out/stats.csv"
        stats.write_bytes(stats.read_bytes()[:100])
        _, err = self.call("run", "--resume", "out", "--until", "0.2", code=FAILED)
        self.assertIn("cannot go on with out/stats.csv: it is shorter than it was", err)


    def test_check_describes_a_checkpoint(self):
        name = "out/checkpoints/" + self.checkpoints("out")[-1]
        out, _ = self.call("check", name)
        self.assertRegex(out, rf"\A{name}: a whole checkpoint, of format 1\n  scene           a jet\n")
        self.assertRegex(out, r"  simulated time  0\.10\d* of 0\.1 s, after \d+ steps; the last one \S+ s \(\w+\)\n")
        self.assertRegex(out, r"  particles       \d+; \d+ let in, 0 out, 0 lost\n  results         11 frames, 6 surfaces, ")
        scene = json.loads(self.call("check", name, "--json")[0])
        self.assertEqual(scene["title"], "a jet")
        (self.folder / name).write_bytes((self.folder / name).read_bytes()[:1000])
        _, err = self.call("check", name, code=FAILED)
        self.assertIn("damaged or cut short", err)


class Meshes(ResumeTest):
    CUBE = "".join(f"v {x} {y} {z}\n" for x in (0, 0.3) for y in (0, 0.3) for z in (0, 0.3)) + \
        "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"

    def test_where_they_are_not_any_more(self):
        """Of the liquid they are not needed; those of solids may have moved, and must be the same."""
        for name in ("body.obj", "solid.obj", "other.obj"):
            self.write(self.CUBE.replace("0.3", "0.4") if name == "other.obj" else self.CUBE, name)
        scene = lively(bodies=[{"shape": {"type": "mesh", "file": "body.obj"}, "placement": {"position": [0, 0, 0.5]}}],
                       solids=[{"shape": {"type": "mesh", "file": "solid.obj"}, "placement": {"position": [0, 0, 0.05]}}])
        self.run_scene(scene, "whole")
        self.run_scene(scene, "out", "--until", "0.1")
        (self.folder / "body.obj").unlink()
        (self.folder / "solid.obj").rename(self.folder / "moved.obj")
        checkpoint = "out/checkpoints/" + self.checkpoints("out")[-1]
        self.assertIn("a whole checkpoint", self.call("check", checkpoint)[0])
        _, err = self.resume("out", "--until", "0.2", code=FAILED)
        self.assertIn("solid.obj: cannot be read", err)
        place = "solids[0].shape.file=" + str(self.folder)
        _, err = self.resume("out", "--until", "0.2", "--set", place + "/other.obj", code=BAD_INPUT)
        self.assertIn("the solids are not those of the state", err)
        self.resume("out", "--until", "0.2", "--set", place + "/moved.obj")
        first, second = self.results("whole"), self.results("out")
        for result in (first, second):
            del result["scene.json"], result["summary.json"]
        self.assertEqual(first, second)


if __name__ == "__main__":
    unittest.main()
