"""One program for several instruction sets: which runs, who decides, and that they compute the same."""
import collections
import csv
import pathlib
import re
import shutil
import time

from frames import read_positions
from sessile_cli import INTERRUPTED, PROGRAM, VARIANTS, CliTest, signal, tiny, unittest

NAMES = ["x86-64-v4", "x86-64-v3", "x86-64"]
EPSILON = 2.0 ** -23  # distance of 1 to the next float


def unit(column):
    """The unit in a column's name, or nothing."""
    found = re.search(r"\[(.*)\]", column)
    return found.group(1) if found else ""


class InstructionSets(CliTest):
    def setUp(self):
        super().setUp()
        if not VARIANTS:
            self.skipTest("built for one instruction set")
        self.program = PROGRAM
        self.changes = {"SESSILE_ISA": None}

    def environment(self):
        """The changes over the usual environment; None takes a variable out."""
        all_set = {**super().environment(), **self.changes}
        return {name: value for name, value in all_set.items() if value is not None}

    def info(self, **changes):
        self.changes = {"SESSILE_ISA": None, **changes}
        out, err = self.call("info", program=self.program)
        self.assertEqual(err, "")
        return dict(re.split(" +", line, maxsplit=1) for line in out.splitlines())

    def running(self, **changes):
        return self.info(**changes)["SIMD"].split()[0]

    def there(self):
        """Those that are installed and that this processor runs, the best first."""
        return [name for name in self.info()["variants"].split(", ") if " " not in name]

    def copied(self):
        """The program and its variants in a folder of their own."""
        place = self.folder / "place"
        for path in ["bin/sessile", *(f"lib/sessile/{name}/sessile" for name in NAMES[:-1])]:
            (place / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(pathlib.Path(PROGRAM).parent.parent / path, place / path)
        self.program = str(place / "bin/sessile")
        return place / "lib/sessile"


class Choice(InstructionSets):
    def test_all_are_installed(self):
        self.assertEqual([name.split()[0] for name in self.info()["variants"].split(", ")], NAMES)

    def test_the_best_runs_unless_another_is_named(self):
        there = self.there()
        self.assertEqual(there[-1], "x86-64")
        self.assertEqual(self.running(), there[0])
        self.assertEqual(self.running(SESSILE_ISA=""), there[0])
        lanes = {"x86-64-v4": 16, "x86-64-v3": 8, "x86-64": 4}
        for name in there:
            with self.subTest(name):
                info = self.info(SESSILE_ISA=name)
                self.assertRegex(info["SIMD"], rf"^{name} \(\S+\), {lanes[name]} lanes$")
                self.assertEqual(info["variants"], self.info()["variants"])

    def test_what_cannot_be_had_is_refused(self):
        valid = ", ".join(self.there())
        for wish in ("avx2", "x86-64-v2", "X86-64", " "):
            self.changes = {"SESSILE_ISA": wish}
            for arguments in (["info"], ["run", "s.json"], []):
                self.assertEqual(self.refused(*arguments),
                                 [f'SESSILE_ISA: unknown instruction set "{wish}" (valid instruction sets: {valid})'])

    def test_what_is_missing_is_done_without(self):
        lib = self.copied()
        there = self.there()
        self.assertEqual(self.running(), there[0])
        for k, name in enumerate(there[:-1]):
            (lib / name / "sessile").unlink()
            self.assertEqual(self.running(), there[k + 1])
            self.assertNotIn(name, self.there())
            self.changes = {"SESSILE_ISA": name}
            out, err = self.call("info", code=2, program=self.program)
            self.assertEqual((out, err), ("", f"SESSILE_ISA: {name} is not installed "
                                              f"(valid instruction sets: {', '.join(there[k + 1:])})\n"))

    def test_what_does_not_start_is_done_without(self):
        lib = self.copied()
        there = self.there()
        for name in there[:-1]:
            (lib / name / "sessile").write_bytes(b"no program")
        self.assertEqual(self.running(), "x86-64")

    def test_one_in_anothers_place_does_not_go_round_in_circles(self):
        lib = self.copied()
        for name in self.there()[:-1]:
            shutil.copy2(PROGRAM, lib / name / "sessile")
            self.changes = {"SESSILE_ISA": name}
            self.call("info", code=2, program=self.program)
        self.assertEqual(self.running(), "x86-64")

    def test_a_variant_called_by_itself_is_what_it_is(self):
        lib = pathlib.Path(PROGRAM).parent.parent / "lib/sessile"
        there = self.there()
        for name in there[:-1]:
            self.program = str(lib / name / "sessile")
            self.assertEqual(self.running(), name)
            self.assertEqual(self.running(OMP_WAIT_POLICY=None, GOMP_SPINCOUNT=None), name)
            self.changes = {"SESSILE_ISA": there[-1]}
            self.call("info", code=2, program=self.program)


class Start(InstructionSets):
    """What the new start must leave as it was."""

    FREE = {"OMP_WAIT_POLICY": None, "GOMP_SPINCOUNT": None}

    def test_with_and_without_a_choice_of_waiting(self):
        for waiting in ({}, self.FREE, {**self.FREE, "GOMP_SPINCOUNT": "7"}):
            for name in self.there():
                self.assertEqual(self.running(SESSILE_ISA=name, **waiting), name)
            self.assertEqual(self.running(**waiting), self.there()[0])

    def test_leaves_process_and_environment_as_they_were(self):
        scene = self.write(tiny(time={"end": 1000, "fixed_dt": 0.005}))
        wishes = [None, *self.there()]
        for number, (waiting, wish) in enumerate([(w, name) for w in ({}, self.FREE) for name in wishes]):
            self.changes = {"SESSILE_ISA": wish, **waiting}
            given = self.environment()
            if waiting:
                given.update(OMP_WAIT_POLICY="passive", GOMP_SPINCOUNT="1000")
            process = self.start("run", scene, "-o", f"out{number}", "--progress", "none")
            until = time.monotonic() + 60
            while not (self.folder / f"out{number}/frame_000001.vtp").exists() and time.monotonic() < until:
                time.sleep(0.01)
            raw = pathlib.Path(f"/proc/{process.pid}/environ").read_bytes()
            command = pathlib.Path(f"/proc/{process.pid}/cmdline").read_bytes()
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=60)
            self.assertEqual(process.returncode, INTERRUPTED)
            self.assertEqual(dict(entry.split("=", 1) for entry in raw.decode().rstrip("\0").split("\0")), given)
            self.assertEqual(command.decode().split("\0")[0], PROGRAM)

    def test_finds_its_methods(self):
        scene = self.write(tiny())
        for name in self.there():
            self.changes = {"SESSILE_ISA": name}
            _, err = self.call("compare", scene, "--methods", "no_such_method", code=2)
            self.assertRegex(err, "found: .*paper")

    def test_a_link_to_the_program_will_do(self):
        link = self.folder / "liquid"
        link.symlink_to(PROGRAM)
        best = self.there()[0]
        self.program = str(link)
        self.assertEqual(self.running(), best)


