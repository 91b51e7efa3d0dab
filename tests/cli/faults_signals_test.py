"""Signals: which end a run after the step at hand, which at once, which not at all; and what is left."""
import contextlib
import os
import shutil
import time

from frames import read_ply, read_vtp
from sessile_cli import CliTest, DONE, PROGRAM, ended_by, signal, subprocess, tiny, unittest

ENDLESS = dict(time={"end": 1e4, "fixed_dt": 0.005}, output={"frame_interval": 0.02})


class Signals(CliTest):
    def running(self, before="", faults=None, **scene):
        shutil.rmtree(self.folder / "out", ignore_errors=True)
        process = self.start("run", self.write(tiny(**{**ENDLESS, **scene})), "-o", "out", "--progress", "none", before=before,
                             faults=faults)
        self.wait_for("out/frame_000003.vtp", process=process)
        return process

    def expect_end(self, process, which):
        out, err = process.communicate(timeout=30)
        self.assertEqual(process.returncode, ended_by(which), err)
        self.assertRegex(err, r"\Ainterrupted; everything up to [\d.e+]+ s is written")
        self.assertEqual(self.summary()["status"], "interrupted")
        self.expect_whole_files()

    def expect_whole_files(self):
        for path in (self.folder / "out").glob("frame_*"):
            {".vtp": read_vtp, ".ply": read_ply}[path.suffix](path)
        text = (self.folder / "out/stats.csv").read_text()
        self.assertTrue(text.endswith("\n"))
        self.assertEqual(len({line.count(",") for line in text.splitlines()}), 1)

    def expect_going_on(self, process):
        seen = len(self.names())
        until = time.monotonic() + 30
        while len(self.names()) < seen + 3:
            self.assertIsNone(process.poll(), "it ended")
            self.assertLess(time.monotonic(), until, "it does not go on")
            time.sleep(0.01)


class Once(Signals):
    def test_each_has_its_exit_code(self):
        for which in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(which):
                process = self.running()
                process.send_signal(which)
                self.expect_end(process, which)

    def test_echoes_are_not_a_second_wish(self):
        # As `timeout` and terminals do: to the process, and to its group.
        for which in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            with self.subTest(which):
                process = self.running(faults={"CALL": "fsync", "PATH": "no such file", "ERROR": 5})
                process.send_signal(which)
                process.send_signal(which)
                self.expect_end(process, which)


class Unread(Signals):
    """Progress goes into a pipe that is full and that nobody reads: the run waits, and a signal ends it all the same."""

    def blocked(self):
        shutil.rmtree(self.folder / "out", ignore_errors=True)
        read, write = os.pipe()
        self.addCleanup(os.close, read)
        os.set_blocking(write, False)
        with contextlib.suppress(BlockingIOError):
            while True:
                os.write(write, b"x" * 4096)
        os.set_blocking(write, True)  # of the pipe's end, which the program has too
        process = subprocess.Popen([PROGRAM, "run", self.write(tiny(**ENDLESS)), "-o", "out", "--progress", "json"], cwd=self.folder,
                                   env=self.environment(), text=True, stdin=subprocess.DEVNULL, stdout=write,
                                   stderr=subprocess.PIPE)
        os.close(write)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.wait_for("out/frame_000000.vtp", process=process)
        until, seen = time.monotonic() + 30, None
        while seen != (seen := sorted(self.names())):
            self.assertLess(time.monotonic(), until, "it does not wait")
            time.sleep(1)
        return process

    def test_one_is_enough(self):
        for times in (1, 2):
            process = self.blocked()
            for _ in range(times):
                process.send_signal(signal.SIGTERM)
            _, err = process.communicate(timeout=10)
            self.assertEqual(process.returncode, ended_by(signal.SIGTERM), err)
            self.assertEqual(self.summary()["status"], "interrupted")
            self.assertEqual(len(self.names("out/checkpoints")), 1)
            self.expect_whole_files()


class Twice(Signals):
    """The disk hangs at a frame, so that the step at hand does not end."""

    def hanging(self):
        process = self.start("run", self.write(tiny(**ENDLESS)), "-o", "out", "--progress", "none",
                             faults={"CALL": "fsync", "PATH": "frame_000003", "HOLD": self.folder / "held"})
        self.wait_for("held", process=process)
        return process

    def test_ends_at_once(self):
        for first, second in ((signal.SIGINT, signal.SIGINT), (signal.SIGTERM, signal.SIGTERM), (signal.SIGHUP, signal.SIGTERM)):
            with self.subTest(f"{first}, {second}"):
                (self.folder / "held").unlink(missing_ok=True)
                process = self.hanging()
                process.send_signal(first)
                with self.assertRaises(Exception):
                    process.wait(timeout=0.5)  # a hanging disk keeps it
                until = time.monotonic() + 30
                while process.poll() is None and time.monotonic() < until:
                    process.send_signal(second)
                    time.sleep(0.25)
                self.assertEqual(process.wait(timeout=1), -second)
                self.assertNotIn("frame_000003.vtp", self.names())
                self.assertNotIn("summary.json", self.names())
                self.expect_whole_files()
                self.call("run", self.write(tiny(), "again.json"), "-o", "out", "--progress", "none")
                self.assertEqual([name for name in self.names() if name.startswith(".")], [])

    def test_hangups_come_in_numbers(self):
        process = self.hanging()
        for _ in range(3):
            process.send_signal(signal.SIGHUP)
            with self.assertRaises(Exception):
                process.wait(timeout=0.25)


class Ignored(Signals):
    def test_what_was_ignored_stays_so(self):
        process = self.running(before="trap '' HUP INT")  # nohup; a job in the background of a script
        for which in (signal.SIGHUP, signal.SIGINT, signal.SIGHUP):
            process.send_signal(which)
            self.expect_going_on(process)
        process.send_signal(signal.SIGTERM)
        self.expect_end(process, signal.SIGTERM)

    def test_a_reader_that_goes_where_it_is_ignored(self):
        process = self.start("run", self.write(tiny()), "-o", "out", "--progress", "json", before="trap '' PIPE")
        process.stdout.close()
        self.assertEqual(process.wait(timeout=30), DONE)
        self.assertEqual(self.summary()["status"], "done")


class Others(Signals):
    def test_stop_and_go_on(self):
        process = self.running(time={"end": 2, "fixed_dt": 0.005})
        for which in (signal.SIGTSTP, signal.SIGSTOP):
            process.send_signal(which)
            time.sleep(0.05)
            process.send_signal(signal.SIGCONT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, DONE)
        self.call("run", "s.json", "-o", "straight", "--progress", "none")
        for name in self.names("straight"):
            if name not in ("summary.json", "checkpoints"):
                self.assertEqual((self.folder / "straight" / name).read_bytes(), (self.folder / "out" / name).read_bytes(), name)

    def test_quit_ends_at_once(self):
        process = self.running(before="ulimit -c 0")
        process.send_signal(signal.SIGQUIT)
        self.assertEqual(process.wait(timeout=30), -signal.SIGQUIT)
        self.expect_whole_files()

    def test_before_the_first_step_nothing_is_written(self):
        # So many particles take a while to place.
        body = {"shape": {"type": "box", "size": [3, 3, 3]}, "placement": {"position": [0, 0, 10]}}
        for which in (signal.SIGINT, signal.SIGTERM):
            process = self.start("run", self.write(tiny(spacing=0.015, bodies=[body])), "-o", "out", before="echo >&2 up")
            process.stderr.readline()
            process.send_signal(which)
            process.communicate(timeout=60)
            self.assertEqual(process.returncode, -which)
            self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
