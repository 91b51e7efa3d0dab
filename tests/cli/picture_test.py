"""sessile picture: what is in its pictures and videos, what it says of bad input."""
import os
import shutil
import stat
import subprocess
import time

import png
from sessile_cli import FAILED, INTERRUPTED, CliTest, signal, tiny, unittest

FAST = ("--fineness", "1")
SMALL = ("--size", "240x160", *FAST)


def is_blue(color):
    return color[2] > color[0] + 40


def is_yellow(color):
    return min(color[0], color[1]) > color[2] + 80


class Picture(CliTest):
    def setUp(self):
        super().setUp()
        self.write(tiny())

    def run_scene(self):
        self.call("run", "s.json", "-o", "out", "--progress", "none")

    def draw(self, *arguments, name="a.png", **more):
        """The rows of a picture drawn with these arguments."""
        self.call("picture", *arguments, "-o", name, "--progress", "none", **more)
        return png.image(self.folder / name)[2]

    def test_particles_are_where_they_must_be(self):
        self.run_scene()
        width, height = 600, 400
        rows = self.draw("out", "--frame", 0, "--size", f"{width}x{height}", "--view", "0,0", "--orthographic",
                         "--no-legend", "--fineness", 1)
        # Seen along y: x from -0.55 to 0.55 m and z from -0.05 to 0.7 m, plate and block with half a spacing around
        # them, fill 0.94 of the height.
        scale = min(0.94 * width / 1.1, 0.94 * height / 0.75)

        def at(x, z):
            return rows[round(height / 2 - scale * (z - 0.325))][round(width / 2 + scale * x)]

        for z in (0.4, 0.5, 0.6):
            for x in (-0.1, 0, 0.1):
                self.assertTrue(is_blue(at(x, z)), f"no particle at {x}, {z}: {at(x, z)}")
            for x in (-0.2, 0.2):
                self.assertFalse(is_blue(at(x, z)), f"a particle at {x}, {z}: {at(x, z)}")
        for x in (-0.05, 0.05):  # where four spheres leave a gap
            self.assertFalse(is_blue(at(x, 0.45)), f"no gap at {x}, 0.45: {at(x, 0.45)}")

    def test_a_scene_that_goes_wrong_has_none(self):
        self.write(tiny(gravity=[0, 0, -3e38], time={"end": 1e4, "fixed_dt": 1e3}), "crushing.json")
        self.write(tiny(time={"end": 0.05, "fixed_dt": 0.01}, gravity=[0, 0, 0], stability={"speed": False},
                        bodies=[{"shape": {"type": "box", "size": [0.3, 0.3, 0.3]}, "placement": {"position": [0, 0, 0.5]},
                                 "velocity": [0, 0, -100]}]), "shot.json")
        for scene, message in (("crushing.json", r"\Asessile: 27 of 27 particles have no finite position, .*\. A smaller "
                                                 r"time\.fixed_dt may [^`]*\n\Z"),
                               ("shot.json", r"\Asessile: particle \d+ passed through the solid \"floor\" in step 1 .*`--set "
                                             r"stability\.passages=false`")):
            _, err = self.call("picture", scene, "-o", "a.png", "--progress", "none", code=FAILED)
            self.assertRegex(err, message)
            self.assertFalse((self.folder / "a.png").exists())

    @unittest.skipIf(os.geteuid() != 0, "only root makes devices")
    def test_a_device_is_written_into(self):
        os.mknod(self.folder / "a.png", 0o666 | stat.S_IFCHR, os.makedev(1, 3))
        self.call("picture", "s.json", "-o", "a.png", "--time", 0.005, "--progress", "none")
        self.assertTrue(stat.S_ISCHR((self.folder / "a.png").stat().st_mode))
        self.assertEqual([path.name for path in self.folder.glob(".*")], [])

    def test_looks_and_options_change_the_picture(self):
        self.run_scene()
        pictures = {}
        for name, arguments in {"plain": (), "again": (), "liquid": ("--look", "liquid"), "surface": ("--look", "surface"),
                                "first": ("--frame", 0), "time": ("--time", 0),
                                "last": ("--frame", -1), "height": ("--field", "height"),
                                "range": ("--range", "0,0.1"), "bare": ("--no-solids",), "mute": ("--no-legend",),
                                "view": ("--view", "70,10"), "near": ("--zoom", 2), "flat": ("--orthographic",),
                                "fine": ("--fineness", 2)}.items():
            small = SMALL[:2] if name == "fine" else SMALL
            pictures[name] = self.draw("out", *small, *arguments, name=name + ".png")
            self.assertGreater(len({c for row in pictures[name] for c in row}), 50, f"{name} is blank")
        self.assertEqual(pictures.pop("again"), pictures["plain"])
        self.assertEqual(pictures.pop("last"), pictures["plain"])
        self.assertEqual(pictures.pop("time"), pictures["first"])
        names = sorted(pictures)
        for k, one in enumerate(names):
            for other in names[k + 1:]:
                self.assertNotEqual(pictures[one], pictures[other], f"{one} and {other}")

    def test_legend(self):
        self.run_scene()
        for size in ("1280x720", "640x360"):
            with_legend = self.draw("out", "--size", size, "--fineness", 1, "--frame", 0)
            without = self.draw("out", "--size", size, "--fineness", 1, "--frame", 0, "--no-legend")
            high = len(with_legend)
            bar = [c for row in with_legend[-high // 6:] for c in row if is_yellow(c)]
            self.assertGreater(len(bar), high // 6, "no colour bar")
            self.assertFalse([c for row in without for c in row if is_yellow(c)])
            dark = [c for row in with_legend[:high // 12] for c in row[:len(row) // 5] if max(c) < 110]
            self.assertGreater(len(dark), high // 10, "the time is not written")
            self.assertFalse([c for row in without[:high // 12] for c in row if max(c) < 110])

    def test_size_and_panels(self):
        self.run_scene()
        self.draw("out", "--size", "301x171", "--fineness", 1, "--frames", "0,2,-1")
        width, height, rows = png.image(self.folder / "a.png")
        self.assertEqual((width, height), (301, 171))
        for left in (0, 100, 200):
            panel = [c for row in rows for c in row[left:left + 100]]
            self.assertTrue(any(is_blue(c) for c in panel), f"no liquid in the panel at {left}")

    def test_scene_is_run_for_its_picture(self):
        first = self.draw("s.json", *SMALL, "--time", 0, name="first.png")
        end = self.draw("s.json", *SMALL, name="end.png")
        self.assertNotEqual(first, end)
        self.assertEqual(self.names("."), ["end.png", "first.png", "s.json"])
        self.run_scene()
        self.assertEqual(self.draw("out", *SMALL, name="folder.png"), end)
        thick = self.draw("s.json", *SMALL, "--set", "gravity=[0,0,0]", name="set.png")
        self.assertNotEqual(thick, end)
        _, words = self.call("picture", "s.json", *SMALL, "-o", "b.png", "--progress", "plain")
        self.assertIn("100.0 %", words)

    def test_nothing_to_see_draws_the_background(self):
        self.write(tiny(bodies=[], solids=[], emitters=[{"shape": {"type": "disc", "radius": 0.2}, "times": [0.03],
                                                         "placement": {"position": [0, 0, 1]}}]))
        self.draw("s.json", *SMALL, "--time", 0.01)
        for look in ("liquid", "surface"):
            self.draw("s.json", *SMALL, "--time", 0.01, "--look", look)

    def test_scale_does_not_matter(self):
        """A scene in tenths of millimetres looks as one in metres."""

        def scaled(factor):
            scene = tiny(spacing=0.1 * factor, forces=[], gravity=[0, 0, 0])
            scene["bodies"][0]["shape"]["size"] = [0.3 * factor] * 3
            scene["bodies"][0]["placement"]["position"] = [0, 0, 0.5 * factor]
            scene["solids"][0]["shape"].update(width=factor, depth=factor)
            return self.write(scene)

        for look in ("particles", "liquid"):
            pictures = [self.draw(scaled(factor), *SMALL, "--time", 0, "--look", look) for factor in (1, 1e-4, 1e3)]
            for other in pictures[1:]:
                far = sum(max(abs(a - b) for a, b in zip(p, q)) > 12
                          for one, two in zip(pictures[0], other) for p, q in zip(one, two))
                self.assertLess(far, 0.01 * 240 * 160, look)

    @unittest.skipUnless(shutil.which("ffprobe"), "no ffprobe")
    def test_video(self):
        self.run_scene()

        def frames(*arguments, size="240x160"):
            self.call("picture", *arguments, "--size", size, *FAST, "--video", "v.mp4", "--progress", "none")
            probe = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries",
                                    "stream=nb_read_frames,width,height,codec_name", "-of", "csv=p=0", "v.mp4"],
                                   cwd=self.folder, capture_output=True, text=True, check=True)
            return probe.stdout.strip()

        self.assertEqual(frames("out"), "h264,240,160,5")
        self.assertEqual(frames("out", "--frames", "1:3"), "h264,240,160,2")
        self.assertEqual(frames("out", "--look", "liquid", size="241x161"), "h264,242,162,5")
        self.assertEqual(frames("s.json", "--fps", 100), "h264,240,160,5")  # 0, 0.01 ... 0.04 s
        self.assertEqual(self.names("."), ["out", "s.json", "v.mp4"])

    @unittest.skipUnless(shutil.which("ffmpeg"), "no ffmpeg")
    def test_interrupted_video_is_whole(self):
        scene = tiny()
        scene["time"]["end"] = 1000
        process = self.start("picture", self.write(scene), *SMALL, "--video", "v.mp4", "--progress", "plain")
        process.stderr.readline()
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        _, words = process.communicate(timeout=60)
        self.assertEqual(process.returncode, INTERRUPTED, words)
        self.assertEqual(self.names("."), ["s.json", "v.mp4"])
        self.assertIn("interrupted; the video holds", words)

    def test_bad_input(self):
        self.run_scene()
        for arguments, words in {
            ("nowhere", "-o", "a.png"): "nowhere",
            ("out",): "name the file to write: -o FILE.png, or --video FILE.mp4",
            ("out", "-o", "a.png", "--video", "v.mp4"): "not both",
            ("out", "-o", "a.jpg"): "pictures are PNG: name a file .png, found a.jpg",
            ("out", "--video", "v.avi"): "videos are MP4: name a file .mp4, found v.avi",
            ("out", "-o", "a.png", "--field", "sped"): 'there is no field "sped" (did you mean "speed"?)',
            ("s.json", "-o", "a.png", "--field", "colour"): 'there is no field "colour"',
            ("out", "-o", "a.png", "--frame", "9"): "there is no frame 9: there are 5",
            ("out", "-o", "a.png", "--frame", "x"): "expected frames such as",
            ("out", "-o", "a.png", "--frame", "1", "--time", "0"): "not both",
            ("out", "-o", "a.png", "--look", "liqid"): 'did you mean "liquid"?',
            ("out", "-o", "a.png", "--look", "liquid", "--field", "speed"): "own colour",
            ("out", "-o", "a.png", "--size", "12"): "two whole numbers such as 1280x720",
            ("out", "-o", "a.png", "--size", "1x9000"): "sides must be from 16 to 8192 pixels",
            ("out", "-o", "a.png", "--size", "8000x80", "--fineness", "4"): "must not exceed 16384, found 32000",
            ("out/frame_000000.vtp", "-o", "a.png"): "is one frame; give its folder",
            ("out", "-o", "a.png", "--range", "2,1"): "must ascend",
            ("out", "-o", "a.png", "--view", "0,95"): "below 90 degrees",
            ("out", "-o", "a.png", "--time", "-1"): "before 0 s",
            ("out", "-o", "a.png", "--set", "spacing=1"): "--set is for scenes",
            ("s.json", "--video", "v.mp4", "--frames", "0:2"): "--time says where it ends",
        }.items():
            self.assertIn(words, "\n".join(self.refused("picture", *arguments)), arguments)

    def test_trouble(self):
        self.run_scene()
        _, words = self.call("picture", "out", *SMALL, "-o", "no/a.png", code=FAILED)
        self.assertIn("no/a.png", words)
        _, words = self.call("picture", "out", *SMALL, "--video", "v.mp4", code=FAILED, before="PATH=")
        self.assertIn("the program ffmpeg is not there; on Debian, apt-get install ffmpeg brings it", words)
        _, words = self.call("picture", "out", *SMALL, "--video", "no/v.mp4", code=FAILED)
        self.assertIn("no/v.mp4", words)
        _, words = self.call("picture", "out", *SMALL, "-o", "a.png", code=FAILED,
                             before="export __EGL_VENDOR_LIBRARY_FILENAMES=/nowhere")
        self.assertIn("libgl1-mesa-dri", words)
        self.assertEqual(len(words.splitlines()), 1)
        self.assertEqual(self.names("."), ["out", "s.json"])


if __name__ == "__main__":
    unittest.main()
