"""tools/sweep.py: a comparison for every combination of values, and a table of the verdicts."""
import pathlib
import subprocess
import sys
import unittest

from compare_cli import CompareTest
from sessile_cli import PROGRAM, tiny

SWEEP = pathlib.Path(__file__).resolve().parents[2] / "tools" / "sweep.py"


class Sweep(CompareTest):
    def sweep(self, *arguments, code=0):
        result = subprocess.run([sys.executable, "-B", SWEEP, self.write(tiny()), "--sessile", PROGRAM, *arguments],
                                cwd=self.folder, env=self.environment(), text=True, capture_output=True, timeout=120)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        return result.stdout, result.stderr

    def test_makes_a_line_for_every_combination(self):
        self.sweep("--vary", "fluid.viscosity=20,5", "--vary", "bodies[0].placement.position[2]=0.5,0.7", "-o", "out",
                   "--", "--methods", "nothing,absurd", "--progress", "none")
        lines = (self.folder / "out/sweep.md").read_text().splitlines()
        self.assertEqual(lines[2], "| fluid.viscosity | bodies[0].placement.position[2] | nothing | absurd |")
        self.assertEqual([line.split(" | ")[:2] for line in lines[4:]],
                         [["| 20", "0.5"], ["| 20", "0.7"], ["| 5", "0.5"], ["| 5", "0.7"]])
        for number, line in enumerate(lines[4:]):
            _, _, nothing, absurd = line.strip("| ").split(" | ")
            self.assertRegex(nothing, r"^sound, [\d.]+ ms on average$")  # no word of a search that was not asked for
            self.assertRegex(absurd, r"^\*\*unsound\*\* at ")
            position = self.summary(f"out/{number}/nothing")["scene"]["bodies"][0]["placement"]["position"]
            self.assertEqual(position[2], (0.5, 0.7)[number % 2])

    def test_says_what_search_found(self):
        self.sweep("--vary", "fluid.viscosity=20", "-o", "out", "--", "--methods", "nothing", "--search-dt",
                   "--search-max", "0.01", "--progress", "none")
        self.assertRegex((self.folder / "out/sweep.md").read_text(), r"; fixed up to [\d.]+ ms \|")

    def test_a_wrong_call_ends_it(self):
        _, err = self.sweep("--vary", "fluid.viscosity", "-o", "out", "--", "--methods", "nothing", code=2)
        self.assertIn("is not PATH=VALUE", err)
        _, err = self.sweep("--vary", "fluid.viscosity=-1", "-o", "out", "--", "--methods", "nothing", code=1)
        self.assertIn("fluid.viscosity", err)
        self.assertIn("exit code 2", err)


if __name__ == "__main__":
    unittest.main()
