"""Spheres and discs in a viscous fluid: lubrication forces and viscous contact.

Fit, PairFit                      fitted lubrication forces, on arrays
tabulate, fit, fit_pair           tables by FreeFEM, and fits of tables
pair_resistance                   two spheres: all motions and strains, on arrays
film_gamma, film_gap              the impulse of a film, and its gap
simulate, rolling, swimmer        motions of single spheres, as arrays
Particles                         many discs or spheres, step by step
read                              files and folders that Viscontact wrote, as arrays

Lengths, masses and times are in any consistent units: those of the case, table or fit. Nothing is
converted. [L], [M] and [T] are the dimensions. Errors are exceptions with the message of the
program: InputError (also a ValueError), NotConvergedError (also an ArithmeticError),
ExternalProgramError, all of them Error. Ctrl-C stops every call; other threads of Python run during
long ones. docs/python.md shows how to use the module, and docs/physics.md has the equations.
"""

import pathlib as _pathlib
import sys as _sys

try:
    from ._core import (Error, ExternalProgramError, Fit, InputError, NotConvergedError, PairFit,
                        Rheology, StepReport, __version__, _tabulate, film_gamma, film_gap, fit, fit_pair,
                        pair_resistance, rolling, simulate, swimmer)
except ModuleNotFoundError as problem:
    if problem.name != f"{__name__}._core":
        raise
    _folder = _pathlib.Path(__file__).parent
    _built = ", ".join(sorted(file.name for file in _folder.glob("_core.*"))) or "no library"
    raise ImportError(
        f"{_folder} has {_built}, but this is Python {_sys.version_info.major}."
        f"{_sys.version_info.minor} ({_sys.executable}). The module works with the Python for which "
        "it was built: /usr/bin/python3 of Debian, unless Python3_EXECUTABLE named another one "
        "(docs/python.md)", name=problem.name) from None
from .columns import Columns
from .particles import Particles
from .results import Folder, Frames, read

__all__ = ["Columns", "Error", "ExternalProgramError", "Fit", "Folder", "Frames", "InputError",
           "NotConvergedError", "PairFit", "Particles", "Rheology", "StepReport", "film_gamma", "film_gap",
           "fit", "fit_pair", "pair_resistance", "read", "rolling", "simulate", "swimmer", "tabulate",
           "__version__"]


def tabulate(case, output, *, jobs=0, motions=None):
    """Tabulates the forces on a sphere with FreeFEM, as `viscontact tabulate`.

    case       case file with the section [tabulation] or [swimmer] (TOML)
    output     the table to be written (CSV); for several motions a folder, in which each gets
               MOTION.csv
    jobs       number of processes of FreeFEM at once; 0: one for each core
    motions    "approach", "slide", "roll", "spin", "axial_strain", "shear_strain", "twofold_strain",
               or "all", or a list of them; None: those of the case

    Finished rows are kept if the call is interrupted; the same call goes on. Returns the table as
    read() does, or for several motions a dictionary of tables by their motions.
    """
    names = [] if motions is None else [motions] if isinstance(motions, str) else list(motions)
    if motions is not None and not names:
        raise InputError("motions is an empty list; it must name at least one motion, or be None for "
                         "those of the case")
    files = _tabulate(case, output, jobs, names)
    tables = {file.stem: read(file) for file in files}
    return tables if len(tables) > 1 else next(iter(tables.values()))
