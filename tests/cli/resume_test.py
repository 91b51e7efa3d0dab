"""`sessile run --resume`: a run that is killed, interrupted or goes on later leaves the files of one that never stopped."""
import json
import random
import re
import shutil
import time

from sessile_cli import BAD_INPUT, DONE, FAILED, CliTest, signal, tiny, unittest


def lively(**changes):
    """A scene that uses all that a checkpoint holds: a jet on a plate, an open domain, surfaces, a changing step."""
    output = {"frame_interval": 0.01, "stats_interval": 0.005, "formats": ["vtp", "ply"],
              "surface": {"formats": ["ply", "usda"], "interval": 0.02, "stats": True},
              "checkpoint": {"interval": 0.004, "keep": 3}}
    output.update(changes.pop("output", {}))
    return tiny(title="a jet", time={"end": 0.2},
                domain={"min": [-0.45, -0.45, -0.5], "max": [0.45, 0.45, 1.2], "x": "open", "y": "open", "z": "open"},
                emitters=[{"shape": {"type": "rectangle", "width": 0.3, "depth": 0.3},
                           "placement": {"position": [0, 0, 1.1]}, "velocity": [0, 0, -3], "interval": 0.04}],
                output=output, **changes)


class ResumeTest(CliTest):
    def run_scene(self, scene, folder, *arguments, **how):
        return self.call("run", self.write(scene, folder + ".json"), "-o", folder, "--progress", "none", *arguments, **how)

    def resume(self, folder, *arguments, **how):
        return self.call("run", "--resume", folder, "--progress", "none", *arguments, **how)

    def results(self, folder):
        """What a run leaves behind, by name: bytes, but for times of the wall and memory. Checkpoints by their names."""
        found = {}
        for path in sorted((self.folder / folder).rglob("*")):
            name = str(path.relative_to(self.folder / folder))
            if path.is_dir() or name.startswith("checkpoints/") or name == ".sessile.lock":
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

    def checkpoints(self, folder):
        return sorted(path.name for path in (self.folder / folder / "checkpoints").glob("checkpoint_*.sessile"))


class Killed(ResumeTest):
    def test_twenty_kills_leave_no_trace(self):
        start = time.monotonic()
        self.run_scene(lively(), "whole")
        lasts = time.monotonic() - start
        moments = random.Random(6)
        self.write(lively(), "killed.json")
        kills = resumes = 0
        while kills < 20:
            begun = self.checkpoints("killed")
            run = self.start("run", *(["--resume", "killed"] if begun else ["killed.json", "-o", "killed"]),
                             "--progress", "none")
            time.sleep(moments.uniform(0.02, 0.6 * lasts + 0.05))
            if run.poll() is not None:
                self.assertEqual(run.returncode, DONE, run.stderr.read())
                shutil.rmtree(self.folder / "killed")  # it got to the end: from the start again
                continue
            run.send_signal(signal.SIGKILL)
            run.wait()
            kills += 1
            resumes += bool(begun)
            for path in (self.folder / "killed").rglob("frame_*.vtp"):
                if not path.name.startswith("."):
                    self.assertTrue(path.read_bytes().rstrip().endswith(b"</VTKFile>"), f"{path} is torn")
        self.assertGreater(resumes, 5, "hardly any run was killed after it had been resumed")
        if self.checkpoints("killed"):
            self.resume("killed")
        else:
            self.run_scene(lively(), "killed")
        self.assert_same("whole", "killed")

    def test_a_torn_checkpoint_is_passed_over(self):
        self.run_scene(lively(), "whole")
        self.run_scene(lively(), "out", "--until", "0.1")
        newest = self.folder / "out/checkpoints" / self.checkpoints("out")[-1]
        newest.write_bytes(newest.read_bytes()[:-7])
        _, err = self.call("run", "--resume", "out", "--until", "0.2", "--progress", "plain")
        self.assertIn("damaged or cut short: its checksum does not match", err)
        self.assert_same("whole", "out")


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


if __name__ == "__main__":
    unittest.main()
