"""Scenes, files and folders that mean harm, as a user meets them."""
import base64
import json
import os
import struct
import unittest
import zlib

from sessile_cli import BAD_INPUT, FAILED, CliTest, tiny

TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


class Outside(CliTest):
    def setUp(self):
        super().setUp()
        (self.folder / "scenes").mkdir()
        (self.folder / "outside.obj").write_text(TETRAHEDRON)
        mesh = {"label": "rock", "shape": {"type": "mesh", "file": "../outside.obj", "scale": 0.1}}
        (self.folder / "scenes/s.json").write_text(json.dumps(tiny(solids=[mesh])))

    def test_a_scene_reads_its_own_folder_alone(self):
        for command in ("check", "run", "view", "picture", "compare"):
            more = {"picture": ["-o", "p.png"], "compare": ["--methods", "none,paper"]}.get(command, [])
            with self.subTest(command):
                lines = self.refused(command, "scenes/s.json", *more)
                self.assertEqual(lines, ["scenes/s.json:1: solids[0].shape.file: \"../outside.obj\" lies outside the "
                                         "scene's folder: --allow-outside lets a scene read there, or move the file "
                                         "beside the scene"])

    def test_it_reads_elsewhere_when_asked(self):
        self.call("check", "scenes/s.json", "--allow-outside")
        self.call("run", "scenes/s.json", "--allow-outside", "-o", "out", "--progress", "none")
        # What the run wrote down of itself is read without asking again.
        self.call("mesh", "out", "--set", "cube_size=2")
        self.call("run", "--resume", "out", "--until", "0.05", "--progress", "none")

    def test_a_mesh_that_the_user_names_may_lie_anywhere(self):
        self.call("check", "scenes/s.json", "--set", "solids[0].shape.file=../outside.obj")


class OddFiles(CliTest):
    def test_what_is_no_file(self):
        (self.folder / "folder.json").mkdir()
        (self.folder / "empty.json").write_text("")
        (self.folder / "bytes.json").write_bytes(b"\xff\xfe\x80{}")
        os.mkfifo(self.folder / "pipe.json")
        for name, why in (("folder.json", "it is a folder"), ("/dev/zero", "it is a device"),
                          ("empty.json", ""), ("bytes.json", ""), ("pipe.json", ""), ("none.json", "No such file")):
            with self.subTest(name):
                _, err = self.call("check", name, code=BAD_INPUT, timeout=20)
                self.assertIn(why, err)
                self.assertEqual(len(err.splitlines()), 1, err)

    def test_a_scene_from_a_pipe_and_one_with_a_mark(self):
        self.write(tiny())
        (self.folder / "mark.json").write_bytes(b"\xef\xbb\xbf" + json.dumps(tiny()).encode())
        self.call("check", "mark.json")
        self.call("check", "/dev/fd/3", before="exec 3< <(cat s.json)")

    def test_pipes_and_devices_in_results(self):
        self.write(tiny())
        self.call("run", "s.json", "-o", "out", "--progress", "none")
        os.remove(self.folder / "out/frames.pvd")
        os.mkfifo(self.folder / "out/frames.pvd")  # its times stand in the frames too
        self.call("mesh", "out", "--set", "cube_size=2", timeout=30)
        os.remove(self.folder / "out/frame_000001.vtp")
        os.symlink("/dev/zero", self.folder / "out/frame_000001.vtp")
        _, err = self.call("mesh", "out", "--set", "cube_size=2", "-o", "again", code=FAILED, timeout=30)
        self.assertIn("frame_000001.vtp: it is a device", err)


class Links(CliTest):
    def test_links_and_pipes_in_the_output_folder_are_replaced(self):
        self.write(tiny())
        precious = self.folder / "precious"
        precious.write_text("mine")
        out = self.folder / "out"
        out.mkdir()
        for name in ("frame_000001.ply", ".frame_000001.ply.part", "frame_000000.vtp", "stats.csv", "scene.json",
                     ".scene.json.part", "summary.json", "frames.pvd", "solids.vtp"):
            os.symlink(precious, out / name)
        for name in ("frame_000002.ply", ".frame_000002.vtp.part", ".summary.json.part"):
            os.mkfifo(out / name)  # to be opened for writing it would wait for a reader
        self.call("run", "s.json", "-o", "out", "--progress", "none", timeout=30)
        self.assertEqual(precious.read_text(), "mine")
        self.assertEqual([path.name for path in out.iterdir() if path.is_symlink() or path.is_fifo()], [])


