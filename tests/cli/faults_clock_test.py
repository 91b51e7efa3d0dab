"""A clock of the day that jumps by an hour at every look: nothing is measured or scheduled by it."""
import datetime
import json

from sessile_cli import CliTest, tiny, unittest


class Clock(CliTest):
    def jumping(self):
        return {"CALL": "clock", "NOTE": self.folder / "waits"}

    def test_a_run(self):
        scene = tiny(time={"end": 0.2, "fixed_dt": 0.005},
                     output={"frame_interval": 0.01, "surface": {"formats": ["ply"]}, "checkpoint": {"minutes": 0.001}})
        self.call("run", self.write(scene), "-o", "straight", "--progress", "none")
        out, _ = self.call("run", "s.json", "-o", "out", "--progress", "json", faults=self.jumping())
        self.assertFalse((self.folder / "waits").exists(), "something waits by the clock of the day")
        for name in self.names("straight"):
            if (self.folder / "straight" / name).is_file() and name != "summary.json":
                self.assertEqual((self.folder / "straight" / name).read_bytes(), (self.folder / "out" / name).read_bytes(), name)
        # An hour either way would show in any of these.
        for stage, seconds in self.summary()["wall_time_s"].items():
            self.assertTrue(0 <= seconds < 600, f"{stage}: {seconds} s")
        for line in map(json.loads, out.splitlines()):
            self.assertTrue(0 <= line["seconds_left"] < 600, line)
            self.assertTrue(0 <= line["steps_per_second"], line)

    def test_the_library_of_faults_moves_the_clock(self):
        """Otherwise the test above could not fail: `bench` stamps its report by the clock of the day."""
        self.call("bench", "--case", "neighbors", "--particles", "1000", "--json", "b.json", faults=self.jumping())
        stamp = datetime.datetime.fromisoformat(json.loads((self.folder / "b.json").read_text())["date"].rstrip("Z"))
        away = abs(datetime.datetime.utcnow() - stamp).total_seconds()
        self.assertTrue(3000 < away < 4200, f"{away} s")

    def test_mesh(self):
        self.call("run", self.write(tiny()), "-o", "out", "--progress", "none")
        out, _ = self.call("mesh", "out", "--progress", "json", faults=self.jumping())
        self.assertFalse((self.folder / "waits").exists())
        for line in map(json.loads, out.splitlines()):
            self.assertTrue(0 <= line["seconds_left"] < 600, line)


if __name__ == "__main__":
    unittest.main()
