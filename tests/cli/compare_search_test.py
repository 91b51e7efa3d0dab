"""`sessile compare --search-dt`: the largest time step at which a method stays sound."""
import re

from compare_cli import CompareTest
from sessile_cli import tiny, unittest


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
                self.assertEqual(names, ["scene.json", "stats.csv", "summary.json", "verdict.json"])
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
        fastest = self.markdown().split("## Fastest sound run of each method")[1].split("\n## ")[0]
        lines = [line for line in fastest.splitlines() if line.startswith(("| nothing |", "| under\\_score |"))]
        self.assertEqual(len(lines), 2, fastest)
        self.assertTrue(lines[0].endswith("| 1.00 |"), lines[0])
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


if __name__ == "__main__":
    unittest.main()
