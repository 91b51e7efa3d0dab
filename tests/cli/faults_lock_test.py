"""Two programs on one folder: the second is refused, and told by whom; a killed one locks nobody out."""
import os
import socket
import time

from sessile_cli import CliTest, IN_USE, ended_by, signal, tiny, unittest

LOCK = ".sessile.lock"
ENDLESS = dict(time={"end": 1e4, "fixed_dt": 0.005}, output={"frame_interval": 0.02})


class Lock(CliTest):
    def running(self, *arguments, **scene):
        """A run into the folder out that does not end by itself, as soon as it has written a frame."""
        process = self.start("run", self.write(tiny(**{**ENDLESS, **scene}), "long.json"), "-o", "out", "--progress", "none",
                             *arguments)
        self.wait_for("out/frame_000001.vtp", process=process)
        return process

    def stop(self, process):
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=30)
        self.assertEqual(process.returncode, ended_by(signal.SIGTERM))

    def expect_refusal(self, holder, folder, *command):
        out, err = self.call(*command, code=IN_USE)
        self.assertEqual((out, err), ("", f"sessile: {folder}: process {holder.pid} on {socket.gethostname()} writes into this "
                                          f"folder; wait until it is done, end it with `kill {holder.pid}`, or give another "
                                          "folder with -o\n"))


class Runs(Lock):
    def test_the_second_is_refused_and_the_first_is_left_alone(self):
        first = self.running()
        self.expect_refusal(first, "out", "run", self.write(tiny()), "-o", "out")
        self.assertIsNone(first.poll())
        self.stop(first)
        self.assertEqual(self.summary()["status"], "interrupted")
        self.assertEqual(self.summary()["scene"]["time"]["end"], 1e4)
        self.assertNotIn(LOCK, self.names())
        self.call("run", "s.json", "-o", "out", "--progress", "none")
        self.assertNotIn(LOCK, self.names())

    def test_by_another_name(self):
        first = self.running()
        (self.folder / "link").symlink_to("out")
        self.expect_refusal(first, "link", "run", self.write(tiny()), "-o", "link")
        self.expect_refusal(first, self.folder / "out", "run", "s.json", "-o", self.folder / "out")

    def test_a_killed_one_locks_nobody_out(self):
        first = self.running()
        first.kill()
        first.wait(timeout=30)
        self.assertIn(LOCK, self.names())
        self.call("run", self.write(tiny()), "-o", "out", "--progress", "none")
        self.assertNotIn(LOCK, self.names())
        self.assertEqual(self.summary()["status"], "done")

    def test_what_the_lock_file_says_alone_refuses_nobody(self):
        (self.folder / "out").mkdir()
        (self.folder / "out" / LOCK).write_text(f"{os.getpid()} {socket.gethostname()}\n")
        self.call("run", self.write(tiny()), "-o", "out", "--progress", "none")

    def test_a_lock_file_that_is_taken_out_lets_nobody_in(self):
        first = self.running()
        (self.folder / "out" / LOCK).unlink()
        _, err = self.call("run", self.write(tiny()), "-o", "out", code=IN_USE)
        self.assertIn("out: another process writes into this folder; wait until it is done, or give another folder", err)
        # Nor does the first take out what then has the name.
        (self.folder / "out" / LOCK).write_text("of somebody else")
        self.stop(first)
        self.assertEqual((self.folder / "out" / LOCK).read_text(), "of somebody else")

    def test_where_folders_cannot_be_locked_the_file_is(self):
        faults = {"CALL": "flock", "PATH": "/out", "ERROR": 9, "ENDS": 1}
        first = self.start("run", self.write(tiny(**ENDLESS), "long.json"), "-o", "out", "--progress", "none", faults=faults)
        self.wait_for("out/frame_000001.vtp", process=first)
        _, err = self.call("run", self.write(tiny()), "-o", "out", code=IN_USE, faults=faults)
        self.assertIn(f"out: process {first.pid} on ", err)
        _, err = self.call("run", "s.json", "-o", "elsewhere", faults={**faults, "PATH": "/elsewhere"})
        self.assertNotIn("warning", err)

    def test_links_in_place_of_the_lock_file_are_replaced(self):
        (self.folder / "out").mkdir()
        lock, mine = self.folder / "out" / LOCK, self.folder / "mine.txt"
        for link in (lock.hardlink_to, lock.symlink_to):
            mine.write_text("mine")
            link(mine)
            self.call("run", self.write(tiny()), "-o", "out", "--progress", "none")
            self.assertEqual(mine.read_text(), "mine")
            self.assertNotIn(LOCK, self.names())
        os.mkfifo(lock)
        self.call("run", "s.json", "-o", "out", "--progress", "none")

    def test_of_many_in_the_same_instant_one_runs(self):
        scene = self.write(tiny(**ENDLESS))
        several = [self.start("run", scene, "-o", "out", "--progress", "none", before="kill -STOP $$") for _ in range(6)]
        for each in several:
            os.waitid(os.P_PID, each.pid, os.WSTOPPED | os.WNOWAIT)
        for each in several:
            each.send_signal(signal.SIGCONT)
        self.wait_for("out/frame_000001.vtp")
        until = time.monotonic() + 30
        while len(losers := [each for each in several if each.poll() is not None]) < len(several) - 1:
            self.assertLess(time.monotonic(), until, f"{len(losers)} of {len(several)} are refused")
            time.sleep(0.02)
        winner, = [each for each in several if each not in losers]
        for each in losers:
            self.assertEqual(each.returncode, IN_USE)
            self.assertIn(f"process {winner.pid} on ", each.stderr.read())
        winner.send_signal(signal.SIGINT)
        self.assertEqual(winner.wait(timeout=30), ended_by(signal.SIGINT))
        self.assertEqual(self.summary()["status"], "interrupted")

    def test_without_locks_it_warns_and_runs(self):
        for error, reason in ((37, "No locks available"), (95, "Operation not supported")):
            _, err = self.call("run", self.write(tiny()), "-o", "out", "--progress", "plain",
                               faults={"CALL": "flock", "ERROR": error})
            self.assertIn(f"warning: out: this file system knows no locks ({reason}); see to it that no other run writes into "
                          "the same folder\n", err)
            self.assertEqual(self.summary()["status"], "done")


