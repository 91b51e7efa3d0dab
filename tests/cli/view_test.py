"""`sessile view` as a user meets it: in a window of a display in memory, by keys and the mouse."""
import ctypes
import os
import pathlib
import select
import shutil
import subprocess
import time

from png import pixels, unpacked
from sessile_cli import BAD_INPUT, DONE, FAILED, CliTest, tiny, unittest
from stability_test import crushing, thrown

WAIT = 60  # seconds for what should take one or two: the machine may be busy


class Display:
    """A display in memory that belongs to one test."""

    def __init__(self, size="800x600"):
        read, write = os.pipe()
        self.process = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", size + "x24", "-nolisten", "tcp", "-noreset"],
                                        pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        number = b""
        while not number.endswith(b"\n") and select.select([read], [], [], WAIT)[0]:
            more = os.read(read, 16)
            if not more:
                break
            number += more
        os.close(read)
        self.name = ":" + number.decode().strip()

    def end(self):
        self.process.terminate()
        self.process.wait()


class ClientMessage(ctypes.Structure):
    """XClientMessageEvent, with the room of an XEvent."""
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("window", ctypes.c_ulong), ("message_type", ctypes.c_ulong),
                ("format", ctypes.c_int), ("data", ctypes.c_long * 5), ("rest", ctypes.c_long * 24)]


def ask_to_close(display_name, window):
    """What a window manager sends when one presses the cross; there is none on the display in memory."""
    x = ctypes.CDLL("libX11.so.6")
    x.XOpenDisplay.restype = ctypes.c_void_p
    x.XInternAtom.restype = ctypes.c_ulong
    display = ctypes.c_void_p(x.XOpenDisplay(display_name.encode()))
    event = ClientMessage(type=33, window=window, format=32)
    event.message_type = x.XInternAtom(display, b"WM_PROTOCOLS", 0)
    event.data[0] = x.XInternAtom(display, b"WM_DELETE_WINDOW", 0)
    x.XSendEvent(display, ctypes.c_ulong(window), 0, ctypes.c_long(0), ctypes.byref(event))
    x.XSync(display, 0)
    x.XCloseDisplay(display)


