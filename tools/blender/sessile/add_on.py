"""The add-on: File > Import > Sessile results (surface.json)."""
import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from . import looks, materials, objects, sequence
from .mesh_file import MeshFileError
from .surface_folder import FolderError, open_folder


def import_folder(context, file, start=0, speed=1.0, margin=0.5, look="water", with_solids=True):
    """Adds the liquid, which follows the timeline, and the solids; returns the liquid's object."""
    folder = open_folder(file)
    scene = context.scene
    collection = bpy.data.collections.new("Sessile")
    scene.collection.children.link(collection)
    if with_solids:
        for index, (label, thing) in enumerate(
                objects.add_solids(collection, folder, margin * folder.spacing).items()):
            thing.data.materials.append(materials.solid(label, index))
    liquid = objects.add_liquid(collection, folder.frames[0])
    liquid.data.materials.append(materials.liquid(look, folder.frames[0].mesh().volume() ** (1 / 3) or 1.0))
    sequence.follow(liquid, folder, start, speed)
    scene.frame_start, scene.frame_end = start, sequence.last_frame(scene, folder, start, speed)
    sequence.update(scene, liquid)
    return liquid


class ImportSessileResults(bpy.types.Operator, ImportHelper):
    """Import the surfaces that `sessile mesh` wrote, as an object that follows the timeline"""

    bl_idname = "import_scene.sessile"
    bl_label = "Import Sessile results"
    bl_options = {"REGISTER", "UNDO"}

    filename_ext = ".json"
    filter_glob: StringProperty(default="surface.json", options={"HIDDEN"})
    start: IntProperty(name="First frame", description="Frame of the timeline at which the results begin", default=0)
    speed: FloatProperty(name="Speed", description="0.5 is slow motion", default=1.0, min=1e-6, soft_max=10)
    look: EnumProperty(name="Look", items=[(each, each.capitalize(), "") for each in looks.LOOKS], default="water")
    with_solids: BoolProperty(name="Solids", default=True)
    margin: FloatProperty(name="Margin of solids", default=0.5, min=0, max=2,
                          description="How far their faces stand out, over the particle spacing")

    def execute(self, context):
        try:
            import_folder(context, self.filepath, self.start, self.speed, self.margin, self.look, self.with_solids)
        except (FolderError, MeshFileError, OSError) as fault:
            self.report({"ERROR"}, str(fault))
            return {"CANCELLED"}
        return {"FINISHED"}


def menu_entry(self, _context):
    self.layout.operator(ImportSessileResults.bl_idname, text="Sessile results (surface.json)")


def register():
    bpy.utils.register_class(ImportSessileResults)
    bpy.types.TOPBAR_MT_file_import.append(menu_entry)
    sequence.register()


def unregister():
    sequence.unregister()
    bpy.types.TOPBAR_MT_file_import.remove(menu_entry)
    bpy.utils.unregister_class(ImportSessileResults)
