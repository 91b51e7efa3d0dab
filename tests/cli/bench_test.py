"""`sessile bench` at a size that takes a moment. What it measures is never judged here, only what it says of it."""
import json

from sessile_cli import INTERRUPTED, VERSION, CliTest, signal, unittest

TINY = ("--runs", "2", "--particles", "4096")
PASSES = ["density", "normals", "viscosity", "surface_feature", "pressure_coefficients", "pressure_acceleration",
          "pressure_divergence"]


class Measures(CliTest):
    def bench(self, *cases):
        """The figures of some cases by key, and what was printed."""
        names = [word for case in cases for word in ("--case", case)]
        out, err = self.call("bench", *names, *TINY, "--json", "bench.json")
        self.assertEqual(err, "")
        report = json.loads((self.folder / "bench.json").read_text())
        figures = {figure["key"]: figure for figure in report["figures"]}
        self.assertEqual(len(figures), len(report["figures"]), "two figures of one key")
        for key, figure in figures.items():
            with self.subTest(figure=key):
                self.assertLessEqual(figure["min"], figure["median"])
                self.assertLessEqual(figure["median"], figure["max"])
                self.assertEqual((min(figure["samples"]), max(figure["samples"])), (figure["min"], figure["max"]))
                self.assertNotIn("goal", figure, "goals hold at the cases' own sizes")
                self.assertIn(figure["what"].strip(), out)
        self.report = report
        return figures, out

    def test_passes(self):
        figures, out = self.bench("passes")
        self.assertEqual([key for key in figures if key.startswith("passes.")], [f"passes.{name}.4096" for name in PASSES])
        self.assertLess(out.index("What this machine can do"), out.index("Passes over 4096 particles"))
        for name in PASSES:
            figure = figures[f"passes.{name}.4096"]
            self.assertEqual(len(figure["samples"]), 2)
            self.assertTrue(20 < figure["neighbors"] < 34)
            self.assertGreater(figure["median"], 0)
            self.assertIn(figure["bound_by"], ("gathers", "arithmetic", "memory"))
            self.assertAlmostEqual(figure["share"], figure["bound"] / figure["median"])
        for ceiling in ("read.262144", "triad.262144", "gather.2048", "multiply_add"):
            self.assertGreater(figures[f"ceilings.{ceiling}.1"]["median"], 0)
        self.assertNotIn("solver.column_iterations", figures)

    def test_says_where_and_with_what(self):
        self.bench("neighbors")
        self.assertRegex(self.report["date"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$")
        self.assertEqual(self.report["machine"]["threads"], 1)
        self.assertGreater(self.report["machine"]["lanes"], 0)
        self.assertTrue(self.report["machine"]["processor"] and self.report["machine"]["simd"])
        if VERSION:
            self.assertEqual(self.report["program"]["version"], VERSION)

    def test_neighbors(self):
        figures, _ = self.bench("neighbors")
        for sort, build, both in zip(*(figures[f"neighbors.{part}"]["samples"] for part in ("sort", "list", "together"))):
            self.assertAlmostEqual(sort + build, both)
        self.assertTrue(20 < figures["neighbors.count"]["median"] < 34)

    def test_block_by_stage(self):
        figures, out = self.bench("s2_250k")
        parts = [figure for key, figure in figures.items() if key.startswith("s2_250k.stage.")]
        self.assertEqual(len(parts), 7)
        for k, whole in enumerate(figures["s2_250k.ms_per_step"]["samples"]):
            self.assertAlmostEqual(sum(part["samples"][k] for part in parts), whole)
        self.assertGreaterEqual(figures["s2_250k.iterations"]["median"], 2)
        self.assertGreater(figures["s2_250k.bytes_per_particle"]["median"], 100)
        self.assertRegex(out, r"\d{4} particles, \d+ boundary particles\.")

    def test_scaling_and_timers(self):
        figures, out = self.bench("scaling")
        self.assertIn("Threads are not compared: the run has one.", out)
        self.assertIn("scaling.growth", figures)
        self.assertGreater(figures["scaling.timers"]["median"], 0)

    def test_several_cases(self):
        figures, _ = self.bench("solver", "s1")
        self.assertEqual([key for key in figures if not key.startswith("ceilings.")],
                         ["s1.ms_per_step", "solver.column_iterations", "solver.s1_iterations"])
        self.assertGreaterEqual(figures["solver.column_iterations"]["median"], 2)

    def test_threads(self):
        out, _ = self.call("bench", "--case", "neighbors", *TINY, "--threads", "2")
        self.assertRegex(out, r"(?m)^2 threads on ")
        self.assertIn("read in order, 256 KiB, 2 threads", out)


class Refuses(CliTest):
    def test_names(self):
        lines = self.refused("bench", "--case", "s3")
        self.assertEqual(lines[0], '--case: "s3" is no case (cases: s1, s1_fast, s2_250k, s2_1m, neighbors, passes, '
                                   "solver, scaling)")
        self.refused("bench", "--case", "")

    def test_numbers(self):
        self.assertEqual(self.refused("bench", "--runs", "0")[0], "--runs: Value 0 not in range 1 to 1000")
        self.assertEqual(self.refused("bench", "--threads", "x")[0], "--threads: Value x not in range 1 to 1024")
        self.assertEqual(self.refused("bench", "--particles", "10")[0], "--particles: Value 10 not in range 1000 to 10000000")

    def test_a_file_that_cannot_be_written_is_told_before_anything_is_measured(self):
        lines = self.refused("bench", "--case", "passes", "--json", "missing/bench.json")
        self.assertEqual(lines[0], '--json: nothing can be written into "missing"')


class Interrupted(CliTest):
    def test_ends_at_once_and_writes_nothing(self):
        process = self.start("bench", "--case", "scaling", "--particles", "100000", "--runs", "1000", "--json", "b.json")
        for line in process.stdout:
            if line.startswith("What this machine can do"):
                break
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=30)
        self.assertEqual(process.returncode, INTERRUPTED)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
