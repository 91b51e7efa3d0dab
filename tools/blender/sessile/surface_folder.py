"""The folder that `sessile mesh` writes: surface.json and the meshes it names. Needs no Blender."""
import dataclasses
import json
import pathlib

from .mesh_file import read_mesh


class FolderError(ValueError):
    """A folder that holds no surfaces; says which and why."""


@dataclasses.dataclass
class Frame:
    number: int
    time: float  # [s]
    file: pathlib.Path

    def mesh(self):
        return read_mesh(self.file)


@dataclasses.dataclass
class SolidFile:
    label: str
    file: pathlib.Path

    def mesh(self):
        return read_mesh(self.file)


@dataclasses.dataclass
class SurfaceFolder:
    path: pathlib.Path
    spacing: float  # of the particles [m]
    up: tuple
    frames: list  # of Frame, by time
    solids: list  # of SolidFile

    def frame_at(self, time):
        """The frame next to a time [s]; of two that are equally near, the earlier."""
        return min(self.frames, key=lambda frame: (abs(frame.time - time), frame.time))

    def interval(self):
        """The time between frames [s]: their median, so that one odd frame at the end does not matter."""
        steps = sorted(b.time - a.time for a, b in zip(self.frames, self.frames[1:]) if b.time > a.time)
        return steps[len(steps) // 2] if steps else 0.04


def open_folder(path):
    """Reads surface.json, given as that file, as its folder or as the folder above. Raises FolderError."""
    path = pathlib.Path(path)
    candidates = [path, path / "surface.json", path / "surface" / "surface.json"]
    file = next((each for each in candidates if each.is_file()), None)
    if file is None:
        raise FolderError(f"{path} holds no surface.json; `sessile mesh` writes one")
    try:
        said = json.loads(file.read_text(encoding="utf-8"))
        frames = [Frame(each["number"], each["time"], file.parent / _ply_of(each)) for each in said["frames"]]
        solids = [SolidFile(each["label"], file.parent / each["file"]) for each in said.get("solids", [])]
        folder = SurfaceFolder(file.parent, said["spacing"], tuple(said.get("up", (0, 0, 1))),
                               sorted(frames, key=lambda frame: frame.time), solids)
    except (KeyError, TypeError, ValueError) as fault:
        raise FolderError(f"{file} is not what `sessile mesh` writes: {fault!r}") from None
    if not folder.frames:
        raise FolderError(f"{file} names no frames")
    return folder


def _ply_of(frame):
    """The name of a frame's PLY file among those in other formats."""
    return next((name for name in frame.get("files", ()) if name.endswith(".ply")), frame["file"])
