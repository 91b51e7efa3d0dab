"""Renders the frames of a job, as `sessile render` asks for them."""
import math
import os
import pathlib
import time

import bpy
import numpy as np

from . import blend, camera, materials, objects, quality, stage
from .surface_folder import open_folder

LONGEST_FRAME = 1 / 24  # [s]; results further apart are not blurred as if a camera had stood open all the while


def say(text):
    """A line for the program that started this one."""
    print(f"sessile: {text}", flush=True)


def make_film(job):
    folder = open_folder(job["folder"])
    chosen = set(job["frames"])
    frames = [frame for frame in folder.frames if frame.number in chosen]
    scene = empty_scene()
    liquid = build(scene, folder, frames, job)
    if job.get("blend"):
        blend.save_blend(scene, liquid, frames, job["blend"])
        return
    out = pathlib.Path(job["output"])
    for frame in frames:
        start = time.monotonic()
        say(f"begin {frame.number}")
        objects.show_frame(liquid, frame)
        scene.frame_set(frame.number)
        render_whole(scene, out / f"frame_{frame.number:06d}.png")
        say(f"done {frame.number} {time.monotonic() - start:.3f}")


def empty_scene():
    """Blender's own cube, lamp and camera are not ours."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return bpy.context.scene


def build(scene, folder, frames, job):
    """Everything but the frames after the first; returns the object of the liquid."""
    settings = job["settings"]
    quality.set_quality(scene, settings)
    look = {each["label"]: each for each in settings["solids"]}
    solids = objects.add_solids(scene.collection, folder, settings["margin"] * folder.spacing)
    for index, (label, thing) in enumerate(solids.items()):
        said = look.get(label, {})
        thing.data.materials.append(
            materials.solid(label, index, said.get("finish", "matte"), said.get("color")))
        thing.hide_render = thing.hide_viewport = not said.get("visible", True)
    extent = Extent(folder, solids.values())
    liquid = objects.add_liquid(scene.collection, frames[0])
    liquid.data.materials.append(materials.liquid(settings["look"], extent.liquid_size, settings.get("color")))
    aspect = settings["width"] / settings["height"]
    view = camera.choose_view(settings["camera"], folder.up, extent.points, aspect)
    camera.add_camera(scene, view, settings["camera"]["field_of_view"], aspect, extent.radius,
                      settings["camera"]["aperture"])
    stage.add_stage(scene, settings["background"], view, folder.up, extent.centre, extent.radius)
    set_time(scene, folder, settings["shutter"])
    return liquid


def set_time(scene, folder, shutter):
    """Frames of the results are frames of Blender's; velocities are per second, so Blender must know its length."""
    rate = 1 / folder.interval()
    scene.render.fps = max(1, min(32767, round(rate)))
    scene.render.fps_base = scene.render.fps / rate
    scene.render.use_motion_blur = shutter > 0
    scene.render.motion_blur_shutter = shutter * min(1.0, LONGEST_FRAME * rate)
    scene.cycles.motion_blur_position = "CENTER"


class Extent:
    """How far liquid and solids reach over the whole film, and how much liquid there is."""

    def __init__(self, folder, solids, most_frames=24, points_each=4000):
        clouds, volumes = [], []
        step = max(1, math.ceil(len(folder.frames) / most_frames))
        for frame in folder.frames[::step]:
            mesh = frame.mesh()
            if len(mesh.triangles) == 0:
                continue
            clouds.append(mesh.points[:: max(1, len(mesh.points) // points_each)])
            volumes.append(mesh.volume())
        fixed = [objects.corners(thing) for thing in solids if not thing.hide_render]
        self.points = self._framed(clouds, fixed)
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        self.centre = (low + high) / 2
        self.radius = float(np.linalg.norm(high - low)) / 2
        self.liquid_size = float(max(volumes, default=0)) ** (1 / 3) or self.radius

    @staticmethod
    def _framed(clouds, fixed):
        """What the picture is to hold: all solids; of liquid, what stays near them: drops that fall out of the scene
        would make everything else small."""
        if not fixed and not clouds:
            raise ValueError("there is nothing to see: no liquid in any frame, and no solids")
        if not fixed:
            return np.concatenate(clouds)
        solid = np.concatenate(fixed)
        low, high = solid.min(axis=0), solid.max(axis=0)
        reach = 0.35 * float((high - low).max())
        if not clouds:
            return solid
        liquid = np.concatenate(clouds)
        near = np.all((liquid > low - reach) & (liquid < high + reach), axis=1)
        return np.concatenate([solid, liquid[near]])


def render_whole(scene, file):
    """A picture is there whole or not at all."""
    part = file.with_name(f".{file.stem}.part.png")
    part.unlink(missing_ok=True)  # a link that stands there is not to be written through
    scene.render.filepath = str(part)
    bpy.ops.render.render(write_still=True)
    os.replace(part, file)
