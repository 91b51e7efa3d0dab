"""`sessile mesh` end to end, and the surfaces that `sessile run` makes."""
import csv
import os
import re
import time

from frames import read_pvd
from sessile_cli import BAD_INPUT, FAILED, INTERRUPTED, CliTest, signal, tiny, unittest
from surfaces import is_closed, read_index, read_obj, read_surface_ply

FRAMES = range(5)


class MeshTest(CliTest):
    def run_tiny(self, *options, **changes):
        self.call("run", self.write(tiny(**changes)), "-o", "out", "--progress", "none", *options)

    def mesh(self, *options, source="out", **expected):
        return self.call("mesh", source, "--progress", "none", *options, **expected)

    def index(self, folder="out/surface"):
        return read_index(self.folder / folder / "surface.json")

    def surface(self, number, kind="ply"):
        return self.folder / f"out/surface/surface_{number:06d}.{kind}"

    def stamps(self):
        return {path.name: path.stat().st_mtime_ns for path in (self.folder / "out/surface").glob("surface_*")}


class Formats(MeshTest):
    def setUp(self):
        super().setUp()
        self.run_tiny()

    def test_ply_and_the_index(self):
        out, err = self.mesh()
        self.assertEqual(err, "")
        self.assertRegex(out, r"\A5 frames, \d+ triangles; a frame took [\d.]+ s to reconstruct, [\d.]+ s to write\n"
                              r"surfaces and surface.json are in out/surface\n\Z")
        self.assertEqual(self.names("out/surface"),
                         ["solid_000.ply", "surface.json"] + [f"surface_{k:06d}.ply" for k in FRAMES])
        index = self.index()
        self.assertEqual((index["version"], index["spacing"], index["up"]), (1, 0.1, [0, 0, 1]))
        self.assertEqual(index["settings"]["method"]["type"], "density")
        self.assertEqual(index["solids"], [{"label": "floor", "file": "solid_000.ply"}])
        times = [time for time, _ in read_pvd(self.folder / "out/frames.pvd")]
        for k, frame in enumerate(index["frames"]):
            self.assertEqual((frame["number"], frame["time"], frame["file"]), (k, times[k], f"surface_{k:06d}.ply"))
            vertices, triangles = read_surface_ply(self.surface(k))
            self.assertEqual(frame["triangles"], len(triangles))
            self.assertTrue(triangles and is_closed(triangles))
            self.assertEqual(list(vertices), ["x", "y", "z", "nx", "ny", "nz", "id", "vx", "vy", "vz", "density",
                                              "pressure"])
            self.assertLess(max(map(abs, vertices["x"])), 0.3)
        # The block has fallen for 40 ms.
        self.assertAlmostEqual(sum(vertices["vz"]) / len(vertices["vz"]), -9.81 * 0.04, delta=0.05)
        plate, faces = read_surface_ply(self.folder / "out/surface/solid_000.ply")
        self.assertEqual((list(plate), len(faces), max(plate["x"])), (["x", "y", "z"], 2, 0.5))

    def test_every_other(self):
        self.mesh("--format", "obj", "--format", "vtp", "--format", "vdb", "--format", "usda", "--format", "ply")
        kinds = ("obj", "ply", "vdb", "vtp")
        self.assertEqual(self.names("out/surface"),
                         ["solid_000.ply", "surface.json", "surface.pvd", "surface.usda"] +
                         [f"surface_{k:06d}.{kind}" for k in FRAMES for kind in kinds])
        collection = read_pvd(self.folder / "out/surface/surface.pvd")
        self.assertEqual(collection, [(time, name.replace("frame_", "surface_"))
                                      for time, name in read_pvd(self.folder / "out/frames.pvd")])
        usda = (self.folder / "out/surface/surface.usda").read_text()
        for k, frame in enumerate(self.index()["frames"]):
            self.assertEqual(frame["file"], f"surface_{k:06d}.ply")
            self.assertEqual(len(frame["files"]), 5)
            vertices, triangles = read_surface_ply(self.surface(k))
            self.assertEqual(read_obj(self.surface(k, "obj")), (len(vertices["x"]), len(vertices["x"]), triangles))
            self.assertIn(f'NumberOfPolys="{len(triangles)}"', self.surface(k, "vtp").read_text())
            self.assertEqual(self.surface(k, "vdb").read_bytes()[:4], b" BDV")
        for attribute in ("points", "velocities", "normals", "extent", "faceVertexCounts", "primvars:density"):
            block = re.search(rf" {attribute}\.timeSamples = {{\n(.*?)\n        }}", usda, re.S).group(1)
            self.assertEqual(len(block.splitlines()), 5, attribute)
        self.assertIn("timeCodesPerSecond = 100\n", usda)
        self.assertIn('def Mesh "floor"', usda)

    def test_one_frame(self):
        out, _ = self.mesh(source="out/frame_000003.ply")
        self.assertRegex(out, r"\A\d+ triangles, area [\d.]+ m\^2, volume [\d.]+ m\^3: out/surface_000003.ply\n\Z")
        alone = (self.folder / "out/surface_000003.ply").read_bytes()
        self.mesh()
        self.assertEqual(alone, self.surface(3).read_bytes())
        self.mesh("-o", "here", "--format", "usda", "--format", "vdb", source="out/frame_000003.vtp")
        self.assertEqual(self.names("here"), ["surface_000003.usda", "surface_000003.vdb"])
        os.rename(self.folder / "out/frame_000003.ply", self.folder / "stray.ply")
        _, err = self.mesh(source="stray.ply", code=FAILED)
        self.assertIn("give the distance of the particles: --spacing 0.1", err)
        self.mesh("--spacing", "0.1", source="stray.ply")
        self.assertEqual(alone, (self.folder / "stray_surface.ply").read_bytes())

    def test_without_particles(self):
        spout = {"interval": 0.02, "start": 0.03, "velocity": [0, 0, 3], "placement": {"position": [0, 0, 1]},
                 "shape": {"type": "rectangle", "width": 0.3, "depth": 0.3}}
        self.run_tiny(emitters=[spout], bodies=[])
        self.mesh("--format", "obj", "--format", "vtp", "--format", "vdb", "--format", "usda", "--format", "ply")
        self.assertEqual(read_surface_ply(self.surface(0))[1], [])
        self.assertEqual(read_obj(self.surface(0, "obj")), (0, 0, []))
        self.assertEqual(self.index()["frames"][0]["triangles"], 0)
        self.assertGreater(self.index()["frames"][-1]["triangles"], 0)
        self.assertIn("            0: [],\n", (self.folder / "out/surface/surface.usda").read_text())


