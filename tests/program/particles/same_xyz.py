"""Compares particles.xyz with the frames (by VTK) in the folder of a run, bit for bit.

same_xyz.py FOLDER "PBC" "LATTICE at the end" "ORIGIN"
"""
import pathlib
import re
import sys
import xml.etree.ElementTree as xml

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

folder = pathlib.Path(sys.argv[1])
lines = (folder / "particles.xyz").read_text().split("\n")
assert lines.pop() == ""
frames = [(d.get("timestep"), d.get("file")) for d in xml.parse(folder / "particles.pvd").getroot().iter("DataSet")]


def keys_of(line):
    return {key: value or quoted or single for key, value, quoted, single in
            re.findall(r"""(\w+)=(?:"([^"]*)"|'([^']*)'|(\S+))""", line)}


at, columns = 0, None
for number, (time, file) in enumerate(frames):
    count = int(lines[at])
    keys = keys_of(lines[at + 1])
    assert ("provenance" in keys) == (number == 0), keys
    assert keys["Time"] == time, (keys["Time"], time)
    assert keys["pbc"] == sys.argv[2], keys
    names = re.findall(r"(\w+):([SRI]):(\d+)", keys["Properties"])
    assert names == (columns or names), "OVITO takes the columns of the first frame for all frames"
    columns = names
    rows = [line.split(" ") for line in lines[at + 2:at + 2 + count]]
    at += 2 + count
    place, read = 0, {}
    for name, kind, width in names:
        width = int(width)
        part = [row[place:place + width] for row in rows]
        place += width
        if kind != "S":
            part = np.array(part, float if kind == "R" else int).reshape(count, width)
        read[name] = part if kind == "S" or width > 1 else part[:, 0]
    assert all(len(row) == place for row in rows)
    assert all(row == ["X"] for row in read["species"])
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(folder / file))
    reader.Update()
    data = reader.GetOutput()
    assert data.GetNumberOfPoints() == count
    if count == 0:
        continue
    arrays = {data.GetPointData().GetArrayName(k): vtk_to_numpy(data.GetPointData().GetArray(k))
              for k in range(data.GetPointData().GetNumberOfArrays())}
    arrays["Points"] = vtk_to_numpy(data.GetPoints().GetData())
    of = {"Points": "pos", "velocity": "velo"}
    for name, numbers in arrays.items():
        if name not in ("angular_velocity", "orientation"):
            assert np.array_equal(numbers, read[of.get(name, name)]), (number, name)
    if "angle" in arrays:
        assert not read["omega"][:, :2].any() and np.array_equal(read["omega"][:, 2], arrays["angular_velocity"])
        assert np.allclose(2 * np.arctan2(read["orientation"][:, 2], read["orientation"][:, 3]),
                           (arrays["angle"] + np.pi) % (2 * np.pi) - np.pi, atol=1e-12)
    if "orientation" in arrays:
        assert np.array_equal(read["omega"], arrays["angular_velocity"])
        assert np.array_equal(read["orientation"], arrays["orientation"][:, [1, 2, 3, 0]])
    cells = data.GetCellData()
    gammas, forces = (vtk_to_numpy(cells.GetArray(name)) for name in ("gamma", "normal_force"))
    sums = np.zeros((count, 3))
    for k in range(data.GetNumberOfCells()):
        cell = data.GetCell(k)
        for p in range(cell.GetNumberOfPoints()):
            sums[cell.GetPointId(p)] += gammas[k], forces[k], 1
    assert np.allclose(sums[:, 0], read["gamma"], rtol=1e-14) and np.allclose(sums[:, 1], read["normal_force"], rtol=1e-14)
    assert np.array_equal(sums[:, 2], read["contacts"])
assert at == len(lines)
lattice = [float(word) for word in keys.get("Lattice", "").split()]
assert np.allclose(lattice, [float(word) for word in sys.argv[3].split()], rtol=1e-12, atol=1e-12), lattice
assert keys.get("Origin", "") == sys.argv[4], keys
