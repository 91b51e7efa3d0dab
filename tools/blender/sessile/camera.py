"""Where the picture is taken from."""
import dataclasses
import math

import bpy
import numpy as np
from mathutils import Matrix


@dataclasses.dataclass
class View:
    """A camera: where it stands and which way is right, up and back."""
    eye: np.ndarray
    target: np.ndarray
    right: np.ndarray
    upward: np.ndarray
    back: np.ndarray

    @property
    def distance(self):
        return float(np.linalg.norm(self.eye - self.target))


def unit(vector):
    vector = np.asarray(vector, dtype=float)
    return vector / np.linalg.norm(vector)


def ground_axes(up):
    """Two directions across `up`; x and y where up is z."""
    up = unit(up)
    first = np.array([1.0, 0, 0]) if abs(up[0]) < 0.9 else np.array([0, 1.0, 0])
    first = unit(first - up * (first @ up))
    return first, np.cross(up, first)


def direction(up, azimuth, elevation):
    """From what is looked at towards the eye; angles in degrees, as in `sessile view`."""
    x, y = ground_axes(up)
    a, e = math.radians(azimuth), math.radians(elevation)
    return math.cos(e) * (math.cos(a) * x + math.sin(a) * y) + math.sin(e) * unit(up)


def view_from(eye, target, up):
    back = unit(np.subtract(eye, target))
    across = np.cross(up, back)
    right = unit(across) if np.linalg.norm(across) > 1e-6 else ground_axes(up)[0]
    return View(np.array(eye, float), np.array(target, float), right, np.cross(back, right), back)


def choose_view(settings, up, points, aspect):
    """The view that the settings ask for; what they leave open is chosen so that all points are in the picture."""
    target = settings.get("target")
    if settings.get("position") is not None:
        centre = (points.min(axis=0) + points.max(axis=0)) / 2
        return view_from(settings["position"], target if target is not None else centre, up)
    back = direction(up, settings["azimuth"], settings["elevation"])
    return framed(back, up, points, settings["field_of_view"], aspect, target, settings["zoom"])


def framed(back, up, points, field_of_view, aspect, target=None, zoom=1.0, margin=1.06):
    """The nearest view along a direction that holds all points; about a target, where one is given."""
    middle = (points.min(axis=0) + points.max(axis=0)) / 2 if target is None else np.array(target, float)
    view = view_from(middle + back, middle, up)
    tan_y = math.tan(math.radians(field_of_view) / 2) / margin
    tangents = np.array([tan_y * aspect, tan_y])
    for _ in range(8):
        at = points - middle
        flat = np.stack([at @ view.right, at @ view.upward], axis=1)
        depth = at @ view.back
        distance = max(float((np.abs(flat) / tangents + depth[:, None]).max()), 1e-9)
        if target is not None:
            break
        # What is seen reaches unequally far to both sides as long as the middle is off.
        seen = flat / (distance - depth)[:, None]
        off = (seen.max(axis=0) + seen.min(axis=0)) / 2 * distance
        middle = middle + off[0] * view.right + off[1] * view.upward
    return view_from(middle + view.back * distance / zoom, middle, up)


def add_camera(scene, view, field_of_view, aspect, size, aperture=0.0):
    """Blender's camera. `size` [m]: of what is looked at. `aperture`: the lens over the distance to the target."""
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL" if aspect >= 1 else "HORIZONTAL"
    data.angle = math.radians(field_of_view)
    if aspect < 1:
        data.angle = 2 * math.atan(math.tan(math.radians(field_of_view) / 2) * aspect)
    data.clip_start = 1e-3 * size
    data.clip_end = 1e3 * (size + view.distance)
    if aperture > 0:
        data.dof.use_dof = True
        data.dof.focus_distance = view.distance
        data.dof.aperture_fstop = data.lens * 1e-3 / (aperture * view.distance)
    thing = bpy.data.objects.new("camera", data)
    axes = np.eye(4)
    axes[:3, 0], axes[:3, 1], axes[:3, 2], axes[:3, 3] = view.right, view.upward, view.back, view.eye
    thing.matrix_world = Matrix(axes.tolist())
    scene.collection.objects.link(thing)
    scene.camera = thing
    return thing
