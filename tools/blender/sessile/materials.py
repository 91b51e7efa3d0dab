"""What liquids and solids look like."""

import bpy

from .looks import LOOKS, absorption
from .nodes import Nodes


def liquid(look_name, size, color=None):
    """The liquid's material. `size` is a length [m] that stands for the amount of liquid; `color` replaces the tint."""
    look = LOOKS[look_name]
    material = bpy.data.materials.new(f"liquid: {look_name}")
    nodes = Nodes(material)
    output = nodes.add("ShaderNodeOutputMaterial")
    if look.opaque is not None:
        _opaque(nodes, output, look, color or look.opaque)
    else:
        _transparent(nodes, output, look, color or look.tint, look.depth * size)
    return material


def _opaque(nodes, output, look, color):
    surface = nodes.add("ShaderNodeBsdfPrincipled", {
        "Base Color": (*color, 1), "Roughness": look.roughness, "Metallic": look.metallic, "IOR": look.ior})
    nodes.put(output.inputs["Surface"], surface.outputs["BSDF"])


def _transparent(nodes, output, look, tint, depth):
    """Glass for the eye; for shadows clear, since caustics would take a thousand times the samples. The colour comes
    from the way through the liquid, in shadows as well."""
    glass = nodes.add("ShaderNodeBsdfPrincipled", {
        "Base Color": (1, 1, 1, 1), "Roughness": look.roughness, "Transmission": 1.0, "IOR": look.ior})
    # Part of the light is reflected off both faces, and part is bent aside.
    clear = nodes.add("ShaderNodeBsdfTransparent", {"Color": (0.93, 0.93, 0.93, 1)})
    path = nodes.add("ShaderNodeLightPath")
    surface = nodes.add("ShaderNodeMixShader", {"Fac": path.outputs["Is Shadow Ray"]})
    nodes.put(surface.inputs[1], glass.outputs["BSDF"])
    nodes.put(surface.inputs[2], clear.outputs["BSDF"])
    nodes.put(output.inputs["Surface"], surface.outputs["Shader"])
    density, color = absorption(tint, depth)
    volume = nodes.add("ShaderNodeVolumeAbsorption", {"Color": (*color, 1), "Density": density})
    nodes.put(output.inputs["Volume"], volume.outputs["Volume"])


SOLID_COLORS = ((0.60, 0.58, 0.55), (0.30, 0.22, 0.16), (0.16, 0.20, 0.25), (0.28, 0.30, 0.22))


def solid(label, index, look="matte", color=None):
    """A solid's material. Its back faces let light through, so that one looks into a container from outside."""
    material = bpy.data.materials.new(f"solid: {label}")
    nodes = Nodes(material)
    output = nodes.add("ShaderNodeOutputMaterial")
    color = color or SOLID_COLORS[index % len(SOLID_COLORS)]
    values = {"Base Color": (*color, 1)}
    values |= {"matte": {"Roughness": 0.65, "Specular": 0.25},
               "glossy": {"Roughness": 0.12, "Specular": 0.5},
               "metal": {"Roughness": 0.28, "Metallic": 1.0}}[look]
    front = nodes.add("ShaderNodeBsdfPrincipled", values)
    back = nodes.add("ShaderNodeBsdfTransparent")
    side = nodes.add("ShaderNodeNewGeometry")
    mix = nodes.add("ShaderNodeMixShader", {"Fac": side.outputs["Backfacing"]})
    nodes.put(mix.inputs[1], front.outputs["BSDF"])
    nodes.put(mix.inputs[2], back.outputs["BSDF"])
    nodes.put(output.inputs["Surface"], mix.outputs["Shader"])
    return material
