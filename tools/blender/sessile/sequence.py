"""An object that shows the surface of the frame at hand. It knows its folder, so it survives saving and loading as long
as the add-on is switched on."""
import math

import bpy
import numpy as np
from bpy.app.handlers import persistent

from .objects import show_frame
from .surface_folder import FolderError, open_folder

# Names of the properties that such an object carries.
FOLDER, START, SPEED, SHOWN = "sessile_folder", "sessile_start", "sessile_speed", "sessile_frame"


def follow(thing, folder, start, speed):
    """Makes an object show the folder's frames from the timeline's frame `start` on; `speed` 0.5 is slow motion."""
    thing[FOLDER], thing[START], thing[SPEED] = str(folder.path.resolve()), start, speed


def last_frame(scene, folder, start, speed):
    """The timeline's frame at which the last surface shows."""
    return start + math.ceil(folder.frames[-1].time / speed * _rate(scene))


def update(scene, thing):
    """Shows the frame next to the timeline's time, unless it is shown already."""
    folder = open_folder(bpy.path.abspath(thing[FOLDER]))
    # Motion blur looks at the scene between frames, where it must find the same surface as at the frame.
    whole = math.floor(scene.frame_current_final + 0.499)
    frame = folder.frame_at((whole - thing[START]) / _rate(scene) * thing[SPEED])
    if thing.get(SHOWN) == frame.number:
        return
    show_frame(thing, frame)
    thing[SHOWN] = frame.number
    slow_down(thing.data, thing[SPEED])


def slow_down(data, speed):
    """Velocities per second of the film, by which Cycles blurs."""
    if speed == 1 or "velocity" not in data.attributes:
        return
    values = data.attributes["velocity"].data
    velocities = np.empty(3 * len(values), dtype=np.float32)
    values.foreach_get("vector", velocities)
    values.foreach_set("vector", velocities * np.float32(speed))


def _rate(scene):
    return scene.render.fps / scene.render.fps_base


@persistent
def on_frame(scene, _depsgraph=None):
    for thing in scene.objects:
        if FOLDER in thing.keys() and thing.type == "MESH":
            try:
                update(scene, thing)
            except (FolderError, OSError, ValueError) as fault:
                print(f"Sessile: {thing.name}: {fault}")


def register():
    if on_frame not in bpy.app.handlers.frame_change_pre:
        bpy.app.handlers.frame_change_pre.append(on_frame)


def unregister():
    if on_frame in bpy.app.handlers.frame_change_pre:
        bpy.app.handlers.frame_change_pre.remove(on_frame)
