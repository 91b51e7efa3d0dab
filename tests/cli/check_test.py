"""`sessile check`: the resolved scene as a table and as JSON."""
import json
import pathlib

from sessile_cli import CliTest, tiny, unittest

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"


class Check(CliTest):
    def table(self, *arguments):
        """{path: (rest of the line)} of the parameters, and the text of what is derived."""
        out, err = self.call("check", *arguments)
        self.assertEqual(err, "")
        parameters, derived = out.split("\nderived\n")
        return {line.split()[0]: " ".join(line.split()[1:]) for line in parameters.splitlines()}, derived

    def test_says_what_is_given_and_what_is_default(self):
        table, _ = self.table(self.write(tiny()))
        self.assertEqual(table["spacing"], "0.1 given m")
        self.assertEqual(table["support"], "2 default")
        self.assertEqual(table["gravity"], "[0, 0, -9.81] default m/s^2")
        self.assertEqual(table["fluid.viscosity"], "20 given Pa s")
        self.assertEqual(table["bodies[0].shape.size"], "[0.3, 0.3, 0.3] given m")
        self.assertEqual(table["solids[0].spacing"], "(the particle spacing) default")
        self.assertEqual(table["emitters"], "(none) default")
        self.assertEqual(table["output.formats"], '["vtp", "ply"] given')

    def test_shows_overrides(self):
        table, _ = self.table(self.write(tiny()), "--set", "fluid.viscosity=5", "--set", "time.fixed_dt=null",
                              "--set", "bodies[0].label=drop")
        self.assertEqual(table["fluid.viscosity"], "5 given Pa s")
        self.assertTrue(table["time.fixed_dt"].startswith("(adaptive, from the bounds below)"))
        self.assertEqual(table["bodies[0].label"], '"drop" given')

    def test_derives(self):
        _, derived = self.table(self.write(tiny()))
        self.assertRegex(derived, r"particles at the start +27\n")
        self.assertRegex(derived, r"boundary particles +121\n")  # 11 by 11 samples
        self.assertRegex(derived, r"support radius +0.2 m\n")
        self.assertRegex(derived, r"particle mass +1 kg\n")
        self.assertRegex(derived, r"memory at the start +\d+\.\d MiB\n")

    def test_writes_nothing(self):
        scene = self.write(tiny())
        self.call("check", scene)
        self.assertEqual([path.name for path in self.folder.iterdir()], [scene])

    def test_reads_comments(self):
        text = json.dumps(tiny(), indent=1).replace('"time"', '// how long\n /* and how */ "time"')
        self.call("check", self.write(text))


class CheckJson(CliTest):
    def resolved(self, *arguments):
        out, err = self.call("check", "--json", *arguments)
        self.assertEqual(err, "")
        return out

    def test_is_itself_a_scene(self):
        first = self.resolved(self.write(tiny()))
        self.assertEqual(self.resolved(self.write(first, "again.json")), first)
        scene = json.loads(first)
        self.assertEqual((scene["spacing"], scene["support"], scene["gravity"]), (0.1, 2, [0, 0, -9.81]))
        self.assertEqual(scene["bodies"][0]["placement"]["position"], [0, 0, 0.5])

    def test_holds_overrides(self):
        scene = json.loads(self.resolved(self.write(tiny()), "--set", "time.end=2.5", "--set", "gravity=[0,1,0]"))
        self.assertEqual((scene["time"]["end"], scene["gravity"]), (2.5, [0, 1, 0]))

    def test_of_every_scene_of_the_project(self):
        paths = sorted(path for path in SCENES.rglob("*.json") if "1m" not in path.name and path.parent.name != "methods")
        self.assertGreaterEqual(len(paths), 4)
        for path in paths:
            with self.subTest(scene=path.name):
                first = self.resolved(path)
                self.assertEqual(self.resolved(self.write(first)), first)


if __name__ == "__main__":
    unittest.main()
