"""tools/picture.py on a tiny run; what needs VTK is skipped where Debian's python3-vtk9 is missing."""
import pathlib
import struct
import subprocess
import sys
import zlib

from sessile_cli import CliTest, tiny, unittest

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools/picture.py"


def with_vtk():
    """A Python that has VTK, or an empty text."""
    for python in (sys.executable, "/usr/bin/python3"):
        if pathlib.Path(python).exists() and subprocess.run([python, "-c", "import vtkmodules"],
                                                            capture_output=True).returncode == 0:
            return python
    return ""


PYTHON = with_vtk()


class Picture(CliTest):
    def draw(self, *arguments, code=0):
        result = subprocess.run([PYTHON, "-B", TOOL, *arguments], cwd=self.folder, env=self.environment(), text=True,
                                capture_output=True, timeout=60)
        self.assertEqual(result.returncode, code, result.stderr)
        return result.stderr

    def pixels(self, name):
        """Width, height and the set of colours of a PNG as the tool writes them."""
        data = (self.folder / name).read_bytes()
        self.assertTrue(data.startswith(b"\x89PNG\r\n\x1a\n"))
        width, height = struct.unpack(">II", data[16:24])
        length = struct.unpack(">I", data[33:37])[0]
        rows = zlib.decompress(data[41:41 + length])
        self.assertEqual(len(rows), height * (1 + 3 * width))
        body = b"".join(rows[y * (1 + 3 * width) + 1:(y + 1) * (1 + 3 * width)] for y in range(height))
        return width, height, {body[k:k + 3] for k in range(0, len(body), 3)}

    @unittest.skipUnless(PYTHON, "no VTK for Python")
    def test_draws(self):
        self.call("run", self.write(tiny()), "-o", "out", "--progress", "none")
        self.draw("out", "--frames", "0,last", "--size", "300x150", "-o", "a.png")
        width, height, colours = self.pixels("a.png")
        self.assertEqual((width, height), (300, 150))
        self.assertTrue(any(c[2] > c[0] + 60 for c in colours), "no liquid: nothing is blue")
        self.assertTrue(any(c[0] > c[2] + 60 for c in colours), "the second frame has no fast liquid: nothing is red")
        self.assertIn(b"\xff\xff\xff", colours)
        self.draw("out", "--field", "height", "--no-solids", "--size", "100x100", "-o", "b.png")
        self.assertLess(len(self.pixels("b.png")[2]), len(colours))

    @unittest.skipUnless(PYTHON, "no VTK for Python")
    def test_says_what_is_wrong(self):
        self.assertEqual(self.draw("out", "-o", "a.png", code=1), "picture.py: out holds no finished run with .vtp frames: "
                                                                  "out/summary.json: No such file or directory\n")
        self.call("run", self.write(tiny()), "-o", "out", "--progress", "none")
        self.assertEqual(self.draw("out", "--frames", "9", "-o", "a.png", code=1),
                         'picture.py: no frame 9: out has the frames 0 to 4, and "last"\n')
        self.assertEqual(self.draw("out", "--field", "colour", "-o", "a.png", code=1), "picture.py: the frames hold no field "
                         "colour; there are speed, height, id, velocity, density, pressure\n")
        self.assertEqual(self.draw("out", "--size", "100x100", "-o", "no/a.png", code=1),
                         "picture.py: no/a.png: No such file or directory\n")
        self.assertIn("invalid pair of numbers AxB value: '12'", self.draw("out", "--size", "12", "-o", "a.png", code=2))

    def test_names_the_package_that_is_missing(self):
        result = subprocess.run([sys.executable, "-B", "-S", "-I", TOOL, "out", "-o", "a.png"], text=True, cwd=self.folder,
                                capture_output=True)  # without site packages there is no VTK
        self.assertEqual(result.returncode, 1)
        self.assertIn("On Debian: apt-get install python3-vtk9", result.stderr)


if __name__ == "__main__":
    unittest.main()
