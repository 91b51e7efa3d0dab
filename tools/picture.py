#!/usr/bin/python3
"""Makes a picture of a run from its frames: particles as shaded spheres, solids as a pale surface.

    tools/picture.py results/tablet --frames 5,14,last --range 0,4 --size 1200x440 -o docs/tablet.png

Reads RESULTS/frames.pvd, its .vtp frames, solids.vtp and summary.json. Needs the Debian package python3-vtk9, which reads
the frames and draws the letters. Debian's VTK renders in 3D only with an X display; the spheres are drawn here instead, so
no display is needed.
"""
import argparse
import json
import math
import os
import struct
import sys
import xml.etree.ElementTree
import zlib

try:
    from vtkmodules.vtkCommonCore import vtkDataArray
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    from vtkmodules.vtkRenderingCore import vtkTextProperty
    from vtkmodules.vtkRenderingFreeType import vtkFreeTypeTools
except ImportError as error:
    sys.exit(f"picture.py: no VTK for {sys.executable} ({error}). On Debian: apt-get install python3-vtk9, and run this "
             "with /usr/bin/python3.")

FINE = 3                     # rays a pixel, along each axis
WALL = (222, 219, 213)       # colour of solids
INK = (0.2, 0.2, 0.22)       # of letters
RAMP = ((36, 88, 168), (43, 134, 196), (92, 190, 203), (199, 229, 186), (254, 209, 110), (240, 114, 58))


class Fault(Exception):
    pass


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def unit(a):
    length = math.sqrt(dot(a, a))
    return tuple(x / length for x in a)


def rows(array):
    """A VTK array as a list of tuples."""
    if array is None or array.GetNumberOfTuples() == 0:
        return []
    flat, n = memoryview(array).cast("B").cast(memoryview(array).format), array.GetNumberOfComponents()
    return list(zip(*(flat[k::n].tolist() for k in range(n))))


def read_points(path):
    if not os.path.exists(path):
        raise Fault(f"{path}: no such file")
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    if reader.GetErrorCode() != 0:
        raise Fault(f"{path}: VTK cannot read it")
    data = reader.GetOutput()
    return (rows(data.GetPoints().GetData()) if data.GetNumberOfPoints() else []), data.GetPointData()


def read_run(folder, words):
    """The scene's spacing and up axis, the chosen frames as (time, path), and the solids' samples."""
    pvd = os.path.join(folder, "frames.pvd")
    try:
        with open(os.path.join(folder, "summary.json")) as file:
            scene = json.load(file)["scene"]
        listed = xml.etree.ElementTree.parse(pvd).getroot().iter("DataSet")
    except OSError as error:
        raise Fault(f"{folder} holds no finished run with .vtp frames: {error.filename}: {error.strerror}")
    except (ValueError, KeyError, TypeError, xml.etree.ElementTree.ParseError) as error:
        raise Fault(f"{folder} holds a run that cannot be read: {error}")
    frames = [(float(entry.get("timestep")), os.path.join(folder, entry.get("file"))) for entry in listed]
    chosen = []
    for word in words.split(","):
        if word != "last" and not (word.isdigit() and int(word) < len(frames)):
            raise Fault(f"no frame {word}: {folder} has the frames 0 to {len(frames) - 1}, and \"last\"")
        chosen.append(frames[-1 if word == "last" else int(word)])
    gravity = scene.get("gravity", [0, 0, -1])
    up = unit([-x for x in gravity]) if any(gravity) else (0.0, 0.0, 1.0)
    solids = os.path.join(folder, "solids.vtp")
    return scene["spacing"], up, chosen, read_points(solids)[0] if os.path.exists(solids) else []


