"""What the tests of `sessile compare` share: methods, ways to call it and to read its report."""
import csv
import json

from sessile_cli import CliTest, DONE, tiny

NONE = {"title": "nothing", "pressure": {"type": "iisph"}, "forces": []}
STRONG = {"title": "tension", "pressure": {"type": "iisph"}, "forces": [{"type": "surface_feature"}]}
ABSURD = {"title": "too much", "pressure": {"type": "iisph"},
          "forces": [{"type": "surface_feature", "cohesion": 1e300, "area_minimisation": 1e300}]}


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
