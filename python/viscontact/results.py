"""Reads the files that Viscontact writes: tables, JSON, frames, and the folders of runs.

read() is for users of the module. Numbers keep the units of the file. A file that is missing,
damaged or of another kind raises InputError; a name that a folder lacks raises KeyError, a frame
that does not exist IndexError. Numbers are not checked. A change must keep files of earlier
versions readable.
"""

import base64
import collections.abc
import csv
import json
import pathlib
import xml.etree.ElementTree
import zlib

import numpy

from ._core import InputError
from .columns import Columns

# Columns of numbers that name something; all others are of floating point.
_INTEGERS = {"id", "i", "j", "first", "second", "step", "steps"}

# The types of VTK.
_TYPES = {"Float64": "f8", "Float32": "f4", "Int64": "i8", "Int32": "i4", "Int8": "i1",
          "UInt64": "u8", "UInt32": "u4", "UInt8": "u1"}


def read(path):
    """A file or a folder that Viscontact wrote.

    *.csv         Columns: an array for each column, NaN where a field is empty, text if a column is
                  no number; `about` has the comments, and as "provenance" how the file was made
    *.json        dictionaries and lists
    *.vtp, *.vtu  Columns of the points and their data; `about` has "cells", Columns of the data of
                  the cells, whose own `about` has the arrays of VTK that say which points they join
    *.pvd         list of times [T] and paths
    a folder      Folder

    Units are those of the file. Raises InputError if the file cannot be read.
    """
    path = pathlib.Path(path)
    if path.is_dir():
        return Folder(path)
    if not path.exists():
        raise InputError(f"{path}: there is no such file or folder")
    reader = _READERS.get(path.suffix)
    if reader is None:
        raise InputError(f"{path}: files with this ending cannot be read; there are "
                         f"{', '.join(_READERS)}")
    try:
        return reader(path)
    except (OSError, ValueError, KeyError, IndexError, AttributeError, SyntaxError,
            zlib.error) as problem:
        raise InputError(f"{path}: cannot be read ({problem})") from problem


class Folder(collections.abc.Mapping):
    """The files of a folder by their paths in it: run["steps.csv"] is read when it is asked for.

    path       of the folder
    frames     the frames of many particles, each read when it is asked for: frames[-1] is the last
    """

    def __init__(self, path):
        self.path = pathlib.Path(path)

    def __getitem__(self, name):
        file = self.path / name
        if not file.is_file():
            raise KeyError(f"{file} does not exist")
        return read(file)

    def __iter__(self):
        for file in sorted(self.path.rglob("*")):
            if file.is_file() and file.suffix in _READERS:
                yield file.relative_to(self.path).as_posix()

    def __len__(self):
        return sum(1 for _ in self)

    def __repr__(self):
        return f"<viscontact.Folder {self.path}: {', '.join(list(self)[:8])}, ...>"

    @property
    def frames(self):
        return Frames(read(self.path / "particles.pvd"))


class Frames(collections.abc.Sequence):
    """Frames in order of time, as read() gives them.

    times      (F,) [T]
    """

    def __init__(self, times_and_files):
        self.times = numpy.array([time for time, _ in times_and_files])
        self._files = [file for _, file in times_and_files]

    def __getitem__(self, k):
        if isinstance(k, slice):
            return Frames(list(zip(self.times, self._files))[k])
        return read(self._files[k])

    def __len__(self):
        return len(self._files)


def _read_csv(path):
    about = {}
    with open(path, newline="", encoding="utf-8") as file:
        start = 0
        while (line := file.readline()).startswith("#"):
            key, _, value = line[1:].partition(":")
            about[key.strip()] = value.strip()
            start = file.tell()
        if "provenance" in about:
            about["provenance"] = json.loads(about["provenance"])
        file.seek(start)
        rows = list(csv.reader(file))
    if not rows:
        raise ValueError("it has no header")
    names, rows = rows[0], rows[1:]
    for number, row in enumerate(rows, 2):
        if len(row) != len(names):
            raise ValueError(f"row {number - 1} has {len(row)} fields, and the header {len(names)}")
    fields = list(zip(*rows)) if rows else [()] * len(names)
    return Columns({name: _column(name, texts) for name, texts in zip(names, fields)}, about)


def _column(name, texts):
    try:
        numbers = numpy.array([float(text) if text else numpy.nan for text in texts], dtype=float)
    except ValueError:
        return numpy.array(texts)
    if name in _INTEGERS and numpy.all(numbers == numpy.floor(numbers)):
        return numbers.astype(int)
    return numbers


def _read_json(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def _read_pvd(path):
    return [(float(frame.get("timestep")), path.parent / frame.get("file"))
            for frame in xml.etree.ElementTree.parse(path).iter("DataSet")]


def _read_vtk(path):
    root = xml.etree.ElementTree.parse(path).getroot()
    order = "<" if root.get("byte_order") == "LittleEndian" else ">"
    size_type = numpy.dtype(order + _TYPES[root.get("header_type")])

    def array(element):
        numbers = numpy.frombuffer(_inline_bytes(element.text.strip(), size_type),
                                   order + _TYPES[element.get("type")])
        components = int(element.get("NumberOfComponents", "1"))
        native = numbers.astype(numbers.dtype.newbyteorder("="))
        return native.reshape(-1, components) if components > 1 else native

    piece = root.find(".//Piece")
    points = Columns({"points": array(piece.find("Points/DataArray"))})
    for element in piece.iterfind("PointData/DataArray"):
        points[element.get("Name")] = array(element)
    cells = Columns({element.get("Name"): array(element)
                     for element in piece.iterfind("CellData/DataArray")})
    for kind in ("Verts", "Lines", "Cells"):
        if piece.find(kind) is not None:
            cells.about[kind.lower()] = {element.get("Name"): array(element)
                                         for element in piece.iterfind(f"{kind}/DataArray")}
    points.about["cells"] = cells
    return points


def _inline_bytes(text, size_type):
    """The bytes of an array that VTK's format has as base64 of blocks that zlib has compressed."""
    def in_base64(count):
        return (count * size_type.itemsize + 2) // 3 * 4

    blocks = int(numpy.frombuffer(base64.b64decode(text[:in_base64(3)]), size_type)[0])
    begin = in_base64(3 + blocks)
    sizes = numpy.frombuffer(base64.b64decode(text[:begin]), size_type)[3:]
    data = base64.b64decode(text[begin:])
    ends = numpy.cumsum(sizes, dtype=int)
    return b"".join(zlib.decompress(data[end - int(size):end]) for end, size in zip(ends, sizes))


_READERS = {".csv": _read_csv, ".json": _read_json, ".pvd": _read_pvd, ".vtp": _read_vtk,
            ".vtu": _read_vtk}
