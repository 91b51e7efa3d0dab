"""What `sessile compare` refuses before anything runs."""
import json

from compare_cli import NONE, CompareTest
from sessile_cli import tiny, unittest


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
