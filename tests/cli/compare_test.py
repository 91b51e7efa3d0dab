"""`sessile compare` end to end: results, report, plots, resuming, methods that fail, the search for a step."""
import collections
import csv
import json
import re
import shutil
import struct
import time
import zlib

from sessile_cli import BAD_INPUT, CliTest, DONE, FAILED, INTERRUPTED, signal, tiny, unittest

PLOTS = ["kinetic_energy", "loose", "wetted_area", "pieces", "nearest_p5", "radius_of_gyration", "held", "particles",
         "out", "max_speed", "density_error", "dt", "iterations"]
COLOURS = [(0x00, 0x72, 0xB2), (0xD5, 0x5E, 0x00), (0x00, 0x9E, 0x73)]

NONE = {"title": "nothing", "pressure": {"type": "iisph"}, "forces": []}
STRONG = {"title": "tension", "pressure": {"type": "iisph"}, "forces": [{"type": "surface_feature"}]}
ABSURD = {"title": "too much", "pressure": {"type": "iisph"},
          "forces": [{"type": "surface_feature", "cohesion": 1e300, "area_minimisation": 1e300}]}


def unfilter(kind, line, above, channels):
    """Takes back PNG's filter of a line."""
    if kind == 2:
        line[:] = bytes((a + b) & 255 for a, b in zip(line, above))
        return
    for x in range(len(line)) if kind else ():
        left, corner = (line[x - channels], above[x - channels]) if x >= channels else (0, 0)
        up, guess = above[x], left + above[x] - corner
        near = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
        line[x] = (line[x] + (0, left, up, (left + up) // 2, near)[kind]) & 255


def pixels(path):
    """The colours of a PNG of 8-bit RGB or RGBA, as a dictionary of how often each stands there."""
    data = path.read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n"), path
    at, packed, width, height, channels = 8, b"", 0, 0, 0
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
            channels = {2: 3, 6: 4}[colour]
            assert depth == 8
        if kind == b"IDAT":
            packed += body
        at += 12 + size
    raw, stride, counts = zlib.decompress(packed), width * channels, collections.Counter()
    previous, colours = bytes(stride), collections.Counter({(0, 0, 0): width})
    for y in range(height):
        kind = raw[y * (stride + 1)]
        line = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        if kind != 2 or any(line):  # else the line above once more
            unfilter(kind, line, previous, channels)
            colours = collections.Counter(zip(*(line[k::channels] for k in range(3))))
            previous = bytes(line)
        counts.update(colours)
    return width, height, counts


class CompareTest(CliTest):
    def setUp(self):
        super().setUp()
        (self.folder / "methods").mkdir()
        for name, method in (("nothing", NONE), ("under_score", STRONG), ("absurd", ABSURD)):
            self.write(method, f"methods/{name}.json")

    def compare(self, methods, *options, scene=None, code=DONE, **more):
        return self.call("compare", self.write(scene or tiny()), "--methods", methods, "-o", "out", "--progress", "none",
                         *options, code=code, **more)

    def report(self):
        return json.loads((self.folder / "out/comparison.json").read_text())

    def rows(self):
        with open(self.folder / "out/comparison.csv", newline="") as file:
            return list(csv.DictReader(file))

    def markdown(self):
        return (self.folder / "out/comparison.md").read_text()


class Results(CompareTest):
    def test_everything_is_there(self):
        out, err = self.compare("nothing,under_score")
        self.assertEqual(err, "")
        self.assertRegex(out, r"\Anothing: done, [\d.]+ s, sound\nunder_score: done, [\d.]+ s, (un)?sound.*\n"
                              r"comparison.md, comparison.csv, comparison.json and plots are in out\n\Z")
        self.assertEqual(self.names("out"), ["comparison.csv", "comparison.json", "comparison.md", "nothing", "plots",
                                             "under_score"])
        self.call("run", "s.json", "-o", "alone", "--progress", "none")
        self.assertEqual(self.names("out/under_score"), sorted(self.names("alone") + ["verdict.json"]))
        # tiny() has the forces of under_score itself: the very same run.
        for name in self.names("alone"):
            if name != "summary.json":
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
        # Lines that part: else the first would lie beneath the second but in the legend.
        self.compare("nothing,under_score,mine/it's {odd}.json", scene=tiny(time={"end": 0.3, "fixed_dt": 0.005}),
                     before="mkdir mine; cp methods/under_score.json \"mine/it's {odd}.json\"")
        plots = self.folder / "out/plots"
        self.assertEqual(self.names("out/plots"),
                         sorted(["comparison.gp"] + [f"{name}.{kind}" for name in PLOTS for kind in ("png", "svg")]))
        for name in PLOTS:
            width, height, counts = pixels(plots / f"{name}.png")
            self.assertEqual((width, height), (1200, 700))
            for colour in COLOURS:
                self.assertGreater(counts.get(colour, 0), 30, f"{name}: no line in {colour}")
            svg = (plots / f"{name}.svg").read_text()
            self.assertTrue(svg.startswith("<?xml"))
            self.assertIn("under_score", svg)
            self.assertIn("it's {odd}", svg.replace("&#39;", "'").replace("&apos;", "'"))
        lines = pixels(plots / "kinetic_energy.png")[2]
        self.assertGreater(lines[COLOURS[0]], 500, "a legend, but no line")

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
        self.assertRegex(err, r"\Asessile: cannot write out/nothing/\S+: File too large\n\Z")


class Resuming(CompareTest):
    def without_times(self, value):
        if isinstance(value, dict):
            return {k: self.without_times(v) for k, v in value.items()
                    if not k.endswith("_time_s") or k in ("simulated_time_s", "verdict_time_s")}
        return [self.without_times(v) for v in value] if isinstance(value, list) else value

    def test_after_an_interruption(self):
        # The second method works long, so that the signal meets it.
        slow = tiny(time={"end": 6, "fixed_dt": 0.002}, output={"frame_interval": 0.5, "stats_interval": 0.002})
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


class Search(CompareTest):
    SCENE = {"time": {"end": 0.3, "dt_max": 0.004, "dt_min": 5e-4}, "output": {"frame_interval": 0.1, "formats": ["vtp"]}}

    def test_finds_the_largest_step(self):
        # Falling freely, this block is sound at any step; at the floor it would be thrown off by the long ones.
        out, _ = self.compare("nothing,under_score", "--search-dt", "--search-max", "0.1",
                              scene=tiny(**self.SCENE))
        for method in self.report()["methods"]:
            self.assertTrue(method["searched"])
            trials = {trial["dt_s"]: trial["sound"] for trial in method["trials"]}
            self.assertEqual(len(trials), len(method["trials"]), "a step was tried twice")
            sound = [dt for dt in trials if trials[dt]]
            unsound = [dt for dt in trials if not trials[dt]]
            self.assertTrue(sound and unsound, trials)
            self.assertEqual(method["largest_sound_dt_s"], max(sound))
            self.assertLess(max(sound), min(unsound))
            self.assertLess(min(unsound), 1.3 * max(sound), "they are not neighbours")
            for trial in method["trials"]:
                names = self.names("out/" + trial["folder"])
                self.assertEqual(names, ["stats.csv", "summary.json", "verdict.json"])
                self.assertTrue(trial["sound"] or trial["reason"])
                self.assertIn(f"({trial['folder']})", self.markdown())
                steps = self.summary("out/" + trial["folder"])
                self.assertEqual(steps["scene"]["time"]["fixed_dt"], trial["dt_s"])
                self.assertEqual(trial["folder"], f"{method['name']}/dt_{trial['dt_s']:g}")
            run = method["runs"][1]
            self.assertEqual((run["step"], run["sound"], run["dt_greatest_s"]),
                             ("largest fixed", True, method["largest_sound_dt_s"]))
            self.assertIn(f"{1e3 * method['largest_sound_dt_s']:g} ms", self.markdown())
        self.assertEqual([r["step"] for r in self.rows()], ["adaptive", "largest fixed"] * 2)
        before = self.report()
        out, _ = self.compare("nothing,under_score", "--search-dt", "--search-max", "0.1", scene=tiny(**self.SCENE))
        self.assertEqual(len(re.findall("already", out)), out.count("\n") - 1)
        self.assertEqual(before, self.report())

    def test_short_trials_are_confirmed_to_the_end(self):
        # In the air every step is sound; only the floor, after the trials' end, tells them apart.
        self.compare("nothing", "--search-dt", "--search-until", "0.05", "--search-max", "0.05", scene=tiny(**self.SCENE))
        method = self.report()["methods"][0]
        short = [t for t in method["trials"] if not t["to_the_end"]]
        whole = [t for t in method["trials"] if t["to_the_end"]]
        self.assertEqual(max(t["dt_s"] for t in short if t["sound"]), 0.05)
        self.assertEqual(whole[0]["dt_s"], 0.05)
        self.assertGreater(len(whole), 1)
        self.assertEqual([t["sound"] for t in whole], [False] * (len(whole) - 1) + [True])
        self.assertEqual(method["largest_sound_dt_s"], whole[-1]["dt_s"])
        self.assertGreaterEqual(method["runs"][1]["simulated_time_s"], 0.3 - 1e-6)
        self.assertTrue(all(t["folder"].endswith("_full") for t in whole))


class Refused(CompareTest):
    def expect(self, lines, methods, *options, scene=None):
        with self.subTest(methods=methods, options=options):
            got = self.refused("compare", self.write(scene or tiny()), "--methods", methods, "-o", "out", *options)
            self.assertEqual(got, lines)

    def test_methods(self):
        got = self.refused("compare", self.write(tiny()), "--methods", "under_scor,nothing,xyzzy")
        self.assertRegex(got[0], r'^--methods: unknown method "under_scor", did you mean "under_score"\? \(found: .*under_score')
        self.assertRegex(got[1], r'^--methods: unknown method "xyzzy" \(found: absurd, .*none, .*paper.*under_score')
        self.assertEqual(len(got), 2)
        self.expect(['--methods: two methods are called "nothing"'], "nothing,methods/nothing.json")
        self.expect(["--methods: expected names between commas, such as none,paper"], "nothing,")
        (self.folder / "plots.json").write_text(json.dumps(NONE))
        self.expect(['--methods: "plots.json" has the name of a part of the report'], "plots.json")
        got = self.refused("compare", "s.json", "--methods", "./missing.json")
        self.assertRegex(got[0], r"^\./missing\.json")

    def test_faults_of_methods_and_scenes_come_all_at_once(self):
        self.write('{"pressure": {"type": "iisph"},\n"forces": [{"type": "surface_feature", "cohesio": 1}]}', "a.json")
        self.write('{"pressure": {"type": "iisph", "min_iterations": 9,\n"max_iterations": 3}}', "b.json")
        self.expect(['a.json:2: forces[0].cohesio: unknown key (did you mean "cohesion"?)',
                     'b.json:1: pressure.min_iterations: 9 is more than pressure.max_iterations, 3 (with the method "b")'],
                    "a.json,nothing,b.json")

    def test_what_a_scene_writes_must_exist_under_every_method(self):
        scene = tiny(output={"fields": ["acceleration_surface_feature"]})
        got = self.refused("compare", self.write(scene), "--methods", "under_score,nothing")
        self.assertRegex(got[0], r'^s\.json:1: output\.fields\[0\]: unknown field .* \(with the method "nothing"\)$')

    def test_overlaps(self):
        body = {"shape": {"type": "box", "size": [0.3, 0.3, 0.3]}, "placement": {"position": [0, 0, 0.5]}}
        got = self.refused("compare", self.write(tiny(bodies=[body, body])), "--methods", "nothing", "-o", "out")
        self.assertIn("overlap", got[0])

    def test_overrides_of_what_methods_decide(self):
        self.expect(["--set forces[0].cohesion: the methods decide on forces; write a method's file of your own",
                     "--set pressure.error: the methods decide on pressure; write a method's file of your own"],
                    "nothing", "--set", "forces[0].cohesion=1", "--set", "time.end=1", "--set", "pressure.error=1")

    def test_usage(self):
        scene = self.write(tiny())
        more = "Run with --help for more information."
        self.assertEqual(self.refused("compare", scene), ["--methods is required", more])
        self.assertEqual(self.refused("compare", scene, "--methods", "nothing", "--search-until", "1"),
                         ["--search-until requires --search-dt", more])
        self.assertEqual(self.refused("compare", scene, "--methods", "nothing", "--search-dt", "--search-max", "0"),
                         ["--search-max: must be above 0 s, found 0", more])
        self.expect(["--search-max: 1e-09 s is below time.dt_min, 1e-06 s"], "nothing", "--search-dt", "--search-max", "1e-9")


if __name__ == "__main__":
    unittest.main()
