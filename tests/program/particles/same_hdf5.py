"""same_hdf5.py ONE OTHER: two HDF5 files have the same data sets with the same types and numbers."""
import sys

import h5py
import numpy as np


def sets_of(name):
    sets = {}
    with h5py.File(name) as file:
        file.visititems(lambda path, item: sets.update({path: item[:]}) if isinstance(item, h5py.Dataset) else None)
    return sets


one, other = sets_of(sys.argv[1]), sets_of(sys.argv[2])
assert len(one) > 10 and one.keys() == other.keys(), (one.keys(), other.keys())
for name, numbers in one.items():
    assert numbers.dtype == other[name].dtype and np.array_equal(numbers, other[name]), name
