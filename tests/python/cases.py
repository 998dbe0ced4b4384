"""What the tests of the Python module share: paths, and numbers that the C++ libraries print."""

import os
import pathlib
import subprocess

import numpy as np

SOURCE = pathlib.Path(os.environ["VISCONTACT_SOURCE"])
DATA = SOURCE / "data"


def values(*words):
    """What python_values prints, a row of numbers for each line."""
    printed = subprocess.run([os.environ["VISCONTACT_VALUES"], *map(str, words)], check=True,
                             capture_output=True, text=True).stdout
    return np.array([[float.fromhex(word) for word in line.split()]
                     for line in printed.splitlines()])


def spread(interval, count=50):
    """Gaps from one end of an interval to the other, ends included."""
    gaps = np.geomspace(*interval, count)
    gaps[0], gaps[-1] = interval
    return gaps
