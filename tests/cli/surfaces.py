"""Reads surfaces as far as a test must."""
import collections
import json
import struct


def read_surface_ply(path):
    """(vertices as lists by name, triangles); the file must be exactly as long as its header says."""
    data = path.read_bytes()
    head, _, body = data.partition(b"end_header\n")
    counts, names, letters = {}, [], ""
    for line in head.decode().splitlines():
        words = line.split()
        if words[0] == "element":
            counts[words[1]] = int(words[2])
        elif words[:2] == ["property", "list"]:
            assert words[2:] == ["uchar", "int", "vertex_indices"], line
        elif words[0] == "property":
            letters += {"float": "f", "int": "i"}[words[1]]
            names.append(words[2])
    stride = struct.calcsize("<" + letters)
    edge = counts["vertex"] * stride
    assert len(body) == edge + 13 * counts["face"], f"{path}: {len(body)} bytes"
    rows = list(struct.iter_unpack("<" + letters, body[:edge]))
    faces = list(struct.iter_unpack("<Biii", body[edge:]))
    assert all(face[0] == 3 and max(face[1:]) < len(rows) and min(face[1:]) >= 0 for face in faces)
    return {name: [row[k] for row in rows] for k, name in enumerate(names)}, [face[1:] for face in faces]


def is_closed(triangles):
    """Whether each edge is run through once in either direction."""
    edges = collections.Counter((t[k], t[(k + 1) % 3]) for t in triangles for k in range(3))
    return set(edges.values()) <= {1} and all((b, a) in edges for a, b in edges)


def read_obj(path):
    """(number of vertices, number of normals, triangles)."""
    lines = [line.split() for line in path.read_text().splitlines()]
    faces = [tuple(int(word.split("//")[0]) - 1 for word in line[1:]) for line in lines if line[0] == "f"]
    return sum(line[0] == "v" for line in lines), sum(line[0] == "vn" for line in lines), faces


def read_index(path):
    return json.loads(path.read_text())
