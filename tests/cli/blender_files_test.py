"""What tools/blender reads and computes without Blender: meshes, folders, solids with margins."""
import importlib
import json
import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools/blender"

try:
    import numpy as np
    sys.path.insert(0, str(TOOLS))
    mesh_file = importlib.import_module("sessile.mesh_file")
    surface_folder = importlib.import_module("sessile.surface_folder")
    looks = importlib.import_module("sessile.looks")
    thick = importlib.import_module("sessile.thick")
except ImportError:
    np = None

HEADER = """ply
format binary_little_endian 1.0
comment Sessile, time 0.5 s, step 10
element vertex 3
property float x
property float y
property float z
property float nx
property float ny
property float nz
property int id
property float vx
property float vy
property float vz
element face 1
property list uchar int vertex_indices
end_header
"""
CUBE = ([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)],
        [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
         [1, 5, 7], [1, 7, 3]])


def triangle(corners=(3, 0, 1, 2), header=HEADER):
    """A PLY file of one triangle."""
    places = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    body = b"".join(struct.pack("<6fi3f", *place, 0, 0, 1, 7 + k, 3, 0, 4 * k) for k, place in enumerate(places))
    return header.encode() + body + struct.pack("<B3i", *corners)


def area_and_volume(points, triangles):
    a, b, c = (np.asarray(points, float)[np.asarray(triangles)[:, k]] for k in range(3))
    return (np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2,
            np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


@unittest.skipIf(np is None, "this Python has no NumPy")
class MeshFiles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sessile-blender-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def read(self, data):
        (self.folder / "m.ply").write_bytes(data)
        return mesh_file.read_mesh(self.folder / "m.ply")

    def test_brings_back_what_a_file_holds(self):
        mesh = self.read(triangle())
        self.assertEqual(mesh.points.tolist(), [[0, 0, 0], [1, 0, 0], [0, 1, 0]])
        self.assertEqual(mesh.triangles.tolist(), [[0, 1, 2]])
        self.assertEqual(mesh.normals.tolist(), [[0, 0, 1]] * 3)
        self.assertEqual(mesh.attributes["id"].tolist(), [7, 8, 9])
        self.assertEqual(mesh.attributes["id"].dtype, np.int32)
        self.assertEqual(mesh.attributes["velocity"].tolist(), [[3, 0, 0], [3, 0, 4], [3, 0, 8]])
        self.assertEqual(mesh.attributes["speed"].tolist()[:2], [3, 5])

    def test_refuses_what_is_no_such_file(self):
        for data, words in [(b"", "is no PLY file"),
                            (triangle()[:-1], "ends too early"),
                            (triangle(corners=(4, 0, 1, 2)), "not triangles"),
                            (triangle(corners=(3, 0, 1, 3)), "a vertex that is not there"),
                            (triangle(header=HEADER.replace("little", "big")), "not binary, little endian"),
                            (triangle(header=HEADER.replace("float x", "half x")), "property half x"),
                            (triangle(header=HEADER.replace("element face 1\nproperty list uchar int vertex_indices\n",
                                                            "")), "expected vertices and faces")]:
            with self.subTest(words=words), self.assertRaises(mesh_file.MeshFileError) as caught:
                self.read(data)
            self.assertIn(words, str(caught.exception))
            self.assertIn("m.ply", str(caught.exception))

    def test_waits_for_no_pipe_and_reads_no_device(self):
        os.mkfifo(self.folder / "pipe.ply")
        for path in (self.folder / "pipe.ply", pathlib.Path("/dev/zero"), self.folder):
            with self.subTest(path=path), self.assertRaisesRegex(mesh_file.MeshFileError, "is no file but"):
                mesh_file.read_mesh(path)

    def test_volume(self):
        points, triangles = (np.array(each, dtype=kind) for each, kind in zip(CUBE, (np.float32, np.int32)))
        self.assertAlmostEqual(mesh_file.Mesh(points + 5, triangles, None, {}).volume(), 1, places=5)
        self.assertEqual(mesh_file.Mesh(points, triangles[:0], None, {}).volume(), 0)

    def test_folder_lists_frames_by_time(self):
        frames = [{"number": n, "time": t, "file": "s.obj", "files": ["s.obj", f"s{n}.ply"], "triangles": 1}
                  for n, t in [(2, 0.2), (0, 0.0), (1, 0.1), (3, 0.2001)]]
        (self.folder / "surface.json").write_text(json.dumps(
            {"version": 1, "spacing": 0.1, "up": [0, 1, 0], "frames": frames,
             "solids": [{"label": "plate", "file": "p.ply"}]}))
        folder = surface_folder.open_folder(self.folder)
        self.assertEqual([frame.number for frame in folder.frames], [0, 1, 2, 3])
        self.assertEqual(folder.frames[1].file, self.folder / "s1.ply")
        self.assertAlmostEqual(folder.interval(), 0.1)
        self.assertEqual([folder.frame_at(time).number for time in (-1, 0.04, 0.06, 9)], [0, 0, 1, 3])
        self.assertEqual((folder.up, folder.solids[0].label), ((0, 1, 0), "plate"))

    def test_folder_without_surfaces_is_refused(self):
        with self.assertRaisesRegex(surface_folder.FolderError, "holds no surface.json"):
            surface_folder.open_folder(self.folder)
        (self.folder / "surface.json").write_text('{"frames": [], "spacing": 1}')
        with self.assertRaisesRegex(surface_folder.FolderError, "names no frames"):
            surface_folder.open_folder(self.folder / "surface.json")

    def test_package_can_be_read_without_blender(self):
        code = f"import sys; sys.path.insert(0, {str(TOOLS)!r}); import sessile; print(sessile.bl_info['name'])"
        said = subprocess.run([sys.executable, "-B", "-c", code], capture_output=True, text=True, check=True)
        self.assertEqual(said.stdout, "Sessile results\n")


@unittest.skipIf(np is None, "this Python has no NumPy")
class Looks(unittest.TestCase):
    def test_every_word_of_a_scene_has_its_look(self):
        header = (TOOLS.parents[1] / "src/sessile/scene/render_settings.h").read_text()
        words = header.split("Words<LiquidLook>")[1].split("words{")[1].split("}")[0]
        self.assertEqual([word.strip().strip('"') for word in words.split(",")], list(looks.LOOKS))

    def test_absorption_leaves_the_tint_at_its_depth(self):
        density, color = looks.absorption((0.5, 0.25, 1.0), 2.0)
        for tint, part in zip((0.5, 0.25, 1.0), color):
            self.assertAlmostEqual(math.exp(-2 * density * (1 - part)), tint)


@unittest.skipIf(np is None, "this Python has no NumPy")
class ThickSolids(unittest.TestCase):
    def test_faces_of_a_box_move_out(self):
        self.assertEqual(np.round(area_and_volume(*thick.outset(*CUBE, 0.25)), 9).tolist(), [13.5, 3.375])

    def test_faces_that_look_inwards_move_inwards(self):
        inwards = [each[::-1] for each in CUBE[1]]
        self.assertEqual(np.round(area_and_volume(*thick.outset(CUBE[0], inwards, 0.25)), 9).tolist(), [1.5, -0.125])

    def test_a_sheet_becomes_a_slab(self):
        sheet = [[0, 0, 1], [2, 0, 1], [2, 1, 1], [0, 1, 1]]
        points, triangles = thick.outset(sheet, [[0, 1, 2], [0, 2, 3]], 0.1)
        self.assertEqual(np.round(area_and_volume(points, triangles), 9).tolist(),
                         np.round([2 * 2.2 * 1.2 + 0.2 * 2 * 3.4, 2.2 * 1.2 * 0.2], 9).tolist())

    def test_vertices_that_triangles_do_not_share_are_joined(self):
        points = np.array(CUBE[0], float)[np.array(CUBE[1])].reshape(-1, 3)
        triangles = np.arange(len(points)).reshape(-1, 3)
        self.assertEqual(np.round(area_and_volume(*thick.outset(points, triangles, 0.25)), 9).tolist(), [13.5, 3.375])


if __name__ == "__main__":
    unittest.main()
