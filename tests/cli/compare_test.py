"""`sessile compare` end to end: results, report, plots, resuming, methods that fail."""
import csv
import json
import re
import shutil
import time

from compare_cli import NONE, STRONG, CompareTest
from png import pixels, unpacked
from sessile_cli import FAILED, INTERRUPTED, signal, tiny, unittest

PLOTS = ["kinetic_energy", "loose", "wetted_area", "pieces", "nearest_p5", "radius_of_gyration", "held", "particles",
         "out", "max_speed", "density_error", "dt", "iterations"]
COLOURS = [(0x00, 0x72, 0xB2), (0xD5, 0x5E, 0x00), (0x00, 0x9E, 0x73)]


class Results(CompareTest):
    def test_everything_is_there(self):
        out, err = self.compare("nothing,under_score")
        self.assertEqual(err, "")
        self.assertRegex(out, r"\Anothing: done, [\d.]+ s, sound\nunder_score: done, [\d.]+ s, (un)?sound.*\n"
                              r"comparison.md, comparison.csv, comparison.json and plots are in out\n\Z")
        self.assertEqual(self.names("out"), ["comparison.csv", "comparison.json", "comparison.md", "nothing", "plots",
                                             "under_score"])
        self.call("run", "s.json", "-o", "alone", "--progress", "none")
        self.assertEqual(self.names("out/under_score"), sorted(set(self.names("alone")) - {"checkpoints"} | {"verdict.json"}))
        # tiny() has the forces of under_score itself: the very same run.
        for name in self.names("alone"):
            if name not in ("summary.json", "checkpoints"):
                self.assertEqual((self.folder / "alone" / name).read_bytes(),
                                 (self.folder / "out/under_score" / name).read_bytes(), name)
        self.assertEqual(self.summary("out/nothing")["scene"]["forces"], [])
        verdict = json.loads((self.folder / "out/nothing/verdict.json").read_text())
        self.assertEqual((verdict["status"], verdict["sound"], verdict["steps"], verdict["particles"]),
                         ("done", True, 8, 27))
        self.assertEqual(verdict["scene"], self.summary("out/nothing")["scene"])

    def test_the_report_tells_the_same_everywhere(self):
        self.compare("nothing,under_score")
        report, rows, markdown = self.report(), self.rows(), self.markdown()
        self.assertEqual([m["name"] for m in report["methods"]], ["nothing", "under_score"])
        self.assertEqual([(r["method"], r["step"]) for r in rows], [("nothing", "fixed"), ("under_score", "fixed")])
        for method, row in zip(report["methods"], rows):
            run = method["runs"][0]
            with open(self.folder / "out" / method["name"] / "stats.csv", newline="") as file:
                stats = list(csv.DictReader(file))
            self.assertEqual(run["outcome"]["kinetic_energy"]["final"], float(stats[-1]["kinetic_energy [J]"]))
            self.assertEqual(run["outcome"]["kinetic_energy"]["greatest"],
                             max(float(line["kinetic_energy [J]"]) for line in stats))
            self.assertEqual(run["outcome"]["nearest_p5"]["least"], min(float(line["nearest_p5 [dx]"]) for line in stats))
            self.assertEqual(float(row["kinetic_energy_final [J]"]), run["outcome"]["kinetic_energy"]["final"])
            self.assertAlmostEqual(run["density_error"],
                                   sum(float(line["density_error"]) for line in stats[1:]) / (len(stats) - 1), places=12)
            self.assertEqual(run["dt_mean_s"], float(row["dt_mean_s"]))
            self.assertIn("out of the domain", markdown)
            self.assertEqual(method["scene"]["pressure"]["type"], "iisph")
        self.assertIn("| under\\_score | fixed |", markdown)
        self.assertIn("![Kinetic energy](plots/kinetic_energy.png)", markdown)
        self.assertEqual(float(rows[0]["factor_to_first"]), 1)
        for link in re.findall(r"\]\((.*?)\)", markdown):
            self.assertTrue((self.folder / "out" / link).exists(), link)

    def test_time_to_rest(self):
        # The block falls out of the domain, and nothing moves any more. Before it does, it only gets faster.
        scene = tiny(solids=[], time={"end": 0.5, "fixed_dt": 0.005}, domain={"min": [-1, -1, 0], "max": [1, 1, 1]})
        self.compare("nothing", scene=scene)
        with open(self.folder / "out/nothing/stats.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        empty = [float(row["time [s]"]) for row in rows if row["particles"] == "0"]
        outcome = self.report()["methods"][0]["runs"][0]["outcome"]
        self.assertEqual(outcome["time_to_rest_s"], empty[0])
        self.assertEqual((outcome["out"]["final"], outcome["particles"]["greatest"]), (27, 27))
        self.assertIn(f"| time to rest | {empty[0]:.4g} s |", self.markdown())
        self.compare("nothing", "--until", "0.2", scene=scene)
        self.assertIsNone(self.report()["methods"][0]["runs"][0]["outcome"]["time_to_rest_s"])
        self.assertIn("| time to rest | not reached |", self.markdown())

    def test_plots(self):
        (self.folder / "mine").mkdir()
        other = {"type": "surface_feature", "cohesion": 20, "adhesion": 0}  # lines that part: none hides another
        self.write({**STRONG, "forces": [other]}, "mine/it's {odd}.json")
        self.compare("nothing,under_score,mine/it's {odd}.json", scene=tiny(time={"end": 0.3, "fixed_dt": 0.005}))
        plots = self.folder / "out/plots"
        self.assertEqual(self.names("out/plots"),
                         sorted(["comparison.gp"] + [f"{name}.{kind}" for name in PLOTS for kind in ("png", "svg")]))
        for name in PLOTS:
            width, height, _, raw = unpacked(plots / f"{name}.png")
            self.assertEqual((width, height), (1200, 700))
            stride = len(raw) // height
            self.assertGreater(len({raw[y * stride:(y + 1) * stride] for y in range(height)}), 50, f"{name} is blank")
            svg = (plots / f"{name}.svg").read_text()
            self.assertTrue(svg.startswith("<?xml"))
            self.assertIn("under_score", svg)
            self.assertIn("it's {odd}", svg.replace("&#39;", "'").replace("&apos;", "'"))
        for name in ("kinetic_energy", "max_speed"):
            counts = pixels(plots / f"{name}.png")
            self.assertGreater(len(counts), 20)
            for colour in COLOURS:  # the legend alone has some 100 pixels of each
                self.assertGreater(counts[colour], 300, f"{name}: no line in {colour}")

    def test_plots_are_not_needed(self):
        (self.folder / "empty").mkdir()
        out, err = self.compare("nothing", before="PATH=$PWD/empty")
        sentence = "there are no plots: gnuplot is not installed; it is in Debian's package gnuplot-nox"
        self.assertEqual(err, f"sessile: {sentence}\n")
        self.assertEqual(self.names("out/plots"), ["comparison.gp"])
        self.assertIn(sentence, self.markdown())
        self.assertEqual(self.report()["plots_trouble"], sentence)
        self.assertEqual(len(self.rows()), 1)

    def test_options_are_those_of_run(self):
        out, err = self.call("compare", self.write(tiny()), "--methods", "nothing", "--until", "0.02", "--set",
                             "fluid.viscosity=3", "--threads", "2", "--progress", "json")
        lines = [json.loads(line) for line in out.splitlines()]
        self.assertEqual({line["run"] for line in lines}, {"nothing"})
        self.assertRegex(lines[-1]["ended"], r"^done, ")
        summary = self.summary("results/s_compared/nothing")
        self.assertEqual((summary["steps"], summary["scene"]["fluid"]["viscosity"]), (4, 3))
        self.assertEqual(json.loads((self.folder / "results/s_compared/comparison.json").read_text())["threads"], 2)

    def test_methods_are_found_above_the_scene_too(self):
        (self.folder / "a/b/methods").mkdir(parents=True)
        scene = self.write(tiny(), "a/b/s.json")
        self.write({**NONE, "title": "nearer"}, "a/b/methods/nothing.json")
        self.call("compare", scene, "--methods", "nothing,under_score,paper_unit", "-o", "out", "--progress", "none")
        self.assertEqual([m["title"] for m in self.report()["methods"]][:2], ["nearer", "tension"])


class Failing(CompareTest):
    def test_a_method_that_fails_leaves_the_others_theirs(self):
        out, err = self.compare("absurd,nothing")
        self.assertRegex(out, r"absurd: failed, .*no finite position.*\nnothing: done, ")
        first, second = self.report()["methods"]
        self.assertEqual((first["runs"][0]["status"], first["runs"][0]["sound"]), ("failed", False))
        self.assertIn("no finite position", first["runs"][0]["reason"])
        self.assertEqual(second["runs"][0]["status"], "done")
        self.assertIn("| absurd | fixed | **failed** |", self.markdown())
        self.assertRegex(self.markdown(), r"\*\*absurd\*\*, fixed: at [\d.e-]+ s \d+ of 27 particles have no finite position")
        self.assertEqual(self.summary("out/absurd")["status"], "failed")
        out, _ = self.compare("absurd,nothing")
        self.assertRegex(out, r"absurd: failed already, .*\nnothing: done already, ")

    def test_no_room_ends_it(self):
        _, err = self.compare("nothing,under_score", code=FAILED, before="ulimit -f 1")
        self.assertRegex(err, r"\Asessile: cannot write out/nothing/\S+: File too large; a limit on the size of files stands in the way .*; what had been written is whole\n")


class Resuming(CompareTest):
    def without_times(self, value):
        if isinstance(value, dict):
            return {k: self.without_times(v) for k, v in value.items()
                    if not k.endswith("_time_s") or k in ("simulated_time_s", "verdict_time_s")}
        return [self.without_times(v) for v in value] if isinstance(value, list) else value

    def test_after_an_interruption(self):
        # The second method works long, so that the signal meets it.
        slow = tiny(time={"end": 12, "fixed_dt": 0.002}, output={"frame_interval": 0.5, "stats_interval": 0.01})
        shutil.copy(self.folder / "methods/nothing.json", self.folder / "methods/third.json")
        process = self.start("compare", self.write(slow), "--methods", "nothing,under_score,third", "-o", "out",
                             "--progress", "none")
        until = time.monotonic() + 60
        while not (self.folder / "out/under_score/stats.csv").exists():
            self.assertIsNone(process.poll(), "it ended by itself")
            self.assertLess(time.monotonic(), until)
            time.sleep(0.005)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, INTERRUPTED, out + err)
        self.assertIn("interrupted; the report tells of what is done, the same command goes on\n", err)
        report = self.report()
        self.assertTrue(report["interrupted"])
        self.assertEqual([[run["status"] for run in m["runs"]] for m in report["methods"]],
                         [["done"], ["interrupted"], []])
        self.assertIn("**third** was not reached", self.markdown())
        self.assertRegex(self.markdown(), r"\*\*under\\_score\*\* was interrupted at [\d.]+ s")
        self.assertEqual(self.summary("out/under_score")["status"], "interrupted")

        before = (self.folder / "out/nothing/summary.json").stat().st_mtime_ns
        out, _ = self.compare("nothing,under_score,third", scene=slow)
        self.assertRegex(out, r"\Anothing: done already, [\d.]+ s, .*\nunder_score: done, .*\nthird: done, ")
        self.assertEqual((self.folder / "out/nothing/summary.json").stat().st_mtime_ns, before)
        resumed = self.report()
        stats = {name: (self.folder / "out" / name / "stats.csv").read_bytes() for name in ("nothing", "under_score")}
        shutil.rmtree(self.folder / "out")
        self.compare("nothing,under_score,third", scene=slow)
        self.assertEqual(self.without_times(resumed), self.without_times(self.report()))
        for name, data in stats.items():
            self.assertEqual((self.folder / "out" / name / "stats.csv").read_bytes(), data)

    def test_another_scene_is_run_anew(self):
        self.compare("nothing,under_score")
        out, _ = self.compare("nothing,under_score", "--set", "fluid.viscosity=21")
        self.assertNotIn("already", out)
        self.write({**NONE, "pressure": {"type": "iisph", "error": 1e-3}}, "methods/nothing.json")
        out, _ = self.compare("nothing,under_score", "--set", "fluid.viscosity=21")
        self.assertRegex(out, r"nothing: done, .*\nunder_score: done already, ")
        (self.folder / "out/under_score/verdict.json").write_text('{"status": "done"}')
        out, _ = self.compare("nothing,under_score", "--set", "fluid.viscosity=21")
        self.assertRegex(out, r"nothing: done already, .*\nunder_score: done, ")




if __name__ == "__main__":
    unittest.main()
