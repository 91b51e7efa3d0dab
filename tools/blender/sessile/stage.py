"""Light and what stands behind: soft boxes and a sky of gradients, no image files. All sizes follow the scene's."""
import dataclasses

import bpy
import numpy as np
from mathutils import Matrix

from .nodes import Nodes


@dataclasses.dataclass(frozen=True)
class Background:
    """Colours of the sky from below, over the horizon, to above; and what shows of it to the eye."""
    below: tuple
    horizon: tuple
    above: tuple
    light: float  # strength of the sky as light
    key: float  # strength of the great soft box
    rim: float  # of the one behind


BACKGROUNDS = {
    "studio": Background((0.30, 0.37, 0.45), (0.97, 0.98, 0.98), (0.20, 0.29, 0.40), 0.62, 1.0, 1.0),
    "white": Background((0.75, 0.76, 0.77), (1.0, 1.0, 1.0), (0.80, 0.85, 0.90), 0.85, 0.7, 0.6),
    "dark": Background((0.004, 0.005, 0.006), (0.022, 0.026, 0.032), (0.006, 0.008, 0.010), 1.0, 1.0, 1.6),
}


def add_stage(scene, name, view, up, centre, radius):
    """Light around a ball of that radius [m], laid out as the camera sees it."""
    background = BACKGROUNDS[name]
    _sky(scene, background, up)
    up = np.asarray(up, float)
    ahead = -view.back - up * (-view.back @ up)
    ahead = ahead / np.linalg.norm(ahead) if np.linalg.norm(ahead) > 1e-6 else view.upward
    right = np.cross(ahead, up)
    # A great soft box above and behind, which liquid surfaces reflect towards the eye; a narrow one aside for edges.
    _soft_box(scene, "key", centre, centre + radius * (1.3 * ahead - 0.7 * right + 2.8 * up), 1.8 * radius, 1.8 * radius,
              background.key * 110, (1.0, 0.965, 0.92), radius)
    _soft_box(scene, "rim", centre, centre + radius * (0.6 * ahead + 2.6 * right + 1.1 * up), 0.7 * radius, 2.0 * radius,
              background.rim * 40, (0.86, 0.93, 1.0), radius)


def _soft_box(scene, name, target, place, width, height, strength, color, radius):
    light = bpy.data.lights.new(name, "AREA")
    light.shape = "RECTANGLE"
    light.size, light.size_y = width, height
    light.energy = strength * radius * radius
    light.color = color
    thing = bpy.data.objects.new(name, light)
    back = np.asarray(place, float) - target
    back /= np.linalg.norm(back)
    side = np.cross((0, 0, 1), back) if abs(back[2]) < 0.99 else np.array([1.0, 0, 0])
    side /= np.linalg.norm(side)
    axes = np.eye(4)
    axes[:3, 0], axes[:3, 1], axes[:3, 2], axes[:3, 3] = side, np.cross(back, side), back, place
    thing.matrix_world = Matrix(axes.tolist())
    thing.visible_camera = False
    scene.collection.objects.link(thing)


def _sky(scene, background, up):
    world = bpy.data.worlds.new("sky")
    scene.world = world
    nodes = Nodes(world)
    place = nodes.add("ShaderNodeTexCoord")
    height = nodes.add("ShaderNodeVectorMath", operation="DOT_PRODUCT")
    nodes.put(height.inputs[0], place.outputs["Generated"])
    nodes.put(height.inputs[1], tuple(float(each) for each in up))
    share = nodes.add("ShaderNodeMapRange", {"Value": height.outputs["Value"], "From Min": -1.0, "From Max": 1.0})
    ramp = nodes.add("ShaderNodeValToRGB", {"Fac": share.outputs["Result"]})
    ramp.color_ramp.interpolation = "EASE"
    stops = ramp.color_ramp.elements
    stops[0].position, stops[0].color = 0.22, (*background.below, 1)
    stops[1].position, stops[1].color = 0.90, (*background.above, 1)
    stops.new(0.53).color = (*background.horizon, 1)
    light = nodes.add("ShaderNodeBackground", {"Color": ramp.outputs["Color"], "Strength": background.light})
    output = nodes.add("ShaderNodeOutputWorld")
    nodes.put(output.inputs["Surface"], light.outputs["Background"])