def values_of(name, points, data, up):
    """One number a particle, and its unit. Vectors are shown by their length."""
    if name == "height":
        return [dot(p, up) for p in points], "m"
    array = data.GetArray("velocity" if name == "speed" and not data.GetArray("speed") else name)
    if array is None:
        there = ", ".join(["speed", "height"] + [data.GetArrayName(k) for k in range(data.GetNumberOfArrays())])
        raise Fault(f"the frames hold no field {name}; there are {there}")
    label = array.GetInformation().Get(vtkDataArray.UNITS_LABEL()) or ""
    return [r[0] if len(r) == 1 else math.sqrt(sum(x * x for x in r)) for r in rows(array)], label


def ramp(share):
    place = min(max(share, 0.0), 1.0) * (len(RAMP) - 1)
    k = min(int(place), len(RAMP) - 2)
    return tuple(a + (b - a) * (place - k) for a, b in zip(RAMP[k], RAMP[k + 1]))


class Camera:
    """Looks at all points in perspective; fitted so that they fill a panel."""

    def __init__(self, points, radius, up, azimuth, elevation, width, height):
        side = unit(cross((0, 1, 0) if abs(up[1]) < 0.9 else (1, 0, 0), up))
        front = cross(up, side)
        a, e = math.radians(azimuth), math.radians(elevation)
        flat = [math.sin(a) * s - math.cos(a) * f for s, f in zip(side, front)]
        self.back = tuple(math.cos(e) * x + math.sin(e) * u for x, u in zip(flat, up))
        self.right = unit(cross(up, self.back))
        self.top = cross(self.back, self.right)
        centre = [(min(p[k] for p in points) + max(p[k] for p in points)) / 2 for k in range(3)]
        reach = max(math.dist(p, centre) for p in points) + radius
        self.eye = tuple(c + 3.2 * reach * b for c, b in zip(centre, self.back))
        self.scale, self.x0, self.y0 = 1.0, 0.0, 0.0
        seen = [self.project(p) for p in points]
        low_x, high_x = min(p[0] for p in seen), max(p[0] for p in seen)
        low_y, high_y = min(p[1] for p in seen), max(p[1] for p in seen)
        margin = 2 * radius / (3 * reach)
        self.scale = min(0.96 * width / (high_x - low_x + margin), height / (high_y - low_y + margin))
        self.x0 = width / 2 - self.scale * (low_x + high_x) / 2
        self.y0 = height / 2 - self.scale * (low_y + high_y) / 2

    def project(self, p):
        """Place in the panel, downwards, and distance from the eye."""
        d = [x - e for x, e in zip(p, self.eye)]
        depth = -dot(d, self.back)
        return self.x0 + self.scale * dot(d, self.right) / depth, self.y0 - self.scale * dot(d, self.top) / depth, depth


def lit_shares(points, radius, light):
    """Share of the light that reaches each sphere: a depth map along the light, looked up around each."""
    a = unit(cross(light, (0.3, 0.5, 0.8)))
    b = cross(light, a)
    step, reach = radius / 2, 3
    around = [(i, j) for i in range(-reach, reach + 1) for j in range(-reach, reach + 1) if i * i + j * j <= reach * reach]
    nearest, places = {}, []
    for p in points:
        u, v, w = round(dot(p, a) / step), round(dot(p, b) / step), dot(p, light)
        places.append((u, v, w))
        for i, j in around:
            if i * i + j * j <= 5 and nearest.get((u + i, v + j), -1e300) < w:
                nearest[u + i, v + j] = w
    return [sum(nearest.get((u + i, v + j), -1e300) < w + 2.5 * radius for i, j in around) / len(around)
            for u, v, w in places]