@unittest.skipUnless(shutil.which("Xvfb") and shutil.which("xdotool"), "needs Xvfb and xdotool")
class View(CliTest):
    def setUp(self):
        super().setUp()
        self.display = Display()
        self.addCleanup(self.display.end)
        self.assertNotEqual(self.display.name, ":", "Xvfb gave no display")

    def environment(self):
        # Mesa 22.3 drawing in software with threads of its own was seen to hang in the swap of buffers.
        return {**super().environment(), "DISPLAY": self.display.name, "LIBGL_ALWAYS_SOFTWARE": "1", "LP_NUM_THREADS": "0"}

    def xdotool(self, *arguments):
        return subprocess.run(["xdotool", *map(str, arguments)], env=self.environment(), text=True, capture_output=True,
                              timeout=WAIT).stdout.strip()

    def until(self, what, holds):
        """The value of holds() once it is true; fails with `what` when it stays false."""
        end = time.monotonic() + WAIT
        while time.monotonic() < end:
            value = holds()
            if value:
                return value
            if self.viewer.poll() is not None:
                self.fail(f"the window closed while waiting for {what}: {self.viewer.communicate()[1]}")
            time.sleep(0.05)
        self.fail(f"waited in vain for {what}")

    def open(self, *arguments, size="600x400", playing=False):
        start = [] if playing else ["--paused"]
        self.viewer = self.start("view", *arguments, *start, "--size", size, "-o", "shots")
        self.window = self.until("the window", lambda: self.xdotool("search", "--name", "Sessile"))
        self.xdotool("windowfocus", "--sync", self.window)

    def press(self, *keys):
        for key in keys:
            self.xdotool("key", "--window", self.window, key)

    def shots(self, kind=".png"):
        folder = self.folder / "shots"
        files = folder.iterdir() if folder.exists() else ()
        return sorted(path.name for path in files if path.name.endswith(kind) and not path.name.startswith("."))

    def still(self):
        """Presses P and returns the file that comes of it."""
        before = set(self.shots())
        self.press("p")
        return self.folder / "shots" / self.until("a picture", lambda: set(self.shots()) - before).pop()

    def still_at(self, seconds):
        """Saves pictures until one is of that time, as its name tells."""
        return self.until(f"{seconds:.4f} s", lambda: next((f for f in [self.still()] if f"_{seconds:.4f}s" in f.name), None))

    def quit(self):
        # On a busy machine a key was seen to get lost on its way through the display: a user would press it again.
        for _ in range(3):
            self.press("q")
            try:
                out, err = self.viewer.communicate(timeout=WAIT / 3)
                break
            except subprocess.TimeoutExpired:
                waits = [f"{task.name} {(task / 'comm').read_text().strip()}: {(task / 'wchan').read_text()}"
                         for task in pathlib.Path(f"/proc/{self.viewer.pid}/task").iterdir()]
        else:
            self.fail("the window does not close; its threads wait in " + "; ".join(waits))
        self.assertEqual((self.viewer.returncode, out, err), (DONE, "", ""))

    def coloured(self, path):
        """How many pixels of a picture are those of particles: neither grey nor nearly so."""
        return sum(count for colour, count in pixels(path).items() if max(colour) - min(colour) > 60)

    def test_steps_a_scene_and_saves_pictures(self):
        self.open(self.write(tiny()))
        first = self.still_at(0)
        self.assertEqual(first.name, "view_s_0.0000s.png")
        width, height, _, _ = unpacked(first)
        self.assertLess(width, 600)  # the panel is not among it
        self.assertLess(height, 400)
        with_legend = self.coloured(first)
        self.press("l")
        without = self.coloured(self.still())
        self.assertGreater(without, 200, "no particles")
        self.assertGreater(with_legend, without + 200, "no legend")
        self.press("period")
        self.still_at(0.005)
        self.press("Right", "Right")
        self.still_at(0.015)
        self.press("r")
        self.still_at(0)
        self.quit()

    def test_plays_to_the_end(self):
        self.open(self.write(tiny()))
        self.press("space")
        self.still_at(0.04)
        self.quit()

    def test_looks_and_turns(self):
        self.open(self.write(tiny()))
        self.press("Tab")  # the picture fills the width
        seen = set()

        def unlike_before():
            """The still, once it differs from all before: what a key asks for may take some frames."""
            path = self.still()
            return path if path.read_bytes() not in seen else None

        for name, keys in {"start": [], "along x": ["x"], "along z": ["z"], "liquid": ["2"], "surface": ["3"],
                           "open": ["1", "c"], "flat": ["c", "o"]}.items():
            self.press(*keys)
            path = self.until(f"{name} to look new", unlike_before)
            self.assertEqual(unpacked(path)[0], 600)
            self.assertGreater(len(pixels(path)), 30, f"{name}: blank")
            seen.add(path.read_bytes())
        for event in (("mousemove", "--window", self.window, 300, 150), ("mousedown", 1),
                      ("mousemove", "--window", self.window, 330, 170), ("mousemove", "--window", self.window, 360, 190),
                      ("mouseup", 1)):
            self.xdotool(*event)
            time.sleep(0.5)  # no hand is faster than the window draws
        before = self.coloured(self.until("a drag to turn it", unlike_before))
        for _ in range(4):
            self.xdotool("click", 4)
        self.until("the wheel to bring it nearer", lambda: self.coloured(self.still()) > 1.3 * before)
        self.quit()

    def test_plays_results_and_films_them(self):
        self.call("run", self.write(tiny()), "-o", "out", "--progress", "none")
        self.open("out")
        self.assertEqual(self.still_at(0).name, "view_out_0.0000s.png")
        self.press("period")
        self.still_at(0.01)
        self.press("Left")
        self.still_at(0)
        filmed = shutil.which("ffmpeg") is not None
        if filmed:
            self.press("v")
        for k in range(1, 5):
            self.press("period")
            self.still_at(0.01 * k)
        if filmed:
            self.press("v")
            film = self.folder / "shots" / self.until("the video", lambda: self.shots(".mp4")).pop()
            frames = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames",
                                     "-of", "csv=p=0", film], text=True, capture_output=True).stdout.strip()
            self.assertEqual(frames, "5")
        self.quit()

    def test_finds_the_frames_that_a_run_still_writes(self):
        self.call("run", self.write(tiny()), "-o", "all", "--progress", "none")
        late = ["frame_000003.vtp", "frame_000004.vtp"]
        shutil.copytree(self.folder / "all", self.folder / "out",
                        ignore=lambda folder, names: [n for n in names if n in late or n.endswith(".ply")])
        self.open("out")
        self.press("period", "period")
        self.still_at(0.02)
        self.press("period")
        self.still_at(0.02)
        for name in late:
            shutil.copy(self.folder / "all" / name, self.folder / "out")

        def later():
            self.press("period")
            return "_0.0200s" not in self.still().name

        self.until("a later frame", later)
        self.quit()

    def test_films_a_simulation(self):
        if not shutil.which("ffmpeg"):
            self.skipTest("needs ffmpeg")
        self.open(self.write(tiny(time={"end": 100, "fixed_dt": 0.005})), playing=True)
        self.press("v")
        time.sleep(1)
        self.press("v")
        film = self.folder / "shots" / self.until("the video", lambda: self.shots(".mp4")).pop()
        self.assertGreater(film.stat().st_size, 1000)
        self.quit()

    def test_survives_other_sizes(self):
        self.open(self.write(tiny()), playing=True)
        for width, height in ((790, 590), (330, 250), (500, 300)):
            self.xdotool("windowsize", "--sync", self.window, width, height)
            time.sleep(0.3)
        path = self.until("the size", lambda: next((f for f in [self.still()] if unpacked(f)[1] < 300), None))
        self.assertGreater(self.coloured(path), 50)
        self.quit()

    def test_shows_a_scene_that_has_no_liquid_yet_and_one_that_has_lost_it(self):
        later = tiny(bodies=[], emitters=[{"shape": {"type": "rectangle", "width": 0.3, "depth": 0.3},
                                           "placement": {"position": [0, 0, 0.5]}, "velocity": [0, 0, -1], "times": [0.02]}])
        self.open(self.write(later))
        self.assertGreater(len(pixels(self.still())), 30)
        self.press("2", "f", "space")
        self.still_at(0.04)
        self.quit()
        gone = tiny(domain={"min": [-1, -1, 0.3], "max": [1, 1, 1]}, solids=[], gravity=[0, 0, -2000])
        self.open(self.write(gone, "gone.json"))
        self.press("space", "f")
        self.still_at(0.04)
        self.press("3", "f")
        self.assertGreater(len(pixels(self.still())), 30)
        self.quit()

    def test_shows_why_a_step_failed(self):
        wild = tiny(time={"end": 1e31, "fixed_dt": 1e30, "dt_max": 1e31}, gravity=[0, 0, -1e30],
                    output={"frame_interval": 1e30})
        self.open(self.write(wild))
        self.press("space")
        time.sleep(1)
        self.still_at(0)  # the last good moment
        self.quit()

    def test_opens_what_a_run_that_went_unstable_kept(self):
        for scene in (thrown(), crushing()):
            self.call("run", self.write(scene), "-o", "out", "--progress", "none", code=FAILED)
            self.open("out/fault")
            good = self.still()
            self.press("period")
            self.until("the faulty state", lambda: self.still().name != good.name)
            self.quit()

    def test_ends_when_its_window_is_closed(self):
        self.open(self.write(tiny()), playing=True)
        ask_to_close(self.display.name, int(self.window.splitlines()[0]))
        out, err = self.viewer.communicate(timeout=WAIT)
        self.assertEqual((self.viewer.returncode, out, err), (DONE, "", ""))

    def test_ends_after_so_many_frames(self):
        self.call("view", self.write(tiny()), "--frames", "3", "--size", "400x300")
        self.call("view", "s.json", "--frames", "5", "--look", "surface", "--field", "density")