class ResumedInto(CliTest):
    def setUp(self):
        super().setUp()
        self.write(tiny())
        self.call("run", "s.json", "-o", "out", "--progress", "none", "--until", "0.02")
        self.stats = self.folder / "out/stats.csv"
        self.before = self.stats.read_bytes()

    def resume(self, **how):
        return self.call("run", "--resume", "out", "--until", "0.04", "--progress", "none", timeout=30, **how)

    def test_a_link_of_either_kind_is_not_written_through(self):
        other = self.folder / "other"
        for link in (os.link, os.symlink):
            with self.subTest(link.__name__):
                self.stats.rename(other)
                link(other, self.stats)
                self.resume()
                self.assertEqual(other.read_bytes(), self.before)
                self.assertFalse(self.stats.is_symlink())
                self.assertGreater(len(self.stats.read_bytes()), len(self.before))
                self.call("run", "s.json", "-o", "out", "--progress", "none", "--until", "0.02")

    def test_pipes_are_not_waited_for(self):
        self.stats.unlink()
        os.mkfifo(self.stats)
        _, err = self.resume(code=FAILED)
        self.assertIn("cannot go on with out/stats.csv: it is no file", err)

    def test_odd_summaries_and_lists_of_surfaces(self):
        summary, surfaces = self.folder / "out/summary.json", self.folder / "out/surface"
        surfaces.mkdir()
        for text in (None, "[" * 3000, "{", "[5]", '{"version": 1, "frames": [5]}'):
            with self.subTest(text and text[:10]):
                for file in (summary, surfaces / "surface.json"):
                    file.unlink(missing_ok=True)
                    os.mkfifo(file) if text is None else file.write_text(text)
                self.call("run", "--resume", "out", "--progress", "none", timeout=30)
                _, err = self.call("render", "out", "-o", "pictures", code=FAILED, timeout=30)
                self.assertRegex(err, r"surface.json: it is not what `sessile mesh` writes|holds no surfaces")
                self.call("run", "s.json", "-o", "out", "--progress", "none", "--until", "0.02", timeout=30)
                surfaces.mkdir(exist_ok=True)


class OddResults(CliTest):
    """What stands in place of files that a program of this kind wrote."""

    def replace(self, file, text=None):
        """Puts a text, or a pipe, in place of a file."""
        path = self.folder / file
        path.unlink(missing_ok=True)
        os.mkfifo(path) if text is None else path.write_text(text)

    def test_pipes_in_place_of_sequences_of_surfaces(self):
        scene = tiny()
        scene["output"]["surface"] = {"formats": ["usda"], "cube_size": 2}
        self.write(scene)
        self.call("run", "s.json", "-o", "out", "--progress", "none", "--until", "0.02")
        self.replace("out/surface/surface.usda")
        for part in range(3):
            self.replace(f"out/surface/.surface.usda.{part}.part")
        _, err = self.call("run", "--resume", "out", "--until", "0.04", "--progress", "none", code=FAILED, timeout=30)
        self.assertIn("surface.usda: it lacks frames that had been written", err)

    def test_verdicts_of_comparisons(self):
        self.write({"title": "nothing", "pressure": {"type": "iisph"}, "forces": []}, "nothing.json")
        compare = ["compare", self.write(tiny()), "--methods", "nothing.json", "-o", "out", "--progress", "none"]
        self.call(*compare)
        for text in (None, "[" * 3000, "", "{}", "[" + "{}," * 3_000_000 + "{}]"):
            with self.subTest(text and text[:10]):
                self.replace("out/nothing/verdict.json", text)
                out, _ = self.call(*compare, timeout=30, before="ulimit -v 1000000")
                self.assertNotIn("as before", out)
                self.assertEqual(json.loads((self.folder / "out/nothing/verdict.json").read_text())["status"], "done")

    def test_settings_of_renderings(self):
        self.write(tiny())
        self.call("run", "s.json", "-o", "out", "--progress", "none")
        self.call("mesh", "out", "--set", "cube_size=2")
        (self.folder / "out/render").mkdir()
        for frame in range(5):
            (self.folder / f"out/render/frame_{frame:06d}.png").write_text("a picture")
        self.replace("out/render/settings.json")
        self.call("render", "out", "--no-video", timeout=30)
        (self.folder / "out/render/settings.json").unlink()
        os.symlink("/dev/zero", self.folder / "out/render/settings.json")
        self.call("render", "out", "--no-video", timeout=30)
        self.assertFalse((self.folder / "out/render/settings.json").is_symlink())

    def test_more_values_than_any_has(self):
        self.write(tiny())
        self.call("run", "s.json", "-o", "out", "--progress", "none")
        pvd = (self.folder / "out/frames.pvd").read_text()
        self.replace("out/frames.pvd", pvd.replace('timestep="0"', 'timestep="7"', 1)
                     .replace("</VTKFile>", "<a/>" * 1_200_000 + "</VTKFile>"))
        self.replace("out/summary.json", "[" + "{}," * 5_000_000 + "{}]")
        (self.folder / "out/surface").mkdir()
        self.replace("out/surface/surface.json", '{"version": 1, "frames": [' + "{}," * 17_000_000 + "{}]}")
        self.call("mesh", "out", "--set", "cube_size=2", timeout=60, before="ulimit -v 1000000")
        times = [frame["time"] for frame in json.loads((self.folder / "out/surface/surface.json").read_text())["frames"]]
        self.assertEqual(times[0], 0, "a list of a million tags was believed")
        (self.folder / "out/scene.json").unlink()
        _, err = self.call("mesh", "out", "-o", "again", code=FAILED, before="ulimit -v 600000")
        self.assertIn("summary.json: it holds no scene", err)


