"""The liquid and the solids as objects."""
import bpy
import numpy as np

from . import thick
from .mesh_data import new_flat_mesh, new_mesh


def add_object(collection, name, data):
    thing = bpy.data.objects.new(name, data)
    collection.objects.link(thing)
    return thing


def add_solids(collection, folder, margin):
    """An object for each solid, named by its label, its faces moved out by the margin [m]."""
    solids = {}
    for solid in folder.solids:
        mesh = solid.mesh()
        points, triangles = thick.outset(mesh.points, mesh.triangles, margin)
        solids[solid.label] = add_object(collection, solid.label, new_flat_mesh(solid.label, points, triangles))
    return solids


def add_liquid(collection, frame, name="liquid"):
    return add_object(collection, name, new_mesh(name, frame.mesh()))


def show_frame(thing, frame):
    """Puts a frame's surface in place of the one that the object shows; materials stay."""
    before = thing.data
    data = new_mesh(before.name, frame.mesh())
    for material in before.materials:
        data.materials.append(material)
    thing.data = data
    bpy.data.meshes.remove(before)


def corners(thing):
    """Places of an object's vertices in the world, (n, 3)."""
    places = np.empty(3 * len(thing.data.vertices), dtype=np.float32)
    thing.data.vertices.foreach_get("co", places)
    matrix = np.array(thing.matrix_world)
    return places.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]
