"""What the tests of readers expect: the numbers in the tables of the runs of scripts/test_readers."""
import csv
import pathlib
import sys
import xml.etree.ElementTree as xml

import numpy as np

RUNS = pathlib.Path(sys.argv[1])
PARTICLES = {"dry": 3, "fluid": 1, "axis": 1, "pour": None}


def last_particles(run):
    """The columns of final_particles.csv by name."""
    rows = csv.DictReader(line for line in open(RUNS / run / "final_particles.csv") if not line.startswith("#"))
    columns = {name: [] for name in rows.fieldnames}
    for row in rows:
        for name in columns:
            columns[name].append(float(row[name]))
    return {name: np.array(numbers) for name, numbers in columns.items()}


def positions(columns):
    """Places as frames have them: on an axis they are on z."""
    count = len(columns["radius"])
    if "x" not in columns:
        return np.column_stack([np.zeros(count), np.zeros(count), columns["z"]])
    return np.column_stack([columns["x"], columns["y"], columns.get("z", np.zeros(count))])


def frames(run, kind):
    """Times and files of a .pvd file."""
    return [(float(d.get("timestep")), RUNS / run / d.get("file"))
            for d in xml.parse(RUNS / run / f"{kind}.pvd").getroot().iter("DataSet")]


def same(what, a, b):
    assert np.array_equal(np.asarray(a), np.asarray(b)), f"{what}: {a} is not {b}"