class HungryFiles(CliTest):
    """Files that take more memory than their bytes tell, in less of it than they would take."""

    def setUp(self):
        super().setUp()
        self.write(tiny())
        self.call("run", "s.json", "-o", "out", "--progress", "none")

    def test_a_frame_that_unpacks_to_much(self):
        blocks, block = 300, 1 << 20
        packed = zlib.compress(bytes(block), 9)
        head = struct.pack("<QQQ", blocks, block, 0) + struct.pack("<Q", len(packed)) * blocks
        data = base64.b64encode(head) + base64.b64encode(packed * blocks)
        frame = self.folder / "out/frame_000000.vtp"
        text = frame.read_bytes()
        array = (b'<PolyData><FieldData><DataArray type="Float64" Name="TimeValue" format="ascii">0</DataArray><DataArray '
                 b'type="Int64" Name="Step" format="ascii">0</DataArray></FieldData><Piece NumberOfPoints="%d"><PointData/>'
                 b'<Points><DataArray type="Float32" Name="P" NumberOfComponents="3" format="appended" offset="0"/></Points>'
                 b'</Piece></PolyData><AppendedData encoding="base64">_' % (blocks * block // 12))
        frame.write_bytes(text[:text.index(b"<PolyData>")] + array + data + b"</AppendedData></VTKFile>")
        _, err = self.call("mesh", "out", "--frames", "0", code=FAILED, before="ulimit -v 2000000")
        self.assertIn("frame_000000.vtp: it unpacks to more than there is memory for", err)

    def test_names_of_fields_do_not_steer_the_terminal(self):
        frame = self.folder / "out/frame_000000.ply"
        for path in (self.folder / "out").glob("*.vtp"):
            path.unlink()
        frame.write_bytes(frame.read_bytes().replace(b"float density", b"float \x1b[2J\x07ity"))
        _, err = self.call("picture", "out", "--time", "0", "--field", "nope nope", "-o", "p.png", code=BAD_INPUT)
        if "no field" not in err:
            self.skipTest("nothing can be drawn here: " + err)
        self.assertIn("?[2J?ity", err)
        self.assertNotIn("\x1b", err)

    def test_solids_with_fine_samples(self):
        plate = {"label": "plate", "spacing": 0.0051, "shape": {"type": "plate", "width": 1.5, "depth": 1.5}}
        self.write(tiny(solids=[plate]))
        self.call("check", "s.json", before="ulimit -v 1000000", timeout=120)

    def test_bodies_at_one_place(self):
        body = {"shape": {"type": "sphere", "radius": 0.2}, "placement": {"position": [0, 0, 0.5]}}
        self.write(tiny(bodies=[body] * 3000))
        _, err = self.call("check", "s.json", code=BAD_INPUT, before="ulimit -v 1000000", timeout=120)
        self.assertIn("bodies[0] and bodies[1] overlap", err)
        self.assertIn("more than 100 such faults", err)


class HugeCounts(CliTest):
    def test_are_refused_with_a_sentence(self):
        self.write(tiny(emitters=[]))
        for override in ("bodies[0].shape.size=[3000, 3000, 3000]", "bodies[0].shape.size=[0.1, 0.1, 1e12]",
                         'solids[0].shape={"type": "cylinder", "radius": 1e-9, "height": 1e11}',
                         'solids[0].shape={"type": "sphere", "radius": 1e6}',
                         'emitters[0]={"shape": {"type": "disc", "radius": 1e6}, "interval": 1}'):
            with self.subTest(override):
                # In less address space than a tenth of any of them would take: it is not tried.
                _, err = self.call("check", "s.json", "--set", override, code=BAD_INPUT, timeout=20,
                                   before="ulimit -v 1000000")
                self.assertRegex(err, r"^s\.json.*a larger spacing needs fewer")
                self.assertEqual(len(err.splitlines()), 1)

    def test_numbers_beyond_all_bounds(self):
        self.write(tiny())
        for value in ("NaN", "-Infinity", "1e999", "-1e999", "1" + "0" * 400):
            for path in ("spacing", "time.end", "bodies[0].shape.size[0]", "fluid.viscosity"):
                with self.subTest(f"{path}={value[:10]}"):
                    _, err = self.call("check", "s.json", "--set", f"{path}={value}", code=BAD_INPUT)
                    self.assertIn("not finite", err)


if __name__ == "__main__":
    unittest.main()