class Selection(MeshTest):
    def setUp(self):
        super().setUp()
        self.run_tiny()

    def test_frames(self):
        for text, numbers in (("1:3", [1, 2]), ("-1", [4]), ("::2", [0, 2, 4])):
            self.mesh("--frames", text, "-o", "some")
            self.assertLessEqual(set(numbers), {frame["number"] for frame in self.index("some")["frames"]})
        self.assertEqual([frame["number"] for frame in self.index("some")["frames"]], [0, 1, 2, 4])

    def test_what_is_good_stays(self):
        self.mesh("--frames", ":3")
        before = self.stamps()
        out, _ = self.mesh()
        self.assertIn("\n3 frames were up to date already\n", out)
        self.assertEqual(before, {name: stamp for name, stamp in self.stamps().items() if name in before})
        self.assertEqual(self.mesh()[0], "5 frames were up to date already\nsurfaces and surface.json are in out/surface\n")

    def test_what_is_not_good_is_made_anew(self):
        self.mesh()
        whole = self.surface(2).read_bytes()
        self.surface(2).unlink()
        later = time.time() + 10
        os.utime(self.folder / "out/frame_000004.vtp", (later, later))
        self.assertRegex(self.mesh()[0], r"\A2 frames, .*\n3 frames were up to date already\n")
        self.assertEqual(self.surface(2).read_bytes(), whole)
        self.assertRegex(self.mesh("--again")[0], r"\A5 frames, [^\n]*\nsurf")
        self.assertRegex(self.mesh("--set", "cube_size=1.5")[0], r"\A5 frames, [^\n]*\nsurf")
        self.assertEqual(self.index()["settings"]["cube_size"], 1.5)
        self.assertLess(len(self.surface(2).read_bytes()), len(whole))

    def test_a_further_format(self):
        self.mesh()
        before = self.stamps()
        self.mesh("--format", "obj", "--format", "usda")
        self.assertEqual(before, {name: stamp for name, stamp in self.stamps().items() if name in before})
        for k in FRAMES:
            self.assertTrue(self.surface(k, "obj").exists())
        # One file for all: it holds the frames of the last call.
        self.assertIn("5 frames were up to date", self.mesh("--format", "usda")[0])
        self.mesh("--format", "usda", "--frames", "0,1", "--again")
        self.assertEqual([frame["files"] for frame in self.index()["frames"]], [["surface.usda"]] * 2)

    def test_surfaces_of_frames_that_are_gone_go_too(self):
        self.mesh()
        self.run_tiny("--until", "0.02")
        self.assertFalse((self.folder / "out/surface").exists(), "surfaces of the run before")
        self.mesh()
        (self.folder / "out/frame_000002.vtp").unlink()
        self.mesh()
        self.assertEqual(self.names("out/surface"), ["solid_000.ply", "surface.json", "surface_000000.ply",
                                                     "surface_000001.ply"])

    def test_threads_make_no_difference(self):
        self.mesh("--threads", "1", "-o", "one")
        self.mesh("--threads", "3", "-o", "three")
        for name in self.names("one"):
            self.assertEqual((self.folder / "one" / name).read_bytes(), (self.folder / "three" / name).read_bytes(), name)


