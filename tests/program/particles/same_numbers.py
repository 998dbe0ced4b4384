"""Compares particles.h5 with the frames (by VTK), the tables and the page in the folder of a run."""
import base64
import csv
import json
import pathlib
import re
import sys
import xml.etree.ElementTree as xml

try:
    import h5py
except ImportError:
    print("no h5py")
    sys.exit(77)
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

folder = pathlib.Path(sys.argv[1])
f = h5py.File(folder / "particles.h5")


def table(name):
    rows = csv.DictReader(line for line in open(folder / name) if not line.startswith("#"))
    rows = list(rows)
    return {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}


def same(name, a, b):
    a, b = np.asarray(a), np.asarray(b)
    assert a.shape == b.shape and np.array_equal(a, b), f"{name}: {a} and {b}"


# Each frame, bit for bit.
frames = [(float(d.get("timestep")), d.get("file")) for d in xml.parse(folder / "particles.pvd").getroot().iter("DataSet")]
same("time", f["time"], [time for time, _ in frames])
of = {"first": "i", "second": "j"}
for k, (_, name) in enumerate(frames):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(folder / name))
    reader.Update()
    data = reader.GetOutput()
    for group, arrays in (("particles", data.GetPointData()), ("contacts", data.GetCellData())):
        rows = slice(f[group]["begin"][k], f[group]["begin"][k + 1])
        names = set(f[group]) - {"begin", "position"}
        for name in names:
            array = arrays.GetArray(of.get(name, name))
            same(f"{group}/{name} of frame {k}", f[group][name][rows], vtk_to_numpy(array))
        assert len(names) >= 4 and len(names) == arrays.GetNumberOfArrays(), names
    rows = slice(f["particles/begin"][k], f["particles/begin"][k + 1])
    same("position", f["particles/position"][rows], vtk_to_numpy(data.GetPoints().GetData()))

# The last frame and the tables at the end, bit for bit.
last = slice(f["particles/begin"][-2], f["particles/begin"][-1])
end = table("final_particles.csv")
for d, axis in enumerate("xy"):
    same(axis, f["particles/position"][last, d], end[axis])
    same("v" + axis, f["particles/velocity"][last, d], end["v" + axis])
for name in ("radius", "mass", "id"):
    same(name, f["particles"][name][last], end[name])
last = slice(f["contacts/begin"][-2], f["contacts/begin"][-1])
contacts = table("final_contacts.csv")
key = lambda i, j: sorted(range(len(i)), key=lambda k: (i[k], j[k]))
order = key(f["contacts/first"][last], f["contacts/second"][last])
order_csv = key(contacts["i"], contacts["j"])
for name, column in (("first", "i"), ("second", "j"), ("gap", "gap"), ("gamma", "gamma"), ("normal_force", "normal_force")):
    same(name, f["contacts"][name][last][order], contacts[column][order_csv])

# The page: times and radii exactly, positions to half of its step, forces to half of a 255th.
page = open(folder / "particles.html").read()
block = lambda name, kind: np.frombuffer(
    base64.b64decode(re.search(rf'id="{name}">([^<]*)<', page).group(1)), dtype=kind)
motion = json.loads(re.search(r'id="motion">(.*?)</script>', page).group(1))
same("times of the page", block("times", "<f8"), f["time"])
count = len(end["x"])
same("radii of the page", block("radii", "<f4"), f["particles/radius"][:count].astype("f4"))
assert motion["bytes"] == 2
shown = motion["low"] + np.array(motion["step"]) * block("positions", "<u2").reshape(-1, 2)
off = np.abs(shown - f["particles/position"][:, :2])
assert (off <= 0.5001 * np.array(motion["step"]) + 1e-6 * np.abs(shown)).all(), off.max(0)
assert len(block("offsets", "<u4")) == len(frames) + 1
# Of each contact a byte or more for its pair, one for gamma and one for its force.
bytes_of = block("contacts", "u1")
at, forces = 0, []
while at < len(bytes_of):
    while bytes_of[at] & 128:
        at += 1
    forces.append(bytes_of[at + 2] / 255)
    at += 3
all_forces = np.abs(f["contacts/normal_force"][:])
loaded = np.sort(all_forces[all_forces > 0])
top = loaded[len(loaded) - 1 - len(loaded) // 50]
expected = np.minimum(1, all_forces / top)
assert np.abs(np.sort(forces) - np.sort(expected)).max() <= 0.5 / 255 + 1e-9
