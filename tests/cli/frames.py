"""Reads frames as far as a test must, without VTK: their particles, arrays and time."""
import base64
import struct
import xml.etree.ElementTree
import zlib


def read_pvd(path):
    """The collection as [(time, file name)]."""
    root = xml.etree.ElementTree.parse(path).getroot()
    return [(float(entry.get("timestep")), entry.get("file")) for entry in root.iter("DataSet")]


def read_vtp(path, values=None):
    """(number of points, names of the point arrays, time). Every array must unpack to the length it should have.
    `values`: a dictionary that gets a list for each name, of tuples where there are several numbers a point; "" has
    the places."""
    root = xml.etree.ElementTree.parse(path).getroot()
    width = {"UInt32": 4, "UInt64": 8}[root.get("header_type")]
    sizes = {"Float32": 4, "Float64": 8, "Int32": 4, "Int64": 8, "UInt8": 1, "UInt32": 4}
    appended = root.find("AppendedData").text.strip()
    assert appended.startswith("_")
    appended = appended[1:]

    def unpack(array):
        at = int(array.get("offset"))
        first = base64.b64decode(appended[at:at + 4 * ((width + 2) // 3)])
        blocks = int.from_bytes(first[:width], "little")
        head = width * (3 + blocks)
        coded = 4 * ((head + 2) // 3)
        numbers = base64.b64decode(appended[at:at + coded])
        lengths = [int.from_bytes(numbers[width * (3 + k):width * (4 + k)], "little") for k in range(blocks)]
        body = base64.b64decode(appended[at + coded:at + coded + 4 * ((sum(lengths) + 2) // 3)])
        data, start = b"", 0
        for length in lengths:
            data += zlib.decompress(body[start:start + length])
            start += length
        return data

    def keep(name, array, data):
        if values is None:
            return
        kind = {"Float32": "f", "Float64": "d", "Int32": "i", "Int64": "q", "UInt8": "B", "UInt32": "I"}[array.get("type")]
        numbers = [n[0] for n in struct.iter_unpack("<" + kind, data)]
        each = int(array.get("NumberOfComponents", 1))
        values[name] = numbers if each == 1 else [tuple(numbers[k:k + each]) for k in range(0, len(numbers), each)]

    piece = root.find("PolyData/Piece")
    points = int(piece.get("NumberOfPoints"))
    names = []
    for array in piece.findall("PointData/DataArray"):
        names.append(array.get("Name"))
        data = unpack(array)
        wanted = points * int(array.get("NumberOfComponents", 1)) * sizes[array.get("type")]
        assert len(data) == wanted, f"{path}: {names[-1]} has {len(data)} bytes instead of {wanted}"
        keep(names[-1], array, data)
    place = piece.find("Points/DataArray")
    keep("", place, unpack(place))
    assert len(unpack(place)) == points * 3 * sizes[place.get("type")]
    time = [a for a in root.iter("DataArray") if a.get("Name") == "TimeValue"][0]
    return points, names, float(time.text)


def read_ply(path):
    """Number of vertices; the file must be exactly as long as its header says."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    sizes = {"float": 4, "double": 8, "int": 4, "uint": 4, "uchar": 1}
    count = stride = 0
    for line in data[:end].decode().splitlines():
        words = line.split()
        if words[:2] == ["element", "vertex"]:
            count = int(words[2])
        if words[0] == "property":
            stride += sizes[words[1]]
    assert len(data) == end + count * stride, f"{path}: {len(data)} bytes"
    return count


def read_positions(path):
    """The positions in a PLY file as {id: (x, y, z)}."""
    data = path.read_bytes()
    head, _, body = data.partition(b"end_header\n")
    properties = [line.split()[1:] for line in head.decode().splitlines() if line.startswith("property")]
    letters = {"float": "f", "double": "d", "int": "i", "uint": "I", "uchar": "B"}
    names = [name for _, name in properties]
    columns = [names.index(name) for name in ("id", "x", "y", "z")]
    rows = struct.iter_unpack("<" + "".join(letters[kind] for kind, _ in properties), body)
    return {row[columns[0]]: tuple(row[k] for k in columns[1:]) for row in rows}
