"""`sessile render` end to end. What needs Blender is skipped where it is not installed."""
import json
import os
import pathlib
import shutil
import subprocess
import time

from png import pixels, unpacked
from sessile_cli import BAD_INPUT, FAILED, INTERRUPTED, CliTest, signal, tiny, unittest

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools/blender"
BLENDER = shutil.which("blender")
# Debian's Blender takes its Python's libraries from beside the first python3 in PATH.
ENVIRONMENT = {**os.environ, "PATH": f"{os.path.dirname(BLENDER or '')}:/usr/bin:/bin", "PYTHONDONTWRITEBYTECODE": "1"}
SMALL = ["--size", "96x64", "--samples", "4", "--threads", "1", "--progress", "plain"]


def has_blender():
    """Why what needs Blender cannot be tested, or an empty text."""
    if not BLENDER:
        return "there is no program blender"
    probe = subprocess.run([BLENDER, "-b", "--factory-startup", "--python-exit-code", "1", "--python-expr",
                            "import numpy"], env=ENVIRONMENT, capture_output=True, timeout=120)
    return "" if probe.returncode == 0 else "Blender's Python has no NumPy (Debian: python3-numpy)"


NO_BLENDER = has_blender()


class Rendering(CliTest):
    def setUp(self):
        super().setUp()
        self.call("run", self.write(tiny()), "-o", "out", "--progress", "none")

    def mesh(self):
        self.call("mesh", "out", "--progress", "none")

    def pictures(self, folder="out/render"):
        return sorted(path.name for path in (self.folder / folder).glob("frame_*.png"))


class WithoutBlender(Rendering):
    def test_asks_for_surfaces_first(self):
        _, err = self.call("render", "out", code=FAILED)
        self.assertIn("run `sessile mesh out` first", err)

    def test_says_that_a_folder_is_not_there(self):
        _, err = self.call("render", "nowhere", code=FAILED)
        self.assertIn("there is no folder nowhere", err)

    def test_names_the_package_when_blender_is_missing(self):
        self.mesh()
        _, err = self.call("render", "out", code=FAILED, before="PATH=/nowhere")
        self.assertEqual(err, "sessile: rendering takes Blender, and there is no program `blender`; on Debian: "
                              "apt install blender python3-numpy\n")

    def test_a_link_in_place_of_the_film_to_be_is_replaced(self):
        self.mesh()
        out, precious, ffmpeg = self.folder / "out/render", self.folder / "precious", self.folder / "bin/ffmpeg"
        out.mkdir()
        for frame in range(2):
            (out / f"frame_{frame:06d}.png").write_bytes(b"picture")
        precious.write_text("mine")
        for name in (".part.film.mp4", ".film.mp4.list", "film.mp4"):
            os.symlink(precious, out / name)
        ffmpeg.parent.mkdir()
        ffmpeg.write_text('#!/bin/sh\nfor last; do :; done\necho film > "$last"\n')
        ffmpeg.chmod(0o755)
        self.call("render", "out", "--frames", ":2", before=f"PATH={ffmpeg.parent}:/usr/bin:/bin")
        self.assertEqual(precious.read_text(), "mine")
        self.assertEqual((out / "film.mp4").read_text(), "film\n")
        self.assertEqual([path.name for path in out.iterdir() if path.is_symlink()], [])

    def test_settings_are_checked_as_a_scene_is(self):
        self.mesh()
        for arguments, words in [(["--look", "watr"], "did you mean \"water\"?"),
                                 (["--samples", "0"], "render.samples"),
                                 (["--size", "640"], "--size: expected 1280x720"),
                                 (["--camera", "elevaton=3"], "did you mean \"elevation\"?"),
                                 (["--frames", "90:99"], "none of these"),
                                 (["--set", 'solids=[{"label": "flor"}]'], "did you mean \"floor\"?")]:
            with self.subTest(arguments=arguments):
                self.assertIn(words, "\n".join(self.refused("render", "out", *arguments)))

    def test_a_scene_carries_its_settings(self):
        self.call("check", self.write(tiny(render={"look": "honey", "camera": {"elevation": 40}}), "honey.json"))
        _, err = self.call("check", self.write(tiny(render={"look": "glue"}), "glue.json"), code=BAD_INPUT)
        self.assertIn('unknown word "glue"', err)