class Others(Lock):
    """What other commands may do in a folder that a run writes into."""

    def test_reading_is_free(self):
        first = self.running()
        self.call("mesh", "out", "--progress", "none", "--frames", "0:2")
        self.call("mesh", "out", "--progress", "none", "--frames", "0:2", "-o", "elsewhere")
        self.assertIsNone(first.poll())

    def test_surfaces_of_the_run_itself(self):
        first = self.running(output={"frame_interval": 0.02, "surface": {"formats": ["ply"]}})
        self.expect_refusal(first, "out/surface", "mesh", "out", "--progress", "none")
        self.expect_refusal(first, "out", "mesh", "out", "--progress", "none", "-o", "out")

    def test_compare(self):
        scene = self.write(tiny(**ENDLESS))
        first = self.start("compare", scene, "--methods", "none,akinci2013", "-o", "out", "--progress", "none")
        self.wait_for("out/none/frame_000001.vtp", process=first)
        self.expect_refusal(first, "out", "compare", scene, "--methods", "none", "-o", "out", "--progress", "none")
        self.expect_refusal(first, "out/none", "run", scene, "-o", "out/none")
        self.stop(first)
        self.call("compare", self.write(tiny()), "--methods", "none", "-o", "out", "--progress", "none")
        self.assertNotIn(LOCK, self.names())

    def test_mesh_twice(self):
        self.call("run", self.write(tiny()), "-o", "out", "--progress", "none")
        first = self.start("mesh", "out", "--progress", "none", faults={"CALL": "fsync", "PATH": "surface_000001", "HOLD": "held"})
        self.wait_for("held", process=first)
        self.expect_refusal(first, "out/surface", "mesh", "out", "--progress", "none")
        self.expect_refusal(first, "out/surface", "run", "s.json", "-o", "out", "--progress", "none")
        self.assertIn("surface_000000.ply", self.names("out/surface"))


if __name__ == "__main__":
    unittest.main()
