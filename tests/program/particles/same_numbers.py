"""Compares particles.h5 with the frames (by VTK), the tables and the page in the folder of a run.

same_numbers.py FOLDER [COEFFICIENT]

COEFFICIENT is that of friction, and says that the run is one of spheres that a source pours into a periodic
box with friction: all that only such runs have must then be there.
"""
import base64
import csv
import json
import pathlib
import re
import sys
import xml.etree.ElementTree as xml

import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

folder = pathlib.Path(sys.argv[1])
coefficient = float(sys.argv[2]) if len(sys.argv) > 2 else None
f = h5py.File(folder / "particles.h5")
particles = {name: rows[:] for name, rows in f["particles"].items()}
contacts = {name: rows[:] for name, rows in f["contacts"].items()}
frame_count = len(f["time"])


def rows_of(group, k):
    """The rows of frame k in a group of data sets, by name."""
    rows = slice(group["begin"][k], group["begin"][k + 1])
    return {name: numbers[rows] for name, numbers in group.items() if name != "begin"}


def table(name):
    """The columns of a CSV file by name."""
    rows = csv.DictReader(line for line in open(folder / name) if not line.startswith("#"))
    columns = {key: [] for key in rows.fieldnames}
    for row in rows:
        for key in columns:
            columns[key].append(float(row[key]))
    return {key: np.array(numbers) for key, numbers in columns.items()}


def same(name, a, b):
    a, b = np.asarray(a), np.asarray(b)
    assert a.shape == b.shape and np.array_equal(a, b), f"{name}: {a} and {b}"


def same_rows(name, columns, rows, keys):
    """All columns of a table and the data sets of the same numbers, sorted by `keys` of both."""
    axes = "xyz" if "z" in columns or "tangential_force_z" in columns else "xy"
    sets = {"i": rows.get("first"), "j": rows.get("second")}
    vectors = {"": "position", "v": "velocity", "tangential_force_": "tangential_force", "angular_velocity_": "angular_velocity"}
    for prefix, vector in vectors.items():
        for d, axis in enumerate(axes):
            if vector in rows and rows[vector].ndim == 2:
                sets[prefix + axis] = rows[vector][:, d]
    sets = {**rows, **sets}
    order = np.lexsort([sets[key] for key in keys])
    order_of_table = np.lexsort([columns[key] for key in keys])
    for column in columns:
        if column not in ("time", "gamma_error") and not (column.startswith("tangential_force") and coefficient is None):
            same(f"{column} of {name}", columns[column][order_of_table], sets[column][order])


# Each frame, bit for bit.
frames = [(float(d.get("timestep")), d.get("file")) for d in xml.parse(folder / "particles.pvd").getroot().iter("DataSet")]
same("time", f["time"], [time for time, _ in frames])
of = {"first": "i", "second": "j"}
for k, (_, file) in enumerate(frames):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(folder / file))
    reader.Update()
    data = reader.GetOutput()
    for group, arrays in ((particles, data.GetPointData()), (contacts, data.GetCellData())):
        rows = rows_of(group, k)
        names = set(rows) - {"position"}
        for name in names:
            same(f"{name} of frame {k}", rows[name], vtk_to_numpy(arrays.GetArray(of.get(name, name))))
        assert len(names) >= 4 and len(names) == arrays.GetNumberOfArrays(), (k, names)
    same("position", rows_of(particles, k)["position"], vtk_to_numpy(data.GetPoints().GetData()))

# The tables, bit for bit.
same_rows("final_particles.csv", table("final_particles.csv"), rows_of(particles, frame_count - 1), ["id"])
same_rows("final_contacts.csv", table("final_contacts.csv"), rows_of(contacts, frame_count - 1), ["gap", "j", "i"])
for name, group, keys in (("motion.csv", particles, ["id"]), ("contacts.csv", contacts, ["gap", "j", "i"])):
    if not (folder / name).exists():
        continue
    columns = table(name)
    assert set(columns["time"]) <= set(f["time"])
    for k, time in enumerate(f["time"]):
        at = columns["time"] == time
        same_rows(f"{name} at {time}", {key: numbers[at] for key, numbers in columns.items()}, rows_of(group, k), keys)

# The page: times and radii exactly, positions to half of its step, shares to half of a 255th.
page = open(folder / "particles.html").read()


