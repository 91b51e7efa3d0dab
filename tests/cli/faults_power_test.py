"""A power cut: what was told to the disk, and in which order, so that no file is lost that something goes on with."""
import collections

from sessile_cli import CliTest, tiny, unittest

Call = collections.namedtuple("Call", "what path to")


class PowerCut(CliTest):
    def calls(self):
        """What a run did with the files of its folder, in order, with paths from there."""
        output = {"frame_interval": 0.01, "stats_interval": 0.005, "formats": ["vtp", "ply"], "surface": {"formats": ["ply", "usda"]},
                  "checkpoint": {"interval": 0.01, "keep": 1}}
        self.call("run", self.write(tiny(output=output)), "-o", self.folder / "out", "--progress", "none",
                  faults={"CALL": "log", "NOTE": self.folder / "log"})
        calls = []
        root = str(self.folder / "out")
        for line in (self.folder / "log").read_text().splitlines():
            what, path, to = line.split(" ")
            if path.startswith(root):
                calls.append(Call(what, path[len(root):].lstrip("/"), to[len(root):].lstrip("/")))
        return calls

    def test_contents_before_names(self):
        """No name stands for a file whose bytes the disk may not have."""
        unsynced, renamed = set(), 0
        for call in self.calls():
            if call.what == "write":
                unsynced.add(call.path)
            elif call.what == "fsync":
                unsynced.discard(call.path)
            elif call.what == "rename":
                self.assertNotIn(call.path, unsynced)
                renamed += 1
        self.assertGreater(renamed, 15)

    def test_checkpoints(self):
        """A checkpoint gets its name when the disk has all that it goes on with, and replaces one when it has itself."""
        unsynced_names, unsynced_bytes, checkpoints = set(), set(), 0
        for call in self.calls():
            folder = call.to.rpartition("/")[0]
            half = call.path.rpartition("/")[2].startswith(".") and ".usda." not in call.path  # a run goes on with USD's
            if call.what == "write" and not half:
                unsynced_bytes.add(call.path)
            elif call.what == "fsync":
                unsynced_bytes.discard(call.path)
                unsynced_names = {name for name in unsynced_names if name.rpartition("/")[0] != call.path}
            elif call.what == "rename":
                if folder == "checkpoints":
                    self.assertEqual((unsynced_names, unsynced_bytes), (set(), set()), call.to)
                    checkpoints += 1
                unsynced_names.add(call.to)
            elif call.what == "remove" and call.path.startswith("checkpoints/checkpoint_"):
                self.assertEqual([name for name in unsynced_names if name.startswith("checkpoints/")], [], call.path)
        self.assertGreater(checkpoints, 2)

    def test_the_end(self):
        last = [call for call in self.calls() if call.what in ("fsync", "rename")][-2:]
        self.assertEqual([call.what for call in last], ["rename", "fsync"])
        self.assertEqual((last[0].to, last[1].path), ("summary.json", ""))


if __name__ == "__main__":
    unittest.main()
