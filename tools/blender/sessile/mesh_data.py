"""Blender's meshes from ours."""
import bpy
import numpy as np


def new_mesh(name, mesh):
    """A mesh of Blender's with the normals and attributes of ours."""
    data = _triangles(name, mesh.points, mesh.triangles)
    if mesh.normals is not None and len(mesh.triangles):
        data.use_auto_smooth = True  # what makes Blender 3 and 4.0 look at normals given to it
        data.normals_split_custom_set_from_vertices(mesh.normals)
    for attribute, values in mesh.attributes.items():
        _add_attribute(data, attribute, values)
    return data


def new_flat_mesh(name, points, triangles):
    """A mesh whose faces show as they are where they meet at an angle, and round where they do not."""
    data = _triangles(name, points, triangles)
    if hasattr(data, "use_auto_smooth"):
        data.use_auto_smooth = True
        data.auto_smooth_angle = np.radians(30)
    return data


def _triangles(name, points, triangles):
    data = bpy.data.meshes.new(name)
    count = len(triangles)
    data.vertices.add(len(points))
    data.vertices.foreach_set("co", np.ascontiguousarray(points, dtype=np.float32).ravel())
    data.loops.add(3 * count)
    data.loops.foreach_set("vertex_index", np.ascontiguousarray(triangles, dtype=np.int32).ravel())
    data.polygons.add(count)
    data.polygons.foreach_set("loop_start", np.arange(0, 3 * count, 3, dtype=np.int32))
    data.polygons.foreach_set("loop_total", np.full(count, 3, dtype=np.int32))
    data.polygons.foreach_set("use_smooth", np.ones(count, dtype=bool))
    data.update(calc_edges=True)
    return data


def _add_attribute(data, name, values):
    if values.ndim == 2:
        # "velocity" is the name by which Cycles knows what to blur along.
        data.attributes.new(name, "FLOAT_VECTOR", "POINT").data.foreach_set("vector", values.ravel())
    else:
        kind = "INT" if values.dtype.kind == "i" else "FLOAT"
        data.attributes.new(name, kind, "POINT").data.foreach_set("value", values)