class SameResults(InstructionSets):
    """Lanes add up in another order, and fused operations round once instead of twice: results differ by rounding, which
    grows from step to step. The scene is deaf to all else: fixed steps, and a fixed number of iterations."""

    SCENE = tiny(
        spacing=0.1, time={"end": 0.04, "fixed_dt": 0.002},
        pressure={"type": "iisph", "error": 1e-9, "min_iterations": 6, "max_iterations": 6},
        bodies=[{"label": "block", "shape": {"type": "box", "size": [0.7, 0.7, 0.7]}, "jitter": 0.1,
                 "spin": [1, 2, 3], "velocity": [0, 0, -1], "placement": {"position": [0, 0, 0.44]}}],
        output={"frame_interval": 0.02, "stats_interval": 0, "formats": ["ply"]})

    def run_with(self, name, iteration):
        self.changes = {"SESSILE_ISA": name}
        self.call("run", self.write(self.SCENE), "-o", name, "--progress", "none", "--set", f"pressure.iteration={iteration}")
        with open(self.folder / name / "stats.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        return rows, [read_positions(self.folder / name / f"frame_{k:06d}.ply") for k in range(3)]

    def test_all_compute_the_same(self):
        self.compare("jacobi", 10)

    def test_conjugate_directions_too(self):
        """Each of them divides by what the one before left over: rounding grows faster."""
        self.compare("conjugate", 300)

    def compare(self, iteration, roundings):
        names = self.there()
        rows, frames = self.run_with(names[-1], iteration)
        self.assertEqual((len(rows), len(frames[0])), (21, 343))
        moved = max(abs(a - b) for i in frames[0] for a, b in zip(frames[0][i], frames[-1][i]))
        self.assertGreater(moved, 0.01)

        # Sums cancel: what counts is the size of their terms, here the greatest number with the same unit. Densities
        # (relative to rest density), and lengths in m or dx, are of order 1.
        scales = collections.defaultdict(lambda: 1.0)
        for row in rows:
            for key, cell in row.items():
                if unit(key) in ("J", "N", "N m", "kg m/s", "m/s"):
                    scales[unit(key)] = max(scales[unit(key)], abs(float(cell)))
        for name in names[:-1]:
            other_rows, other_frames = self.run_with(name, iteration)
            for row, other in zip(rows, other_rows, strict=True):
                allowed = roundings * EPSILON * (1 + int(row["step"]))
                # Pressures come from densities less 1, some hundredths, whose rounding they multiply.
                pushed = {"N": 10, "N m": 10}
                for key, cell in row.items():
                    if key in ("bound", "overruled"):
                        self.assertEqual(other[key], cell)
                    else:
                        self.assertAlmostEqual(float(other[key]), float(cell), delta=allowed * scales[unit(key)] * pushed.get(unit(key), 1),
                                               msg=f"{name}, step {row['step']}, {key}")
            for k, (frame, other) in enumerate(zip(frames, other_frames, strict=True)):
                self.assertEqual(frame.keys(), other.keys())
                for i in frame:
                    for a, b in zip(frame[i], other[i]):
                        self.assertAlmostEqual(a, b, delta=EPSILON * (1 + roundings * k), msg=f"{name}, frame {k}, particle {i}")


if __name__ == "__main__":
    unittest.main()
