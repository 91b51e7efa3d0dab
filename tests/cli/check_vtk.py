#!/usr/bin/python3
"""Opens a .vtp frame or a .pvd collection with VTK and checks what is in it.

    check_vtk.py FILE [--fields id,velocity,...] [--particles N] [--frames N] [--values TEXT]

Every frame must hold finite points, one vertex a point, point arrays as long as there are points, and its time; a
collection's times must ascend and agree with those in its frames. TEXT lists what the frames must hold, a line each:
`frame TIME N`, then `NAME COMPONENTS VALUE...` for "Points" and every array. Exit code 0: all is well, 1: it is not.
"""
import argparse
import math
import os
import struct
import sys
import xml.etree.ElementTree

from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


class Fault(Exception):
    pass


def expect(condition, text):
    if not condition:
        raise Fault(text)


def numbers(array):
    """All numbers of a VTK array, one after the other."""
    flat = memoryview(array).cast("B").cast(memoryview(array).format) if array.GetNumberOfValues() else ()
    return list(flat)


def read_frame(path):
    """The frame as (time, {name: (components, numbers)}), "Points" among the names."""
    expect(os.path.exists(path), f"{path}: no such file")
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    expect(reader.GetErrorCode() == 0, f"{path}: VTK error {reader.GetErrorCode()}")
    data = reader.GetOutput()
    n = data.GetNumberOfPoints()
    expect(data.GetNumberOfVerts() == n, f"{path}: {data.GetNumberOfVerts()} vertices for {n} points")

    arrays = {}
    for k in range(data.GetPointData().GetNumberOfArrays()):
        array = data.GetPointData().GetArray(k)
        expect(array.GetNumberOfTuples() == n, f"{path}: {array.GetName()} has {array.GetNumberOfTuples()} rows for {n}")
        arrays[array.GetName()] = array.GetNumberOfComponents(), numbers(array)
        if array.GetName() == "velocity":
            unit = array.GetInformation().Get(vtkDataArray.UNITS_LABEL())
            expect(unit == "m/s", f"{path}: the unit of velocity is {unit}")
    if n > 0:
        arrays["Points"] = 3, numbers(data.GetPoints().GetData())
        indices = numbers(data.GetVerts().GetConnectivityArray())
        expect(indices == list(range(n)), f"{path}: vertices do not name the points in order")
        for name, (_, values) in arrays.items():
            expect(all(map(math.isfinite, values)), f"{path}: {name} is not finite")
    time = data.GetFieldData().GetArray("TimeValue")
    expect(time is not None and time.GetNumberOfTuples() == 1, f"{path}: no TimeValue")
    return time.GetValue(0), arrays


def read(path):
    """All frames of a collection, or the one of a file."""
    if not path.endswith(".pvd"):
        return [read_frame(path)]
    frames = []
    for entry in xml.etree.ElementTree.parse(path).getroot().iter("DataSet"):
        file = os.path.join(os.path.dirname(path), entry.get("file"))
        time, arrays = read_frame(file)
        expect(time == float(entry.get("timestep")), f"{file}: holds time {time}, listed at {entry.get('timestep')}")
        expect(not frames or time > frames[-1][0], f"{file}: time {time} does not ascend")
        frames.append((time, arrays))
    return frames


def single(value):
    """The number as 32 bits hold it."""
    return struct.unpack("f", struct.pack("f", value))[0]


def check_values(frames, path):
    number = -1
    with open(path) as lines:
        for line in lines:
            name, *rest = line.split()
            if name == "frame":
                number += 1
                expect(number < len(frames), f"{len(frames)} frames are too few")
                expect(frames[number][0] == float(rest[0]), f"frame {number}: time {frames[number][0]}")
                points = int(rest[1])
            elif points > 0:
                expect(name in frames[number][1], f"frame {number}: no {name}")
                components, values = frames[number][1][name]
                expect(components == int(rest[0]), f"frame {number}: {name} has {components} components")
                expect(len(values) == components * points, f"frame {number}: {name} has {len(values)} numbers")
                # The text holds the fewest digits that give the same 32 bits back.
                wanted = [single(float(value)) if "." in value or "e" in value else int(value) for value in rest[1:]]
                expect(values == wanted, f"frame {number}: {name} holds other values")
    expect(number + 1 == len(frames), f"{len(frames)} frames instead of {number + 1}")


def main():
    parser = argparse.ArgumentParser(description="Checks a .vtp or .pvd file with VTK.")
    parser.add_argument("file")
    parser.add_argument("--fields", help="point arrays each frame must hold")
    parser.add_argument("--particles", type=int, help="points each frame must hold")
    parser.add_argument("--frames", type=int, help="frames the collection must hold")
    parser.add_argument("--values", help="text file of everything the frames must hold")
    options = parser.parse_args()
    try:
        frames = read(options.file)
        expect(frames, f"{options.file}: no frames")
        if options.frames is not None:
            expect(len(frames) == options.frames, f"{len(frames)} frames instead of {options.frames}")
        for number, (_, arrays) in enumerate(frames):
            points = len(arrays["Points"][1]) // 3 if "Points" in arrays else 0
            if options.particles is not None:
                expect(points == options.particles, f"frame {number}: {points} points instead of {options.particles}")
            for field in options.fields.split(",") if options.fields else ():
                expect(field in arrays, f"frame {number}: no {field}; there are {', '.join(arrays)}")
        if options.values:
            check_values(frames, options.values)
    except Fault as fault:
        print(fault, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