def block(name, kind):
    found = re.search(rf'id="{name}">([^<]*)<', page)
    return np.frombuffer(base64.b64decode(found.group(1)), dtype=kind) if found else None


motion = json.loads(re.search(r'id="motion">(.*?)</script>', page).group(1))
dimension, step = motion["dimension"], np.array(motion["step"])
same("times of the page", block("times", "<f8"), f["time"])
assert f.attrs["title"] in page and '"--hdf5"' in f.attrs["provenance"]
radii = block("radii", "<f4")
count = len(radii)
first_frames = block("firstFrames", "<i4")
first_frames = np.zeros(count, int) if first_frames is None else first_frames
ids = block("ids", "<i4")
ids = np.arange(count) if ids is None else ids
assert motion["bytes"] == 2
shown = motion["low"] + step * block("positions", "<u2").reshape(frame_count, count, dimension)
for k in range(frame_count):
    rows = rows_of(particles, k)
    there = first_frames <= k
    same(f"ids of frame {k} of the page", ids[there], rows["id"])
    same(f"radii of frame {k} of the page", radii[there], rows["radius"].astype("f4"))
    off = np.abs(shown[k][there] - rows["position"][:, :dimension])
    assert (off <= 0.5001 * step + 1e-6 * np.abs(shown[k][there])).all(), off.max(0)

# Contacts of the page: the step to the next pair (seven bits in a byte), then bytes for gamma, for friction if
# there is any, and for the force. A contact with an obstacle has the obstacle first.
pairs, images = block("pairs", "<i4").reshape(-1, 2), block("images", "i1")
offsets, bytes_of = block("offsets", "<u4"), block("contacts", "u1")
assert len(offsets) == frame_count + 1
forces = np.abs(contacts["normal_force"])
loaded = np.sort(forces[forces > 0])
top = loaded[len(loaded) - 1 - len(loaded) // 50]
same("lowest gamma", motion["lowest"], contacts["gamma"].min())
for k in range(frame_count):
    on_page = {}
    at, pair = offsets[k], 0
    while at < offsets[k + 1]:
        shift = 0
        while True:
            pair += (int(bytes_of[at]) & 127) << shift
            shift += 7
            at += 1
            if not bytes_of[at - 1] & 128:
                break
        first, second = (int(number) for number in pairs[pair])
        names = (ids[second], first) if first < 0 else (ids[first], ids[second])
        size = 2 if coefficient is None else 3
        on_page[(*names, 0 if images is None else images[pair])] = bytes_of[at:at + size]
        at += size
    rows = rows_of(contacts, k)
    zeros = np.zeros(len(rows["gap"]), int)
    expected = {}
    for i in range(len(zeros)):
        shares = [255 * rows["gamma"][i] / motion["lowest"]] if rows["gamma"][i] < 0 else [0]
        if coefficient is not None:
            load = max(rows["normal_force"][i], 0)
            friction = np.linalg.norm(rows["tangential_force"][i])
            share = 254 * min(1, friction / (coefficient * load)) if load > 0 else 0
            shares.append(255 if rows["friction"][i] == 2 else share)
        shares.append(255 * min(1, abs(rows["normal_force"][i]) / top))
        expected[(rows["first"][i], rows["second"][i], rows.get("image", zeros)[i])] = shares
    assert on_page.keys() == expected.keys() and len(expected) == len(zeros), (k, on_page, expected)
    for name, shares in expected.items():
        off = np.abs(np.array(on_page[name], float) - shares)
        off[0] -= shares[0] > 0 and shares[0] < 0.5 and on_page[name][0] == 1  # gamma < 0 is at least 1
        assert (off <= 0.5 + 1e-6).all(), (k, name, on_page[name], shares)

if coefficient is not None:
    counts = np.diff(particles["begin"])
    assert counts[0] < counts[len(counts) // 4] < counts[-1], counts
    assert (contacts["image"] != 0).any()
    assert {1, 2} <= set(contacts["friction"])
    assert (np.linalg.norm(contacts["tangential_force"], axis=1) > 0).any()
    assert np.abs(np.linalg.norm(particles["orientation"], axis=1) - 1).max() < 1e-12
    assert particles["angular_velocity"].shape[1] == 3 and (particles["mass"] > 0).all()
else:
    assert "image" not in contacts and "friction" not in contacts and "tangential_force" not in contacts
