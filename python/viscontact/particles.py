"""Many discs or spheres, from a case file or from arrays, for users of the module.

Numbers are in any consistent units; nothing is converted. A case or array that cannot be used
raises InputError, mostly from the reader of case files, which checks their ranges; steps raise
what the class Particles of python/particles.cpp says. A change must keep that arrays and a case
file with the same numbers give the same bits.
"""

import json
import pathlib
import tempfile

import numpy

from ._core import InputError
from ._core import Particles as _Particles


class Particles(_Particles):
    __doc__ = _Particles.__doc__

    def __init__(self, case, particles=None, *, threads=1, restart=None):
        if particles is None and not isinstance(case, dict):
            super().__init__(case, threads=threads, restart=restart)
            return
        # The reader of case files checks all that is given, so that there is one set of rules.
        with tempfile.TemporaryDirectory(prefix="viscontact-") as folder:
            path = pathlib.Path(folder) / "case.toml"
            sections = _sections_of(case)
            if particles is not None:
                if "particles" in sections:
                    raise InputError("the case has a section [particles] although arrays of "
                                     "particles are given; leave one of both out")
                (path.parent / "particles.csv").write_text(_csv(particles))
                sections["particles"] = {"file": "particles.csv"}
            path.write_text("".join(f"{json.dumps(str(key))} = {_toml(value)}\n"
                                    for key, value in sections.items()))
            try:
                super().__init__(path, threads=threads, restart=restart)
            except InputError as problem:
                # Lines of the files that are gone say nothing but the row of a particle.
                words = str(problem).replace(str(path.parent) + "/particles.csv", "particles")
                raise InputError(words.replace(str(path), "the case")) from None


def _sections_of(case):
    """The sections of a case, with absolute names of the files that it names.

    InputError if the case is a file that cannot be read; what is in it is not checked.
    """
    if isinstance(case, dict):
        sections, folder = dict(case), pathlib.Path.cwd()
    else:
        import tomllib  # Python 3.11

        try:
            with open(case, "rb") as file:
                sections = tomllib.load(file)
        except (OSError, tomllib.TOMLDecodeError) as problem:
            raise InputError(f"{case}: cannot be read ({problem})") from problem
        folder = pathlib.Path(case).resolve().parent
    sections.setdefault("title", "Particles")
    if isinstance(sections.get("particles"), dict) and "file" in sections["particles"]:
        sections["particles"] = {"file": str(folder / sections["particles"]["file"])}
    fluid = sections.get("fluid")
    if isinstance(fluid, dict) and "solver" in fluid:
        words = [str(word) for word in fluid["solver"]]
        sections["fluid"] = {**fluid, "solver": [
            str(folder / word) if (folder / word).is_file() else word for word in words]}
    return sections


def _csv(columns):
    """The columns as CSV. str() of a number is read back as the same number.

    InputError if they are no columns of equal length, or have masked values.
    """
    names = getattr(getattr(columns, "dtype", None), "names", None)  # of a structured array
    if names is None:
        if isinstance(columns, (str, bytes, numpy.ndarray)) or not hasattr(columns, "keys"):
            raise InputError(f"particles are of the type {type(columns).__name__}; they must be a "
                             "dictionary of arrays, a structured array, or a DataFrame of pandas")
        names = list(columns.keys())
    for name in names:
        if numpy.ma.is_masked(columns[name]):
            raise InputError(f"the column {name} of particles has masked values; a particle needs "
                             "a number there")
    arrays = {str(name): numpy.asarray(columns[name]) for name in names}
    shapes = {name: array.shape for name, array in arrays.items()}
    if not arrays or any(len(shape) != 1 for shape in shapes.values()) or len(
            set(shapes.values())) != 1:
        words = ", ".join(f"{name} {shape}" for name, shape in shapes.items()) or "none"
        raise InputError(f"the columns of particles have the shapes {words}; they must be arrays "
                         "of one dimension and of equal length")
    rows = zip(*(array.tolist() for array in arrays.values()))
    return "".join(",".join(map(str, row)) + "\n" for row in [list(arrays), *rows])


def _toml(value):
    """The value as TOML; InputError for a type that no case has. NaN is not refused here."""
    value = getattr(value, "tolist", lambda: value)()  # of NumPy's arrays and numbers
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(str(k))} = {_toml(v)}" for k, v in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_toml, value)) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (str, pathlib.PurePath)):
        return json.dumps(str(value))
    raise InputError(f"{value!r} is not possible in a case; values are numbers, texts, True or "
                     "False, and lists and dictionaries of them")