@unittest.skipIf(NO_BLENDER, NO_BLENDER)
class Frames(Rendering):
    def setUp(self):
        super().setUp()
        self.mesh()

    def colours(self, name):
        width, height, _, _ = unpacked(self.folder / name)
        self.assertEqual((width, height), (96, 64))
        return pixels(self.folder / name)

    def test_renders_what_is_there_and_skips_what_is_rendered(self):
        out, err = self.call("render", "out", *SMALL, "--frames", "0,4", "--no-video", timeout=240)
        self.assertIn("2 frames rendered, 0 were there", out)
        self.assertIn("2 of 2 frames  frame_000004.png", err)
        self.assertEqual(self.pictures(), ["frame_000000.png", "frame_000004.png"])
        colours = self.colours("out/render/frame_000000.png")
        self.assertGreater(len(colours), 200, "the picture is blank")
        self.assertGreater(max(max(colour) for colour in colours), 150, "the picture is dark")
        # The liquid has fallen between the two, so the pictures differ by more than noise.
        self.assertNotEqual(colours, self.colours("out/render/frame_000004.png"))
        before = (self.folder / "out/render/frame_000000.png").stat().st_mtime_ns
        out, _ = self.call("render", "out", *SMALL, "--frames", "0,4", "--no-video", before="PATH=/nowhere")
        self.assertIn("0 frames rendered, 2 were there", out)
        self.assertEqual((self.folder / "out/render/frame_000000.png").stat().st_mtime_ns, before)
        line = self.refused("render", "out", *SMALL, "--look", "milk", "--frames", "0")[0]
        self.assertIn('"look": "water", now "look": "milk"', line)

    def test_liquid_and_looks_show(self):
        for look in ("water", "paint"):
            self.call("render", "out", *SMALL, "--frames", "0", "--look", look, "-o", look, timeout=240)
        paint = self.colours("paint/frame_000000.png")
        red = sum(count for (r, g, b), count in paint.items() if r > 60 and r > 1.8 * g and r > 1.8 * b)
        self.assertGreater(red, 60, "no red block is to be seen")
        water = self.colours("water/frame_000000.png")
        self.assertLess(sum(count for (r, g, b), count in water.items() if r > 60 and r > 1.8 * g), 5)

    @unittest.skipUnless(shutil.which("ffmpeg"), "there is no program ffmpeg")
    def test_makes_a_film(self):
        out, _ = self.call("render", "out", *SMALL, "--frames", ":2", "--fps", "5", timeout=240)
        self.assertIn("out/render/film.mp4: 2 frames at 5 a second", out)
        data = (self.folder / "out/render/film.mp4").read_bytes()
        self.assertEqual(data[4:8], b"ftyp")
        self.assertEqual(sorted(path.name for path in (self.folder / "out/render").iterdir()),
                         ["blender.log", "film.mp4", "frame_000000.png", "frame_000001.png", "job.json",
                          "settings.json"])

    def test_links_in_place_of_pictures_are_replaced(self):
        precious = self.folder / "precious"
        precious.write_text("mine")
        (self.folder / "out/render").mkdir()
        for name in (".frame_000000.part.png", "blender.log", "job.json", "settings.json"):
            os.symlink(precious, self.folder / "out/render" / name)
        self.call("render", "out", *SMALL, "--frames", "0", "--no-video", timeout=240)
        self.assertEqual(precious.read_text(), "mine")
        self.assertEqual([path.name for path in (self.folder / "out/render").iterdir() if path.is_symlink()], [])

    def test_frames_stay_when_ffmpeg_is_missing(self):
        self.call("render", "out", *SMALL, "--frames", ":2", "--no-video", timeout=240)
        _, err = self.call("render", "out", *SMALL, "--frames", ":2", code=FAILED, before="PATH=/nowhere")
        self.assertIn("apt install ffmpeg", err)
        self.assertEqual(len(self.pictures()), 2)

    def test_ctrl_c_leaves_whole_frames(self):
        process = self.start("render", "out", "--size", "640x360", "--samples", "4096", "--threads", "1", "--no-video")
        log = self.folder / "out/render/blender.log"
        end = time.monotonic() + 120
        while time.monotonic() < end and "sessile: begin" not in (log.read_text() if log.exists() else ""):
            time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, INTERRUPTED, err)
        self.assertIn("the same command goes on with the rest", err)
        self.assertEqual(self.pictures(), [])

    def test_a_damaged_surface_is_named(self):
        file = self.folder / "out/surface/surface_000000.ply"
        file.write_bytes(file.read_bytes()[:-10])
        _, err = self.call("render", "out", *SMALL, "--frames", "0", code=FAILED, timeout=240)
        self.assertIn("surface_000000.ply: ends too early", err)
        self.assertIn("blender.log", err)


