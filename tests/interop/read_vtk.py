"""Reads a .pvd and its .vtu files with VTK's own reader and prints one JSON object about each file.

    python3 read_vtk.py OUT/run.pvd

For each file: time (of the .pvd), time_value (of the file), points, cells, types (VTK's number -> how many cells),
arrays (of points: name -> type), body (of each cell), positions (flat), velocity (flat, if there is one), volume (of all
tetrahedra). Needs Debian's python3-vtk9.
"""
import json
import os
import sys
import xml.etree.ElementTree as tree

try:
    import vtk
except ImportError:
    sys.exit("the Python module vtk is missing: apt-get install python3-vtk9, and use /usr/bin/python3")


def flat(array):
    return [array.GetComponent(i, c) for i in range(array.GetNumberOfTuples()) for c in range(array.GetNumberOfComponents())]


def read(path, time):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    if grid.GetNumberOfPoints() == 0:
        sys.exit(path + ": VTK reads no points")
    points = grid.GetPointData()
    types = {}
    volume = 0.0
    for i in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(i)
        types[str(cell.GetCellType())] = types.get(str(cell.GetCellType()), 0) + 1
        if cell.GetCellType() == vtk.VTK_TETRA:
            corners = [cell.GetPoints().GetPoint(k) for k in range(4)]
            volume += vtk.vtkTetra.ComputeVolume(*corners)
    result = {
        "time": time,
        "time_value": grid.GetFieldData().GetArray("TimeValue").GetValue(0),
        "points": grid.GetNumberOfPoints(),
        "cells": grid.GetNumberOfCells(),
        "types": types,
        "volume": volume,
        "arrays": {points.GetArrayName(i): points.GetArray(i).GetDataTypeAsString() for i in range(points.GetNumberOfArrays())},
        "body": flat(grid.GetCellData().GetArray("body")),
        "positions": flat(grid.GetPoints().GetData()),
    }
    if points.GetArray("velocity"):
        result["velocity"] = flat(points.GetArray("velocity"))
    return result


def main(path):
    folder = os.path.dirname(path)
    files = [(float(entry.get("timestep")), entry.get("file")) for entry in tree.parse(path).getroot().iter("DataSet")]
    json.dump([read(os.path.join(folder, file), time) for time, file in files], sys.stdout)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: read_vtk.py OUT/run.pvd")
    main(sys.argv[1])