class Faults(MeshTest):
    def usage(self, line, *arguments):
        with self.subTest(arguments=arguments):
            _, err = self.call("mesh", *arguments, code=BAD_INPUT)
            self.assertEqual(err.splitlines()[0], line)

    def test_usage(self):
        self.run_tiny()
        self.usage('source: there is no file or folder "none"', "none")
        self.usage('--format: unknown format "vtk" (did you mean "vtp"?)', "out", "--format", "vtk")
        self.usage('--format: unknown format "stl" (valid formats: ply, obj, vtp, vdb, usda)', "out", "--format", "stl")
        self.usage('--set cube_sze: unknown key (did you mean "cube_size"?)', "out", "--set", "cube_sze=1")
        self.usage("--set cube_size: must be above 0, found -1", "out", "--set", "cube_size=-1")
        self.usage("--frames: there is no frame 5: there are 5", "out", "--frames", "5")
        self.usage('--frames: expected frames such as 10:20, ::5 or 0,3,-1, found "a"', "out", "--frames", "a")
        self.usage("--spacing: must be above 0 m, found 0", "out", "--spacing", "0")
        self.assertFalse((self.folder / "out/surface").exists())

    def test_folders(self):
        (self.folder / "empty").mkdir()
        _, err = self.mesh(source="empty", code=FAILED)
        self.assertEqual(err, "sessile: empty holds neither scene.json nor summary.json: is it a folder of `sessile run`?\n")
        self.run_tiny("--set", "output.formats=[]")
        _, err = self.mesh(code=FAILED)
        self.assertRegex(err, r"\Asessile: out holds no frames .*\n\Z")

    def test_broken_frames(self):
        self.run_tiny()
        frame = self.folder / "out/frame_000002.vtp"
        frame.write_bytes(frame.read_bytes()[:-300])
        _, err = self.mesh(code=FAILED)
        self.assertRegex(err, r"\Asessile: cannot read out/frame_000002.vtp: .*\n\Z")
        # What came before is good.
        self.assertEqual([f["number"] for f in self.index()["frames"]], [0, 1])
        self.mesh(source="out/frame_000002.vtp", code=FAILED)
        self.mesh(source="s.json", code=FAILED)

    def test_a_full_disk(self):
        self.run_tiny()
        _, err = self.mesh("--format", "usda", code=FAILED, before="ulimit -f 20")
        self.assertRegex(err, r"\Asessile: cannot write out/surface/.*: File too large; a limit on the size of files stands in the way .*; what had been written is whole\n")
        self.assertEqual([n for n in self.names("out/surface") if n.startswith(".")], [])
        self.assertEqual(self.index()["frames"], [])

    def test_interrupted(self):
        self.run_tiny(time={"end": 1, "fixed_dt": 0.005}, output={"frame_interval": 0.01, "formats": ["ply"]})
        process = self.start("mesh", "out", "--progress", "json", "--format", "ply", "--format", "usda", "--set",
                             "cube_size=0.2")
        process.stdout.readline()
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, INTERRUPTED)
        self.assertRegex(err, r"\Ainterrupted; \d+ of 101 frames are written\n\Z")
        frames = self.index()["frames"]
        self.assertTrue(0 < len(frames) < 101)
        self.assertEqual([n for n in self.names("out/surface") if n.startswith(".")], [])
        self.assertEqual(sorted(f["file"] for f in frames), sorted(path.name for path in
                                                                   (self.folder / "out/surface").glob("surface_*.ply")))
        for frame in frames:
            read_surface_ply(self.folder / "out/surface" / frame["file"])

    def test_progress_as_json(self):
        import json
        self.run_tiny()
        out, err = self.call("mesh", "out", "--progress", "json")
        self.assertEqual(err, "")
        lines = [json.loads(line) for line in out.splitlines()]
        self.assertEqual((lines[-1]["done"], lines[-1]["total"]), (5, 5))


