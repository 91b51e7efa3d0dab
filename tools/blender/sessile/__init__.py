"""Sessile's results in Blender: an add-on that imports them, and what `sessile render` makes films with.

As an add-on: install this folder as a zip, or link it into Blender's scripts/addons, and switch on "Sessile results".
Nothing here needs Blender until register() is called, so that the readers can be used and tested without it.
"""

bl_info = {
    "name": "Sessile results",
    "description": "Imports the surfaces that `sessile mesh` wrote, as an animated object with velocities",
    "author": "The Sessile maintainers",
    "version": (1, 0, 0),
    "blender": (3, 4, 0),
    "location": "File > Import > Sessile results (surface.json)",
    "category": "Import-Export",
}


def register():
    from . import add_on
    add_on.register()


def unregister():
    from . import add_on
    add_on.unregister()
