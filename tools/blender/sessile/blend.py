"""A Blender file for work by hand: every frame an object of its own, shown in its turn. It needs nothing but Blender."""
import bpy

from .objects import add_liquid


def save_blend(scene, liquid, frames, file):
    """Puts the frames beside the first, which `liquid` is, and saves all."""
    collection = bpy.data.collections.new("liquid")
    scene.collection.children.link(collection)
    scene.collection.objects.unlink(liquid)
    collection.objects.link(liquid)
    things = [liquid] + [add_liquid(collection, frame) for frame in frames[1:]]
    for index, (thing, frame) in enumerate(zip(things, frames)):
        thing.name = thing.data.name = f"liquid {frame.number:06d}"
        if not thing.data.materials:
            thing.data.materials.append(liquid.data.materials[0])
        after = frames[index + 1].number if index + 1 < len(frames) else None
        _show_between(thing, frame.number, after, first=index == 0)
    scene.frame_start, scene.frame_end = frames[0].number, frames[-1].number
    scene.frame_set(frames[0].number)
    bpy.ops.wm.save_as_mainfile(filepath=str(file), compress=True)


def _show_between(thing, first_frame, after, first):
    """Keys on the two switches that hide an object; the last one stays."""
    keys = [] if first else [(first_frame - 1, True)]
    keys.append((first_frame, False))
    if after is not None:
        keys.append((after, True))
    for frame, hidden in keys:
        thing.hide_render = thing.hide_viewport = hidden
        for switch in ("hide_render", "hide_viewport"):
            thing.keyframe_insert(switch, frame=frame)
