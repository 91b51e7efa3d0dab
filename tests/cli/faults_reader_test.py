"""Somebody opens every file of a run as it appears: each is whole at once, and stays as it is."""
import csv
import json
import time

from frames import read_ply, read_pvd, read_vtp
from sessile_cli import CliTest, DONE, tiny, unittest

GROWING = {"stats.csv", "frames.pvd", "surface.pvd", "surface.json", "summary.json", "scene.json"}


class Reader(CliTest):
    def look(self, root, seen):
        """Opens what is new, and what grows."""
        for path in sorted(root.rglob("*")):
            if path.name.startswith(".") or (path in seen and path.name not in GROWING) or not path.is_file():
                continue
            try:
                bytes_now = path.read_bytes()
            except FileNotFoundError:
                continue  # a checkpoint that a newer one replaced
            if path.name == "stats.csv":
                self.expect_whole_lines(bytes_now, seen.get(path, b""))
            elif path.suffix == ".json":
                json.loads(bytes_now)
            elif path.name == "frames.pvd":
                listed = read_pvd(path)
                for moment, name in listed:
                    self.assertEqual(read_vtp(root / name)[2], moment)
            elif path.parent == root and path.suffix == ".vtp":
                read_vtp(path)
            elif path.parent == root and path.suffix == ".ply":
                read_ply(path)
            seen[path] = bytes_now

    def expect_whole_lines(self, text, before):
        self.assertTrue(text.startswith(before), "lines changed that had been written")
        lines = text.decode().split("\n")[:-1]  # one that has no end is not written yet
        self.assertLessEqual(len({len(row) for row in csv.reader(lines)}), 1)

    def test_of_a_run(self):
        scene = tiny(time={"end": 1.5, "fixed_dt": 0.005},
                     output={"frame_interval": 0.01, "stats_interval": 0.005, "formats": ["vtp", "ply"],
                             "surface": {"formats": ["ply", "vtp", "usda"]}, "checkpoint": {"interval": 0.05, "keep": 2}})
        process = self.start("run", self.write(scene), "-o", "out", "--progress", "none")
        seen, looks = {}, 0
        until = time.monotonic() + 60
        while process.poll() is None:
            self.assertLess(time.monotonic(), until)
            if (self.folder / "out").exists():
                self.look(self.folder / "out", seen)
                looks += 1
        self.assertEqual(process.returncode, DONE)
        early = set(seen)
        self.look(self.folder / "out", seen)
        self.assertGreater(looks, 3)
        self.assertGreater(len(early), 50)
        checked = 0
        for path in early:
            if path.name.startswith("checkpoint_"):
                (self.folder / "seen").write_bytes(seen[path])
                self.assertIn("a whole checkpoint", self.call("check", "seen")[0])
            elif path.name not in GROWING:
                self.assertEqual(path.read_bytes(), seen[path], f"{path.name} was opened before it was whole")
                checked += 1
        self.assertGreater(checked, 50)


if __name__ == "__main__":
    unittest.main()
