"""Many discs or spheres, from a case file or from arrays."""

import pathlib
import tempfile

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
            folder = pathlib.Path(folder)
            case = _sections_of(case)
            if particles is not None:
                if "particles" in case:
                    raise InputError("the case has a section [particles] although arrays of "
                                     "particles are given; leave one of both out")
                (folder / "particles.csv").write_text(_csv(particles))
                case["particles"] = {"file": "particles.csv"}
            path = folder / "case.toml"
            path.write_text("".join(f"{_word(key)} = {_toml(value)}\n"
                                    for key, value in case.items()))
            super().__init__(path, threads=threads, restart=restart)


def _sections_of(case):
    if isinstance(case, dict):
        return dict(case)
    import tomllib  # Python 3.11

    try:
        with open(case, "rb") as file:
            return tomllib.load(file)
    except (OSError, tomllib.TOMLDecodeError) as problem:
        raise InputError(f"{case}: cannot be read ({problem})") from problem


def _csv(columns):
    """The columns as CSV. repr() of a number is read back as the same number."""
    names = [str(name) for name in columns]
    arrays = [columns[name] for name in columns]
    lengths = {len(array) for array in arrays}
    if len(lengths) != 1:
        raise InputError(f"the columns of particles, {', '.join(names)}, have the lengths "
                         f"{', '.join(str(len(array)) for array in arrays)}; they must be equal")
    rows = zip(*(getattr(array, "tolist", lambda array=array: array)() for array in arrays))
    return "".join(",".join(map(str, row)) + "\n" for row in [names, *rows])


def _word(key):
    return '"' + str(key).replace("\\", "\\\\").replace('"', '\\"') + '"'


def _toml(value):
    value = getattr(value, "tolist", lambda: value)()  # of NumPy's arrays and numbers
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_word(k)} = {_toml(v)}" for k, v in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_toml, value)) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (str, pathlib.PurePath)):
        return _word(value)
    raise InputError(f"{value!r} is not possible in a case; values are numbers, texts, True or "
                     "False, and lists and dictionaries of them")
