"""The looks that liquids can have, as numbers. Needs no Blender."""
import dataclasses
import math


@dataclasses.dataclass(frozen=True)
class Look:
    """A liquid. `tint` is what is left of white light after `depth` times the liquid's own size; black: opaque."""
    ior: float
    tint: tuple
    depth: float = 1.0
    roughness: float = 0.0
    opaque: tuple | None = None  # colour of a liquid that hides what is behind it
    metallic: float = 0.0


LOOKS = {
    "water": Look(1.33, (0.03, 0.38, 0.74), depth=0.8),
    "clear": Look(1.33, (0.70, 0.88, 0.92)),
    "oil": Look(1.47, (0.72, 0.42, 0.03), depth=0.5),
    "honey": Look(1.49, (0.60, 0.19, 0.005), depth=0.3),
    "wine": Look(1.35, (0.35, 0.01, 0.03), depth=0.3),
    "milk": Look(1.35, (0, 0, 0), roughness=0.12, opaque=(0.86, 0.84, 0.79)),
    "paint": Look(1.5, (0, 0, 0), roughness=0.05, opaque=(0.60, 0.035, 0.03)),
    "metal": Look(1.5, (0, 0, 0), roughness=0.06, opaque=(0.75, 0.76, 0.78), metallic=1.0),
}


def absorption(tint, depth):
    """Density [1/m] and colour of the node that leaves `tint` of white light after `depth` metres: the node takes up
    density (1 - colour) per metre."""
    coefficients = [-math.log(max(part, 1e-4)) / depth for part in tint]
    density = max(max(coefficients), 1e-9)
    return density, tuple(1 - each / density for each in coefficients)
