"""The scenes that bench/peers gives to another program hold the particles of our own. Needs no other program."""
import json
import pathlib
import struct
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench/peers"))
import scene as peers  # noqa: E402


def read_bgeo(path):
    """Points of a file without attributes."""
    data = path.read_bytes()
    magic, (version, count) = data[:5], struct.unpack(">2i", data[5:13])
    values = struct.unpack(f">{4 * count}f", data[41:41 + 16 * count])
    assert magic == b"BgeoV" and version == 5 and data[41 + 16 * count:] == b"\x00\xff"
    return [values[k:k + 3] for k in range(0, 4 * count, 4)]


class Translation(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sessile-peers-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_s1(self):
        self.assertEqual(peers.write(peers.read("s1"), "iisph", self.folder), (32768, 38402 + 3522))
        fluid, box, board = (read_bgeo(self.folder / f"{name}.bgeo") for name in ("fluid", "solid_0", "solid_1"))
        self.assertEqual((len(fluid), len(box), len(board)), (32768, 38402, 3522))
        for points, low, high in ((fluid, (-1.55, 2.3, -1.55), (1.55, 5.4, 1.55)), (box, (-4, 0, -4), (4, 8, 4)),
                                  (board, (-2, 1.8, -2), (2, 2, 2))):
            for axis in range(3):
                self.assertAlmostEqual(min(point[axis] for point in points), low[axis], places=5)
                self.assertAlmostEqual(max(point[axis] for point in points), high[axis], places=5)
        scene = json.loads((self.folder / "scene.json").read_text())
        configuration = scene["Configuration"]
        self.assertEqual((configuration["timeStepSize"], configuration["cflMethod"]), (0.002, 0))
        self.assertAlmostEqual(configuration["IISPH"]["maxError"], 0.01)
        self.assertEqual(scene["Materials"][0]["Standard viscosity"], {"viscosity": 0.01, "viscosityBoundary": 0})

    def test_block(self):
        self.assertEqual(peers.write(peers.read("s2_250k"), "dfsph", self.folder), (250047, 52610))
        scene = json.loads((self.folder / "scene.json").read_text())
        self.assertAlmostEqual(scene["Configuration"]["DFSPH"]["maxError"], 0.1)

    def test_refuses_a_scene_without_counterpart(self):
        for name in ("s1_fast", "column"):
            with self.assertRaises(SystemExit):
                peers.write(peers.read(name), "iisph", self.folder)


if __name__ == "__main__":
    unittest.main()
