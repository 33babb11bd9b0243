#!/usr/bin/python3
"""Writes the cube_*.vtk and cube_*.vtu of this folder, with Debian's python3-vtk9: cube_vtk.py FOLDER"""
import os
import sys

import vtk

out = sys.argv[1]
os.makedirs(out, exist_ok=True)

CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1), (0.5, 0.5, 0.5)]
FACES = [(0, 1, 2), (0, 2, 3), (4, 6, 5), (4, 7, 6), (0, 5, 1), (0, 4, 5), (3, 2, 6), (3, 6, 7), (0, 3, 7), (0, 7, 4),
         (1, 6, 2), (1, 5, 6)]


def add_cell(grid, cell, nodes):
    for i, node in enumerate(nodes):
        cell.GetPointIds().SetId(i, node)
    grid.InsertNextCell(cell.GetCellType(), cell.GetPointIds())


def add_array(data, array, name, values):
    array.SetName(name)
    for value in values:
        array.InsertNextValue(value)
    data.AddArray(array)


def make_cube():
    """A unit cube: twelve tetrahedra about its centre, one triangle of its surface, data of every kind."""
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    for corner in CORNERS:
        points.InsertNextPoint(*corner)
    grid = vtk.vtkUnstructuredGrid()
    grid.SetPoints(points)
    for face in FACES:
        add_cell(grid, vtk.vtkTetra(), face + (8,))
    add_cell(grid, vtk.vtkTriangle(), FACES[0])
    add_array(grid.GetPointData(), vtk.vtkDoubleArray(), "temperature", [0.25 * i for i in range(9)])
    add_array(grid.GetCellData(), vtk.vtkIntArray(), "region", range(13))
    add_array(grid.GetFieldData(), vtk.vtkDoubleArray(), "TimeValue", [1.5])
    return grid


cube = make_cube()
for version in (42, 51):
    for binary in (False, True):
        writer = vtk.vtkUnstructuredGridWriter()
        writer.SetFileName(f"{out}/cube_{version}_{'binary' if binary else 'ascii'}.vtk")
        writer.SetFileVersion(version)
        writer.SetHeader("a cube of tetrahedra")
        writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
        writer.SetInputData(cube)
        writer.Write()


def write_xml(name, **settings):
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(f"{out}/cube_{name}.vtu")
    writer.SetInputData(cube)
    for setting, values in settings.items():
        getattr(writer, setting)(*values)
    writer.Write()


plain = {"SetCompressorTypeToNone": ()}
zlib = {"SetCompressorTypeToZLib": (), "SetBlockSize": (40,)}  # several blocks an array
write_xml("ascii_plain", SetDataModeToAscii=(), **plain)
for end, packing in (("plain", plain), ("zlib", zlib)):
    write_xml(f"binary_{end}", SetDataModeToBinary=(), **packing)
    write_xml(f"appended_{end}", SetDataModeToAppended=(), EncodeAppendedDataOff=(), **packing)
    write_xml(f"appended64_{end}", SetDataModeToAppended=(), EncodeAppendedDataOn=(), **packing)
write_xml("big_endian", SetDataModeToBinary=(), SetByteOrderToBigEndian=(), SetHeaderTypeToUInt64=(),
          SetCompressorTypeToZLib=())
write_xml("lz4", SetDataModeToBinary=(), SetCompressorTypeToLZ4=())
