"""Limits of the system: files, memory, threads, stack; standard streams that are closed. No crash, and good files."""
import re

from sessile_cli import BAD_INPUT, DONE, FAILED, PROGRAM, subprocess, tiny, unittest
from trouble_test import Good

NO_LIBRARIES = 127  # the system could not even load the program
WARNING = dict(forces=[], solids=[], time={"end": 0.48, "fixed_dt": 0.12}, output={"frame_interval": 0.12, "stats_interval": 0.12})


def larger():
    """A scene whose arrays fill some blocks of particles, so that threads have work to share; surfaces, checkpoints."""
    return tiny(spacing=0.04, time={"end": 0.004, "fixed_dt": 0.001},
                output={"frame_interval": 0.002, "stats_interval": 0.001, "surface": {"formats": ["ply"]},
                        "checkpoint": {"interval": 0.002}})


class Limits(Good):
    def attempt(self, *arguments, before="", faults=None):
        """(exit code, standard error) of a run into out, which must not end by a signal."""
        command = [PROGRAM, "run", *arguments, "-o", "out", "--progress", "none"]
        if before:  # faults are not for the shell
            command = ["bash", "-c", before + '; exec "$@"', "bash", *command]
        result = subprocess.run(command, cwd=self.folder, env={**self.environment(), **self.loaded(faults)}, timeout=60,
                                text=True, stdin=subprocess.DEVNULL, capture_output=True)
        self.assertIn(result.returncode, (DONE, FAILED, NO_LIBRARIES), f"{before} {faults}: {result.stderr}")
        self.assertNotIn("terminate called", result.stderr)
        return result.returncode, result.stderr

    def expect(self, code, err, message):
        if code == DONE:
            self.expect_good_results("out", "done")
        elif code == FAILED:
            self.assertRegex(err, message)
            if (self.folder / "out/summary.json").exists():
                self.expect_good_results("out", "failed")


class Files(Limits):
    def test_few_may_be_open(self):
        name, codes = self.write(larger()), set()
        for limit in (4, 6, 8, 13):
            code, err = self.attempt(name, before=f"ulimit -n {limit}")
            self.expect(code, err, r"\Asessile: cannot [^\n]*Too many open files")
            codes.add(code)
        self.assertEqual(codes - {NO_LIBRARIES}, {DONE, FAILED})

    def test_24_are_enough_for_every_kind_of_file(self):
        scene = larger()
        scene["output"].update(formats=["vtp", "ply"], surface={"formats": ["ply", "obj", "vtp", "vdb", "usda"]})
        for kinds, limit in ((None, 24), (["ply"], 13)):
            if kinds:
                scene["output"]["surface"]["formats"] = kinds
            code, err = self.attempt(self.write(scene), "--threads", "1", before=f"ulimit -n {limit}")
            self.assertEqual((code, err), (DONE, ""), limit)

    def test_what_helps_is_said(self):
        for limit in (8, 7, 9, 10):
            code, err = self.attempt(self.write(larger()), before=f"ulimit -n {limit}")
            if code == FAILED and "cannot write" in err:
                self.assertIn("; too few files may be open at once: `ulimit -n 256` is enough for any run\n", err)
                return
        self.fail("no limit let it begin and not end")


