"""Disks that fill up or go away while a run writes: what was whole stays so, and the run says what to do."""
import os
import shutil
import subprocess
import time

from sessile_cli import FAILED, ended_by, signal, tiny, unittest
from trouble_test import Good

NO_SPACE, READ_ONLY, BROKEN = 28, 30, 5
CHECKPOINTS = {"interval": 0.01, "keep": 3}


def scene(**changes):
    return tiny(output={"frame_interval": 0.01, "stats_interval": 0.005, "formats": ["vtp", "ply"],
                        "surface": {"formats": ["ply", "usda"]}, "checkpoint": CHECKPOINTS}, **changes)


class Disk(Good):
    def expect_no_halves(self, folder="out"):
        # A checkpoint's half is taken out too; only surfaces that wait for the last frame are kept for a resumed run.
        halves = [path for path in (self.folder / folder).rglob(".*") if ".usda." not in path.name]
        self.assertEqual(halves, [], "temporary files stayed behind")

    def expect_same_results(self, a, b):
        files = sorted(p.relative_to(self.folder / a) for p in (self.folder / a).rglob("*") if p.is_file())
        self.assertEqual(files, sorted(p.relative_to(self.folder / b) for p in (self.folder / b).rglob("*") if p.is_file()))
        for name in files:
            if name.name != "summary.json" and name.suffix != ".sessile":  # these hold wall times
                self.assertEqual((self.folder / a / name).read_bytes(), (self.folder / b / name).read_bytes(), name)


class EveryFile(Disk):
    """The write of one file fails, whichever it is."""

    def fail_at(self, path, error, call="write"):
        shutil.rmtree(self.folder / "out", ignore_errors=True)
        return self.call("run", self.write(scene()), "-o", "out", "--progress", "none", code=FAILED,
                         faults={"CALL": call, "PATH": path, "ERROR": error})[1]

    def test_that_a_run_writes(self):
        early = ("scene.json", "solids.vtp", "surface.json")  # before the first frame there is no summary
        for path in (*early, "frame_000002.ply", "frame_000002.vtp", "frames.pvd", "stats.csv", "/out/.summary.json",
                     "surface_000001.ply", "/.surface.usda.part", "checkpoint_"):
            with self.subTest(path):
                err = self.fail_at(path, NO_SPACE)
                self.assertRegex(err, r"\Asessile: cannot write out/\S+: No space left on device; make room on that disk; what had "
                                      r"been written is whole\n")
                self.assertIn(path.rpartition("/.")[2], err)
                self.expect_no_halves()
                self.assertFalse((self.folder / "out" / path).exists() and path not in ("stats.csv", "frames.pvd", "surface.json"))
                resumable = any((self.folder / "out").glob("checkpoints/checkpoint_*"))
                self.assertEqual("then go on with: sessile run --resume out\n" in err, resumable)
                if "summary" not in path and path not in early + ("stats.csv",):
                    summary = self.summary()
                    self.assertEqual(summary["status"], "failed")
                    self.assertTrue(err.startswith(f"sessile: {summary['message']}; make room"))
                if resumable:
                    self.call("run", "--resume", "out", "--progress", "none")
                    if not (self.folder / "straight").exists():
                        self.call("run", "s.json", "-o", "straight", "--progress", "none")
                    self.expect_same_results("straight", "out")

    def test_in_other_ways(self):
        for call, error, message in (
                ("fsync", BROKEN, "Input/output error; the disk or its connection is at fault: look after it before you go on"),
                ("rename", READ_ONLY, "Read-only file system; give yourself the right to write there, or choose another folder "
                                      "with -o"),
                ("fsync", 122, "Disk quota exceeded; make room on that disk; what had been written is whole")):
            with self.subTest(message):
                err = self.fail_at("frame_000002", error, call)
                self.assertIn(f"sessile: cannot write out/frame_000002.vtp: {message}\n", err)
                self.expect_no_halves()
                self.expect_good_results("out", "failed")


class RealDisk(Disk):
    def setUp(self):
        super().setUp()
        self.disk = self.folder / "disk"
        self.disk.mkdir()

    def mount(self, size):
        if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "none", self.disk], capture_output=True).returncode != 0:
            # Where everything is to be tested, a skip would pass for a success.
            self.assertFalse(os.environ.get("CI") == "true" and os.geteuid() == 0, "no small disk can be mounted here")
            self.skipTest("a small disk can only be mounted by root")
        self.addCleanup(subprocess.run, ["umount", "-l", self.disk], check=True)

    def remount(self, options):
        subprocess.run(["mount", "-o", f"remount,{options}", self.disk], check=True)

    def test_full_and_then_larger(self):
        self.mount("512k")
        name = self.write(scene(time={"end": 0.5, "fixed_dt": 0.005}))
        _, err = self.call("run", name, "-o", "disk/out", "--progress", "none", code=FAILED)
        self.assertRegex(err, r"\Asessile: cannot write disk/out/\S+: No space left on device; make room on that disk; what had been "
                              r"written is whole\nthen go on with: sessile run --resume disk/out\n\Z")
        self.expect_no_halves("disk/out")
        self.remount("size=64m")
        self.call("run", "--resume", "disk/out", "--progress", "none")
        self.call("run", name, "-o", "straight", "--progress", "none")
        self.expect_same_results("straight", "disk/out")

    def test_read_only_midway(self):
        self.mount("64m")
        process = self.start("run", self.write(scene(time={"end": 1e4, "fixed_dt": 0.005})), "-o", "disk/out", "--progress", "none")
        self.wait_for("disk/out/checkpoints", "disk/out/frame_000003.vtp", process=process)
        process.send_signal(signal.SIGSTOP)
        time.sleep(0.05)
        # Files that are open for writing keep a disk writable: what has its lock stays, so the folder is bound over.
        subprocess.run(["mount", "--bind", self.disk, self.disk], check=True)
        self.addCleanup(subprocess.run, ["umount", "-l", self.disk], check=True)
        subprocess.run(["mount", "-o", "remount,ro,bind", self.disk], check=True)
        process.send_signal(signal.SIGCONT)
        _, err = process.communicate(timeout=30)
        self.assertEqual(process.returncode, FAILED)
        self.assertIn("Read-only file system; give yourself the right to write there, or choose another folder with -o\n", err)
        self.assertIn("then go on with: sessile run --resume disk/out\n", err)