def draw(spheres, radius, camera, light, width, height):
    """The spheres (place, colour, share of light) as rows of RGB bytes, seen by the camera."""
    far, half = 1e300, 24
    depth_of, colour_of = [far] * (width * height), [(255, 255, 255)] * (width * height)
    lamp = (dot(light, camera.right), dot(light, camera.top), dot(light, camera.back))
    bright = unit([a + b for a, b in zip(lamp, (0, 0, 1))])
    shades = {}
    for i in range(-half, half + 1):  # over the disc of a sphere: depth, diffuse and mirrored light
        for j in range(-half, half + 1):
            x, y = i / half, -j / half
            z = math.sqrt(max(0.0, 1 - x * x - y * y))
            shine = max(0.0, dot((x, y, z), bright)) ** 40
            shades[i, j] = z, max(0.0, dot((x, y, z), lamp)), 0.62 + 0.2 * z, 60 * shine
    for place, colour, lit, gloss in spheres:
        cx, cy, depth = camera.project(place)
        size = camera.scale * radius / depth
        to_table = half / size
        palette = {}
        for py in range(max(0, math.ceil(cy - size)), min(height - 1, math.floor(cy + size)) + 1):
            dy = py - cy
            reach = math.sqrt(max(0.0, size * size - dy * dy))
            j = round(dy * to_table)
            for px in range(max(0, math.ceil(cx - reach)), min(width - 1, math.floor(cx + reach)) + 1):
                spot = round((px - cx) * to_table), j
                shade = shades[spot]
                z = depth - radius * shade[0]
                at = py * width + px
                if z < depth_of[at]:
                    depth_of[at] = z
                    found = palette.get(spot)
                    if found is None:
                        light_here = shade[2] * (0.55 + 0.33 * lit) + 0.42 * lit * shade[1]
                        extra = gloss * lit * shade[3]
                        found = tuple(min(255, int(light_here * c + extra)) for c in colour)
                        palette[spot] = found
                    colour_of[at] = found
    return colour_of