class WhileRunning(MeshTest):
    def output(self, **surface):
        return {"frame_interval": 0.01, "stats_interval": 0.005, "formats": ["vtp"], "surface": surface}

    def test_makes_the_same_surfaces(self):
        self.run_tiny(output=self.output(formats=["ply", "usda"], cube_size=1))
        self.mesh("-o", "later")
        for name in self.names("later"):
            if name != "surface.json":
                self.assertEqual((self.folder / "later" / name).read_bytes(),
                                 (self.folder / "out/surface" / name).read_bytes(), name)
        self.assertEqual(self.index()["frames"], self.index("later")["frames"])
        self.assertEqual(self.index()["settings"], self.index("later")["settings"])

    def test_at_its_own_interval(self):
        self.run_tiny(output=self.output(formats=["obj"], interval=0.02))
        self.assertEqual([(f["number"], f["file"]) for f in self.index()["frames"]],
                         [(k, f"surface_{k:06d}.obj") for k in range(3)])

    def stats(self):
        with open(self.folder / "out/stats.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_measures_it(self):
        self.run_tiny(output=self.output(formats=[], stats=True))
        self.assertFalse((self.folder / "out/surface").exists())
        rows = self.stats()
        self.assertEqual(len(rows), 9)
        for row in rows:
            self.assertAlmostEqual(float(row["surface_area [m^2]"]), 0.54, delta=0.25)
            self.assertAlmostEqual(float(row["surface_volume [m^3]"]), 0.027, delta=0.02)
        out, _ = self.mesh(source="out/frame_000004.vtp")
        area = re.search(r"area ([\d.]+)", out).group(1)
        self.assertAlmostEqual(float(rows[-1]["surface_area [m^2]"]), float(area), places=5)
        self.run_tiny()
        self.assertNotIn("surface_area [m^2]", self.stats()[0])

    def test_is_compared(self):
        scene = tiny(output=self.output(formats=[], stats=True))
        (self.folder / "a.json").write_text('{"pressure": {"type": "iisph"}}')
        self.call("compare", self.write(scene), "--methods", "a.json", "-o", "c", "--progress", "none")
        self.assertIn("| surface area [m^2] |", (self.folder / "c/comparison.md").read_text())
        self.assertIn("set output 'surface_area.svg'", (self.folder / "c/plots/comparison.gp").read_text())

    def test_faults(self):
        lines = self.refused("check", self.write(tiny(output=self.output(formats=["ply", "stl"], interval=0))))
        self.assertEqual(lines, [
            's.json:1: output.surface.formats[1]: unknown format "stl" (valid formats: ply, obj, vtp, vdb, usda)',
            "s.json:1: output.surface.interval: must be above 0 s, found 0"])


if __name__ == "__main__":
    unittest.main()