class ViewWithoutDisplay(CliTest):
    def environment(self):
        kept = {k: v for k, v in super().environment().items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        return kept

    def test_says_so(self):
        _, err = self.call("view", self.write(tiny()), code=FAILED)
        self.assertEqual(len(err.splitlines()), 1, err)
        self.assertIn("no window can be opened", err)
        self.assertIn("`sessile picture` makes pictures without a display", err)

    def test_refuses_what_is_wrong(self):
        self.assertIn("spacing", self.refused("view", self.write(tiny(spacing=-1)))[0])
        self.call("view", "nowhere.json", code=BAD_INPUT)
        (self.folder / "empty").mkdir()
        _, err = self.call("view", "empty", code=FAILED)
        self.assertIn("empty holds neither scene.json nor summary.json", err)
        _, err = self.call("view", self.write(tiny()), "--size", "big", code=BAD_INPUT)
        self.assertIn("must be WIDTHxHEIGHT", err)
        _, err = self.call("view", "empty", "--set", "time.end=2", code=BAD_INPUT)
        self.assertIn("--set", err)

    def test_lists_its_keys(self):
        out, _ = self.call("view", "--help")
        for word in ("Space", "F12", "play or pause", "wheel"):
            self.assertIn(word, out)


if __name__ == "__main__":
    unittest.main()