class Canvas:
    """RGB pixels from the top left."""

    def __init__(self, width, height):
        self.width, self.height, self.bytes = width, height, bytearray(b"\xff" * (3 * width * height))

    def put_fine(self, pixels, left, top, width, height):
        """Puts a panel drawn with FINE^2 rays a pixel."""
        wide, share = FINE * width, FINE * FINE
        for y in range(height):
            for x in range(width):
                block = [pixels[(FINE * y + k) * wide + FINE * x + m] for k in range(FINE) for m in range(FINE)]
                at = 3 * ((top + y) * self.width + left + x)
                self.bytes[at:at + 3] = bytes(sum(c[k] for c in block) // share for k in range(3))

    def write(self, text, x, y, size, bold=False):
        """Letters centred on a place."""
        style = vtkTextProperty()
        style.SetFontSize(size)
        style.SetBold(bold)
        style.SetColor(*INK)
        image = vtkImageData()
        vtkFreeTypeTools.GetInstance().RenderString(style, text, 72, image, [0, 0])
        wide, high, _ = image.GetDimensions()
        ink = rows(image.GetPointData().GetScalars())
        low_y = image.GetExtent()[2]
        used = [(k % wide, k // wide, c) for k, c in enumerate(ink) if c[3] > 0]
        if not used:
            return
        centre = (min(u[0] for u in used) + max(u[0] for u in used)) // 2
        for column, row, colour in used:
            px, py = x + column - centre, y + size // 3 - (row + low_y)
            if 0 <= px < self.width and 0 <= py < self.height:
                at, cover = 3 * (py * self.width + px), colour[3] / 255
                for k in range(3):
                    self.bytes[at + k] = round(cover * colour[k] + (1 - cover) * self.bytes[at + k])

    def bar(self, left, top, width, height):
        for x in range(width):
            colour = bytes(map(int, ramp(x / (width - 1))))
            for y in range(height):
                at = 3 * ((top + y) * self.width + left + x)
                self.bytes[at:at + 3] = colour

    def save(self, path):
        lines = b"".join(b"\0" + self.bytes[3 * y * self.width:][:3 * self.width] for y in range(self.height))

        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

        head = struct.pack(">IIBBBBB", self.width, self.height, 8, 2, 0, 0, 0)
        with open(path, "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines, 9)) +
                       chunk(b"IEND", b""))


def picture(options):
    width, height = options.size
    spacing, up, frames, walls = read_run(options.results, options.frames)
    walls = [] if options.no_solids else walls
    radius = spacing / 2
    panels = []
    for time, path in frames:
        points, data = read_points(path)
        values, label = values_of(options.field, points, data, up)
        panels.append((time, points, values))
    shown = [p for _, points, _ in panels for p in points] + walls
    if not shown:
        raise Fault("these frames hold no particles")
    every = [v for _, _, values in panels for v in values] or [0.0]
    low, high = options.range or (0.0 if options.field == "speed" else min(every), max(every))
    high = high if high > low else low + 1

    top, bottom, panel = height // 10, height // 7, width // len(panels)
    inner = height - top - bottom
    camera = Camera(shown, radius, up, *options.view, FINE * panel, FINE * inner)
    light = unit([0.9 * u + 0.35 * r + 0.3 * b for u, r, b in zip(up, camera.right, camera.back)])
    canvas = Canvas(width, height)
    for number, (time, points, values) in enumerate(panels):
        shares = lit_shares(points + walls, radius, light)
        spheres = [(p, ramp((v - low) / (high - low)), s, 1) for p, v, s in zip(points, values, shares)]
        spheres += [(p, WALL, s, 0) for p, s in zip(walls, shares[len(points):])]
        pixels = draw(spheres, radius, camera, light, FINE * panel, FINE * inner)
        canvas.put_fine(pixels, number * panel, top, panel, inner)
        canvas.write(f"t = {time:.2f} s", number * panel + panel // 2, top // 2, max(12, height // 26))
    bar, letters = width // 4, max(11, height // 32)
    left, line = (width - bar) // 2, height - bottom // 2
    canvas.bar(left, line - letters // 2, bar, letters)
    for value, end, side, beyond in ((low, left, -1, min(every) < low), (high, left + bar, 1, max(every) > high)):
        canvas.write(f"{value:.3g}" + (" and more" if beyond and side > 0 else " and less" if beyond else ""),
                     end + side * (5 if beyond else 2) * letters, line, letters)
    canvas.write(options.field + (f" [{label}]" if label else ""), width // 2, line + int(1.5 * letters), letters)
    canvas.save(options.output)


def numbers(separator, kind):
    def parse(word):
        first, second = map(kind, word.split(separator))
        return first, second

    parse.__name__ = f"pair of numbers A{separator}B"  # argparse's messages say so
    return parse


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", help="folder of a run")
    parser.add_argument("--frames", "--frame", default="last", metavar="N,...",
                        help="numbers from 0, or last; several stand side by side")
    parser.add_argument("--field", default="speed", help="what the colour shows: speed, height, or a field of the frames")
    parser.add_argument("--range", type=numbers(",", float), metavar="LOW,HIGH",
                        help="ends of the colours (default: what the frames hold)")
    parser.add_argument("--view", type=numbers(",", float), default=(15, 42), metavar="A,E",
                        help="azimuth and elevation of the camera in degrees (default: 15,42)")
    parser.add_argument("--size", type=numbers("x", int), default=(1200, 500), metavar="WIDTHxHEIGHT",
                        help="in pixels (default: 1200x500)")
    parser.add_argument("--no-solids", action="store_true", help="leaves out solids, which may hide what they hold")
    parser.add_argument("-o", "--output", required=True, help="the .png to write")
    options = parser.parse_args()
    if not (len(options.frames.split(",")) * 50 <= options.size[0] <= 10000 and 100 <= options.size[1] <= 10000):
        parser.error("--size must be from 50x100 a frame to 10000x10000")
    try:
        picture(options)
    except Fault as error:
        sys.exit(f"picture.py: {error}")
    except OSError as error:
        sys.exit(f"picture.py: {error.filename}: {error.strerror}")


if __name__ == "__main__":
    main()