class Folder(Disk):
    def running(self):
        process = self.start("run", self.write(scene(time={"end": 1e4, "fixed_dt": 0.005})), "-o", "out", "--progress", "none")
        self.wait_for("out/frame_000003.vtp", process=process)
        return process

    def expect_failure(self, process, message):
        out, err = process.communicate(timeout=30)
        self.assertEqual((process.returncode, out), (FAILED, ""), err)
        self.assertRegex(err, message)
        self.assertIn("the folder has to stay where it is, with all that is in it, while a run writes into it\n", err)

    def test_renamed(self):
        process = self.running()
        (self.folder / "out").rename(self.folder / "moved")
        self.expect_failure(process, rf"\Asessile: the folder out has been renamed while it was written into; what is there is whole: "
                                     rf"{self.folder}/moved; ")
        self.assertFalse((self.folder / "out").exists())
        self.call("run", "--resume", "moved", "--progress", "none", "--until", "0.1", code=0)

    def test_renamed_and_another_in_its_place(self):
        process = self.running()
        process.send_signal(signal.SIGSTOP)
        os.waitid(os.P_PID, process.pid, os.WSTOPPED | os.WNOWAIT)
        (self.folder / "out").rename(self.folder / "moved")
        (self.folder / "out").mkdir()
        (self.folder / "out/summary.json").write_text("of somebody else")
        process.send_signal(signal.SIGCONT)
        self.expect_failure(process, rf"the folder out has been renamed while it was written into; what is there is whole: "
                                     rf"{self.folder}/moved; ")
        self.assertEqual((self.folder / "out/summary.json").read_text(), "of somebody else")

    def test_removed(self):
        process = self.running()
        process.send_signal(signal.SIGSTOP)
        os.waitid(os.P_PID, process.pid, os.WSTOPPED | os.WNOWAIT)
        shutil.rmtree(self.folder / "out")
        process.send_signal(signal.SIGCONT)
        self.expect_failure(process, r"\Asessile: the folder out has been removed while it was written into; ")
        self.assertFalse((self.folder / "out").exists())

    def test_a_file_in_its_place(self):
        process = self.running()
        process.send_signal(signal.SIGSTOP)
        os.waitid(os.P_PID, process.pid, os.WSTOPPED | os.WNOWAIT)
        shutil.rmtree(self.folder / "out")
        (self.folder / "out").write_text("a file")
        process.send_signal(signal.SIGCONT)
        self.expect_failure(process, r"\Asessile: the folder out has been removed while it was written into; ")
        self.assertEqual((self.folder / "out").read_text(), "a file")

    def test_a_file_in_it_removed(self):
        process = self.running()
        (self.folder / "out/stats.csv").unlink()
        self.expect_failure(process, r"\Asessile: out/stats\.csv has been removed while it was written; ")
        self.assertEqual(self.summary()["status"], "failed")
        self.assertNotIn("stats.csv", self.names())

    def test_out_of_reach(self):
        """Where it cannot be told whether the folder stands where it did, nobody is told that it was renamed."""
        if os.geteuid() != 0:
            self.skipTest("only root runs the program as somebody else")
        process = self.running_as_nobody()
        self.folder.chmod(0o700)
        out, err = process.communicate(timeout=30)
        self.assertEqual((process.returncode, out), (FAILED, ""))
        self.assertRegex(err, r"\Asessile: cannot reach the folder out: Permission denied; give yourself the right to write there, or "
                              r"choose another folder with -o\n")

    def test_unwritable(self):
        """As somebody whom permissions stop."""
        process = self.running() if os.geteuid() != 0 else self.running_as_nobody()
        (self.folder / "out").chmod(0o555)
        self.addCleanup((self.folder / "out").chmod, 0o755)
        out, err = process.communicate(timeout=30)
        self.assertEqual((process.returncode, out), (FAILED, ""))
        self.assertRegex(err, r"\Asessile: cannot write out/\S+: Permission denied; give yourself the right to write there, or "
                              r"choose another folder with -o\n(then go on with: .*\n)?\Z")

    def running_as_nobody(self):
        os.chmod(self.folder, 0o777)
        name = self.write(scene(time={"end": 1e4, "fixed_dt": 0.005}))
        process = self.start("run", name, "-o", "out", "--progress", "none", user=65534)
        try:
            self.wait_for("out/frame_000003.vtp", process=process)
        except AssertionError:
            if process.poll() == 126:
                self.skipTest("others may not run the program")
            raise
        return process


if __name__ == "__main__":
    unittest.main()
