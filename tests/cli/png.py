"""Reads what a PNG shows."""
import collections
import struct
import zlib


def unfilter(kind, line, above, channels):
    """Takes back PNG's filter of a line."""
    if kind == 2:
        line[:] = bytes((a + b) & 255 for a, b in zip(line, above))
        return
    for x in range(len(line)) if kind else ():
        left, corner = (line[x - channels], above[x - channels]) if x >= channels else (0, 0)
        up, guess = above[x], left + above[x] - corner
        near = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
        line[x] = (line[x] + (0, left, up, (left + up) // 2, near)[kind]) & 255


def unpacked(path):
    """Width, height, channels and the filtered bytes of a PNG of 8-bit RGB or RGBA."""
    data = path.read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n"), path
    at, packed, width, height, channels = 8, b"", 0, 0, 0
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
            channels = {2: 3, 6: 4}[colour]
            assert depth == 8
        if kind == b"IDAT":
            packed += body
        at += 12 + size
    return width, height, channels, zlib.decompress(packed)


def image(path):
    """Width, height and the rows of a PNG, each a list of (red, green, blue)."""
    width, height, channels, raw = unpacked(path)
    stride, rows, above = width * channels, [], bytes(width * channels)
    for y in range(height):
        line = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        unfilter(raw[y * (stride + 1)], line, above, channels)
        rows.append(list(zip(line[0::channels], line[1::channels], line[2::channels])))
        above = bytes(line)
    return width, height, rows


def pixels(path):
    """How often each colour stands in a PNG."""
    width, height, channels, raw = unpacked(path)
    stride, counts = width * channels, collections.Counter()
    previous, colours = bytes(stride), collections.Counter({(0, 0, 0): width})
    for y in range(height):
        kind = raw[y * (stride + 1)]
        line = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        if kind != 2 or any(line):  # else the line above once more
            unfilter(kind, line, previous, channels)
            colours = collections.Counter(zip(*(line[k::channels] for k in range(3))))
            previous = bytes(line)
        counts.update(colours)
    return counts
