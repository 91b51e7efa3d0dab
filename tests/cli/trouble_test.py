"""Runs that do not end as planned: interrupted, no room, no folder."""
import csv
import resource
import time

from frames import read_pvd, read_vtp
from sessile_cli import CliTest, FAILED, ended_by, signal, tiny, unittest


class Good(CliTest):
    def expect_good_results(self, folder, status):
        """What lies in the folder must be whole, and say the same of the run everywhere."""
        summary = self.summary(folder)
        self.assertEqual(summary["status"], status)
        self.assertEqual([n for n in self.names(folder) if n.startswith(".")], [], "temporary files stayed behind")
        frames = read_pvd(self.folder / folder / "frames.pvd")
        self.assertEqual(len(frames), summary["frames"])
        self.assertEqual(len(frames), len(list((self.folder / folder).glob("frame_*.vtp"))))
        for when, name in frames:
            self.assertEqual(read_vtp(self.folder / folder / name)[2], when)
        with open(self.folder / folder / "stats.csv", newline="") as file:
            rows = list(csv.reader(file))
        self.assertEqual({len(row) for row in rows}, {len(rows[0])})
        return summary, frames


class Interrupted(Good):
    def interrupt(self, which):
        scene = tiny(time={"end": 1e4, "fixed_dt": 0.005}, output={"frame_interval": 0.02})
        process = self.start("run", self.write(scene), "-o", "out", "--progress", "none")
        until = time.monotonic() + 30
        while not (self.folder / "out/frame_000003.vtp").exists():
            self.assertIsNone(process.poll(), "it ended by itself")
            self.assertLess(time.monotonic(), until, "no frames appear")
            time.sleep(0.02)
        process.send_signal(which)
        out, err = process.communicate(timeout=30)
        self.assertEqual(process.returncode, ended_by(which))
        self.assertRegex(err, r"\Ainterrupted; everything up to [\d.e+]+ s is written, and it goes on with: sessile run --resume out\n\Z")
        self.assertRegex(out, r"\d+ frames, stats.csv and summary.json are in out\n\Z")
        summary, frames = self.expect_good_results("out", "interrupted")
        self.assertAlmostEqual(frames[-1][0], summary["simulated_time_s"], places=6)
        self.assertLess(summary["simulated_time_s"], 1e4)

    def test_by_the_user(self):
        self.interrupt(signal.SIGINT)

    def test_by_the_system(self):
        self.interrupt(signal.SIGTERM)


class NobodyReads(Good):
    """Who reads along may go; the run then ends as with Ctrl-C, and what is written stays good."""

    def run_until_nobody_reads(self, style, stream, scene):
        process = self.start("run", self.write(scene), "-o", "out", "--progress", style)
        if style == "json":
            process.stdout.readline()
        getattr(process, stream).close()
        self.assertEqual(process.wait(timeout=30), ended_by(signal.SIGPIPE))
        self.expect_good_results("out", "interrupted")

    def test_the_progress(self):
        self.run_until_nobody_reads("json", "stdout", tiny(time={"end": 1e4, "fixed_dt": 0.005}))

    def test_the_warnings(self):
        self.run_until_nobody_reads("plain", "stderr", tiny(time={"end": 1e6, "fixed_dt": 0.12}, output={"frame_interval": 5}, forces=[], solids=[]))

    def test_streams_on_a_full_disk(self):
        scene = self.write(tiny())
        self.call("run", scene, "-o", "out", "--progress", "plain", before="exec >/dev/full 2>/dev/full")
        self.expect_good_results("out", "done")
        for command in (["check", scene], ["check", "--json", scene], ["info"], ["models"]):
            _, err = self.call(*command, code=FAILED, before="exec >/dev/full")
            self.assertEqual(err, "sessile: cannot write to standard output\n")


class NoFolder(CliTest):
    """The tests may run as root, whom no permission stops; these places stop root as well."""

    def expect(self, folder, message):
        out, err = self.call("run", self.write(tiny()), "-o", folder, code=FAILED)
        self.assertEqual(out, "")
        self.assertEqual(err.split(";")[0], f"sessile: {message}")

    def test_below_a_file(self):
        (self.folder / "file").write_text("mine")
        self.expect("file/out", "cannot create the folder file/out: Not a directory")
        self.expect("file", "cannot create the folder file: Not a directory")
        self.assertEqual((self.folder / "file").read_text(), "mine")

    def test_where_nothing_can_be_made(self):
        self.expect("/proc/sessile", "cannot create the folder /proc/sessile: No such file or directory")


class NoRoom(Good):
    """A limit on the size of files stands for a full disk: the write fails in the same way."""

    def limited(self, kib, *options, **scene):
        soft = kib * 1024
        self.assertGreater(resource.getrlimit(resource.RLIMIT_FSIZE)[0] % (1 << 63), soft % (1 << 63))
        out, err = self.call("run", self.write(tiny(**scene)), "-o", "out", "--progress", "none", *options, code=FAILED,
                             before=f"ulimit -f {kib}")
        self.assertEqual(out, "")
        self.assertRegex(err, r"\Asessile: cannot write out/\S+: File too large; a limit on the size of files stands in the way .*; what had been written is whole\n")
        return err

    def test_after_some_frames(self):
        # stats.csv grows by a line a step until it meets the limit; the frames stay small.
        err = self.limited(12, time={"end": 10, "fixed_dt": 0.005},
                           output={"frame_interval": 0.02, "stats_interval": 0.005, "formats": ["vtp"]})
        self.assertIn("out/stats.csv", err)
        summary, frames = self.expect_good_results("out", "failed")
        self.assertGreater(len(frames), 1)
        self.assertEqual(f"sessile: {summary['message']}", err.split(";")[0])  # what helps follows

    def test_for_no_frame_at_all(self):
        err = self.limited(1, bodies=[{"shape": {"type": "box", "size": [1, 1, 1]}, "placement": {"position": [0, 0, 1]}}])
        self.assertIn("out/scene.json", err)

    def test_for_the_frames(self):
        # Emitted layers make each frame larger than the one before, until one is too large.
        spout = {"interval": 0.05, "velocity": [0, 0, 3], "placement": {"position": [0, 0, 1]},
                 "shape": {"type": "rectangle", "width": 1, "depth": 1}}
        err = self.limited(32, time={"end": 3, "fixed_dt": 0.005}, emitters=[spout], bodies=[], gravity=[0, 0, 0],
                           output={"frame_interval": 0.05, "stats_interval": 1, "formats": ["vtp"]}, forces=[])
        self.assertRegex(err, r"out/frame_\d+\.vtp")
        summary, frames = self.expect_good_results("out", "failed")
        self.assertGreater(len(frames), 1)
        self.assertEqual(f"sessile: {summary['message']}", err.split(";")[0])  # what helps follows


if __name__ == "__main__":
    unittest.main()