class Memory(Limits):
    MESSAGE = (r"\Asessile: (out of memory: the program has held [\d.]+ MiB, and the system gives it no more; `sessile check SCENE` "
               r"says what a scene takes; a larger spacing takes less, and `ulimit -v` shows a limit|cannot start a thread: )")

    def test_allocations_may_fail_at_any_time(self):
        name, failed = self.write(larger()), 0
        for after in range(0, 132, 12):  # also in zlib, and where frames are encoded
            code, err = self.attempt(name, "--threads", "2", faults={"CALL": "malloc", "SIZE": 4096, "AFTER": after, "ERROR": 12})
            self.expect(code, err, self.MESSAGE)
        after = 0
        while True:
            code, err = self.attempt(name, "--threads", "2", faults={"CALL": "malloc", "SIZE": 4096, "AFTER": after, "ERROR": 12})
            self.expect(code, err, self.MESSAGE)
            if code == DONE:
                break
            failed += 1
            after = 2 * after + 1
        self.assertGreater(failed, 7)  # up to 255 large pieces went through: 9 runs of that many and fewer failed

    def test_a_limit(self):
        name, codes = self.write(larger()), set()
        for mib in (150, 250, 1200):
            code, err = self.attempt(name, "--threads", "2", before=f"ulimit -v {mib * 1024}")
            if "terminate" not in err and code == FAILED and not re.search(self.MESSAGE, err):
                self.fail(f"{mib} MiB: {err}")
            codes.add(code)
            if code == DONE:
                break
        self.assertIn(DONE, codes)


class Threads(Limits):
    def test_fewer_than_asked_for(self):
        name = self.write(larger())
        self.call("run", name, "-o", "straight", "--progress", "none")
        code, err = self.attempt(name, "--threads", "4", faults={"CALL": "pthread_create", "AFTER": 2, "COUNT": 1, "ERROR": 11})
        self.assertEqual((code, err), (DONE, "warning: 2 threads instead of 4, which cannot be started: Resource temporarily "
                                             "unavailable\n"))
        for path in self.names("straight"):
            if (self.folder / "straight" / path).is_file() and path != "summary.json":
                self.assertEqual((self.folder / "straight" / path).read_bytes(), (self.folder / "out" / path).read_bytes(), path)

    def test_none_at_all(self):
        code, err = self.attempt(self.write(larger()), faults={"CALL": "pthread_create", "ERROR": 11})
        self.assertEqual((code, err), (FAILED, "sessile: cannot start a thread: Resource temporarily unavailable; `--threads 1` takes "
                                               "fewer, `ulimit -u` and `ulimit -v` show the limits\n"))

    def test_those_of_openvdb(self):
        """TBB would end the program by a signal where it cannot start one."""
        self.call("run", self.write(tiny()), "-o", "out", "--progress", "none")
        codes = set()
        for after in (0, 1, 4, 7, 8, 9, 10, 11):
            result = subprocess.run([PROGRAM, "mesh", "out", "--format", "vdb", "--frames", "0:2", "--threads", "4", "--again",
                                     "--progress", "none"], cwd=self.folder, timeout=60, text=True, capture_output=True,
                                    env={**self.environment(),
                                         **self.loaded({"CALL": "pthread_create", "AFTER": after, "ERROR": 11})})
            codes.add(result.returncode)
            if result.returncode == FAILED:
                self.assertRegex(result.stderr, "libgomp: Thread creation failed|cannot start a thread|sessile: cannot make out/surface/"
                                                r"surface_000000\.vdb: .*; `--threads 1` takes fewer, ")
                self.assertEqual([name for name in self.names("out/surface") if name.endswith(".part")], [])
        self.assertEqual(codes, {DONE, FAILED})

    def test_a_small_stack(self):
        name = self.write(larger())
        code, _ = self.attempt(name, "--threads", "2", before="ulimit -s 256")
        self.assertEqual(code, DONE)
        _, err = self.call("run", name, "-o", "out", code=BAD_INPUT, before="ulimit -s 128")
        self.assertEqual(err, "sessile: the stack is limited to 128 KiB, which is too little; `ulimit -s 8192` gives enough\n")


class Streams(Limits):
    def test_closed_ones_do_not_become_files(self):
        for closed in (">&-", "2>&-", ">&- 2>&-", "<&- >&- 2>&-"):
            with self.subTest(closed):
                for style in ("plain", "json"):
                    self.call("run", self.write(tiny(**WARNING)), "-o", "out", "--progress", style, before="exec " + closed)
                    self.expect_good_results("out", "done")
                    text = (self.folder / "out/stats.csv").read_text()
                    self.assertNotIn("warning", text)
                    self.assertEqual(text.count("\n"), 6)


if __name__ == "__main__":
    unittest.main()
