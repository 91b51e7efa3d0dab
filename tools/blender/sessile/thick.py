"""Solids as they stand in a picture: a simulation's wall is a sheet of samples, and liquid keeps off it.

A particle touches a wall at about half a spacing from its samples, so a solid is drawn with its faces moved out by that
margin; a flat sheet becomes a slab, whose two faces stand out on either side. Needs NumPy, not Blender.
"""
import numpy as np


def outset(points, triangles, margin):
    """Points and triangles of the solid with every face moved along its normal; of sheets on both sides, with rims."""
    points, triangles = _welded(np.asarray(points, dtype=np.float64), np.asarray(triangles))
    rims = _open_edges(triangles)
    if len(rims) == 0:
        return points + _shifts(points, triangles, margin, rims), triangles
    front = points + _shifts(points, triangles, margin, rims)
    back = points + _shifts(points, triangles[:, ::-1], margin, rims)
    below = len(points)
    a, b = rims[:, 0], rims[:, 1]
    sides = np.concatenate([np.stack([b, a, a + below], 1), np.stack([b, a + below, b + below], 1)])
    return np.concatenate([front, back]), np.concatenate([triangles, triangles[:, ::-1] + below, sides])


def _welded(points, triangles):
    """Vertices at one place become one, so that faces know their neighbours."""
    size = np.ptp(points, axis=0).max() if len(points) else 0
    keys = np.round(points / (1e-6 * size if size > 0 else 1)).astype(np.int64)
    _, first, index = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    welded = index.reshape(-1)[triangles]
    whole = (welded[:, 0] != welded[:, 1]) & (welded[:, 1] != welded[:, 2]) & (welded[:, 2] != welded[:, 0])
    return points[first], welded[whole]


def _open_edges(triangles):
    """Directed edges that have no partner."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    stride = int(triangles.max()) + 1 if len(triangles) else 1
    there = edges[:, 0].astype(np.int64) * stride + edges[:, 1]
    back = edges[:, 1].astype(np.int64) * stride + edges[:, 0]
    return edges[~np.isin(there, back)]


def _face_normals(points, triangles):
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)


def _shifts(points, triangles, margin, rims):
    """The shift of each vertex that moves all planes through it by the margin, in the sense of least squares."""
    planes = np.zeros((len(points), 3, 3))
    sums = np.zeros((len(points), 3))
    normals = _face_normals(points, triangles)
    for corner in range(3):
        _add_planes(planes, sums, triangles[:, corner], normals)
    if len(rims):
        along = points[rims[:, 1]] - points[rims[:, 0]]
        along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-300)
        outward = np.cross(along, _normals_at_rims(triangles, normals, rims))
        for end in range(2):
            _add_planes(planes, sums, rims[:, end], outward)
    return margin * np.einsum("nij,nj->ni", np.linalg.pinv(planes, rcond=1e-2, hermitian=True), sums)


def _add_planes(planes, sums, vertices, normals):
    np.add.at(planes, vertices, normals[:, :, None] * normals[:, None, :])
    np.add.at(sums, vertices, normals)


def _normals_at_rims(triangles, normals, rims):
    """The normal of the face at each open edge, which may run either way through the face."""
    face_of = {}
    for corner in range(3):
        for face, (a, b) in enumerate(zip(triangles[:, corner], triangles[:, (corner + 1) % 3])):
            face_of[(int(a), int(b))] = normals[face]
    return np.array([face_of[(a, b)] if (a, b) in face_of else -face_of[(b, a)] for a, b in rims.tolist()])
