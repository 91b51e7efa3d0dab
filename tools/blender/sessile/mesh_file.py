"""Triangle meshes in binary PLY files, as `sessile mesh` writes them. Needs NumPy, not Blender."""
import dataclasses
import pathlib
import stat

import numpy as np

TYPES = {"char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "<i2", "int16": "<i2", "ushort": "<u2",
         "uint16": "<u2", "int": "<i4", "int32": "<i4", "uint": "<u4", "uint32": "<u4", "float": "<f4",
         "float32": "<f4", "double": "<f8", "float64": "<f8"}

# Vectors are three properties each; what they are called here is what Blender's attributes are called.
VECTORS = {"position": ("x", "y", "z"), "normal": ("nx", "ny", "nz"), "velocity": ("vx", "vy", "vz")}


class MeshFileError(ValueError):
    """A file that is not such a mesh; says which and why."""


@dataclasses.dataclass
class Mesh:
    """Triangles with shared vertices, and what the vertices carry."""
    points: np.ndarray  # (n, 3) float32 [m]
    triangles: np.ndarray  # (m, 3) int32
    normals: np.ndarray | None  # (n, 3) float32, of length 1
    attributes: dict  # name to (n,) or (n, 3) float32 or int32

    def volume(self):
        """What a closed surface encloses [m^3]."""
        if len(self.triangles) == 0:
            return 0.0
        centre = self.points.mean(axis=0, dtype=np.float64)
        a, b, c = (self.points[self.triangles[:, corner]] - centre for corner in range(3))
        return abs(float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum())) / 6


def read_mesh(path):
    """Reads a mesh. Raises MeshFileError, or OSError where the file cannot be had."""
    path = pathlib.Path(path)
    if not stat.S_ISREG(path.stat().st_mode):  # a pipe would be waited for, a device might never end
        raise MeshFileError(f"{path}: is no file but a folder, a pipe or a device")
    data = path.read_bytes()
    elements, start = _header(path, data)
    if [name for name, _, _ in elements] != ["vertex", "face"]:
        raise MeshFileError(f"{path}: expected vertices and faces, found {', '.join(e[0] for e in elements) or 'none'}")
    (_, vertex_count, vertex_fields), (_, face_count, face_fields) = elements
    vertex_type = np.dtype(vertex_fields)
    face_type = np.dtype(face_fields)
    needed = start + vertex_count * vertex_type.itemsize + face_count * face_type.itemsize
    if len(data) < needed:
        raise MeshFileError(f"{path}: ends too early, {len(data)} of {needed} bytes are there")
    vertices = np.frombuffer(data, vertex_type, vertex_count, start)
    faces = np.frombuffer(data, face_type, face_count, start + vertices.nbytes)
    if face_count and np.any(faces["count"] != 3):
        raise MeshFileError(f"{path}: has faces that are not triangles")
    triangles = np.ascontiguousarray(faces["corners"], dtype=np.int32)
    if face_count and (triangles.min() < 0 or triangles.max() >= vertex_count):
        raise MeshFileError(f"{path}: a triangle names a vertex that is not there")
    return _mesh(path, vertices, triangles)


def _header(path, data):
    """The elements as (name, count, fields of a NumPy type), and where the data begins."""
    end = data.find(b"end_header\n")
    if not data.startswith(b"ply\n") or end < 0:
        raise MeshFileError(f"{path}: is no PLY file")
    lines = data[:end].decode("ascii", "replace").splitlines()
    if "format binary_little_endian 1.0" not in lines:
        raise MeshFileError(f"{path}: is not binary, little endian")
    elements = []
    for words in (line.split() for line in lines):
        try:
            if words[0] == "element":
                elements.append((words[1], int(words[2]), []))
            elif words[:2] == ["property", "list"]:
                elements[-1][2].extend([("count", TYPES[words[2]]), ("corners", TYPES[words[3]], 3)])
            elif words[0] == "property":
                elements[-1][2].append((words[2], TYPES[words[1]]))
        except (KeyError, IndexError, ValueError):
            raise MeshFileError(f"{path}: has a header line that is not understood: {' '.join(words)}") from None
    return elements, end + len(b"end_header\n")


def _mesh(path, vertices, triangles):
    names = vertices.dtype.names or ()
    vectors = {}
    for vector, parts in VECTORS.items():
        if all(part in names for part in parts):
            vectors[vector] = np.stack([vertices[part] for part in parts], axis=1).astype(np.float32)
    if "position" not in vectors:
        raise MeshFileError(f"{path}: has no places x, y, z")
    attributes = {}
    if "velocity" in vectors:
        attributes["velocity"] = vectors["velocity"]
        attributes["speed"] = np.linalg.norm(vectors["velocity"], axis=1).astype(np.float32)
    in_vectors = {part for parts in VECTORS.values() for part in parts}
    for name in names:
        if name not in in_vectors:
            kind = np.int32 if vertices.dtype[name].kind in "iu" else np.float32
            attributes[name] = vertices[name].astype(kind)
    return Mesh(vectors["position"], triangles, vectors.get("normal"), attributes)