@unittest.skipIf(NO_BLENDER, NO_BLENDER)
class InBlender(Rendering):
    def setUp(self):
        super().setUp()
        self.mesh()

    def blender(self, script, *arguments):
        """What a script prints as JSON that runs in Blender."""
        (self.folder / "script.py").write_text(script)
        result = subprocess.run([BLENDER, "-b", "--factory-startup", *arguments, "--python-exit-code", "1", "-P",
                                 "script.py"], cwd=self.folder, text=True, capture_output=True, timeout=120,
                                env={**ENVIRONMENT, "PWD": str(self.folder)})
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return json.loads(next(line for line in result.stdout.splitlines() if line.startswith("{")))

    def test_blend_file_holds_the_frames(self):
        self.call("render", "out", *SMALL, "--blend", "film.blend", timeout=240)
        said = self.blender("""
import bpy, json
def shown(frame):
    bpy.context.scene.frame_set(frame)
    return [each.name for each in bpy.data.objects if each.name.startswith("liquid") and not each.hide_render]
one = bpy.data.objects["liquid 000002"].data
print(json.dumps({"shown": [shown(0), shown(2), shown(4)], "camera": bpy.context.scene.camera.name,
                  "kinds": {each.name: each.data_type for each in one.attributes}, "materials": len(one.materials),
                  "floor": len(bpy.data.objects["floor"].data.vertices)}))
""", "film.blend")
        self.assertEqual(said["shown"], [["liquid 000000"], ["liquid 000002"], ["liquid 000004"]])
        self.assertEqual((said["camera"], said["materials"]), ("camera", 1))
        self.assertEqual(said["kinds"]["velocity"], "FLOAT_VECTOR")
        self.assertEqual(said["kinds"]["speed"], "FLOAT")
        self.assertEqual(said["floor"], 8, "a sheet is shown as a slab")

    def test_add_on_follows_the_timeline_and_survives_saving(self):
        said = self.blender("""
import sys; sys.path.insert(0, %r)
import bpy, json, sessile
sessile.register()
scene = bpy.context.scene
scene.render.fps = 100
assert bpy.ops.import_scene.sessile(filepath="out/surface/surface.json", look="oil") == {"FINISHED"}
frames = []
def show(frame):
    bpy.context.scene.frame_set(frame)
    thing = bpy.data.objects["liquid"]
    lowest = min(vertex.co.z for vertex in thing.data.vertices)
    frames.append([thing["sessile_frame"], lowest])
show(0); show(3)
import os
bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath("saved.blend"))
bpy.ops.wm.open_mainfile(filepath=os.path.abspath("saved.blend"))
show(1)
thing = bpy.data.objects["liquid"]
speeds = [item.value for item in thing.data.attributes["speed"].data]
print(json.dumps({"frames": frames, "end": bpy.context.scene.frame_end, "speed": max(speeds),
                  "material": thing.data.materials[0].name, "floor": "floor" in bpy.data.objects,
                  "meshes": len(bpy.data.meshes)}))
sessile.unregister()
""" % str(TOOLS))
        self.assertEqual([frame for frame, _ in said["frames"]], [0, 3, 1])
        self.assertLess(said["frames"][1][1], said["frames"][0][1], "the block falls")
        self.assertEqual((said["end"], said["material"], said["floor"]), (4, "liquid: oil", True))
        self.assertGreater(said["speed"], 0.05)

    def test_add_on_says_what_is_wrong_with_a_folder(self):
        (self.folder / "surface.json").write_text("{}")
        said = self.blender("""
import sys; sys.path.insert(0, %r)
import bpy, json, sessile
sessile.register()
try:
    bpy.ops.import_scene.sessile(filepath="surface.json")
except RuntimeError as fault:
    print(json.dumps({"fault": str(fault)}))
""" % str(TOOLS))
        self.assertIn("surface.json is not what `sessile mesh` writes", said["fault"])


if __name__ == "__main__":
    unittest.main()
