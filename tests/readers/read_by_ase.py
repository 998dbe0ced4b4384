"""ASE reads particles.xyz: python3 read_by_ase.py RUNS"""
import ase
import ase.io
import numpy as np

import runs

CELLS = {"dry": ([True, False, False], [[10, 0, 0], [0, 8, 0], [0, 0, 2]]),
         "pour": ([True, True, False], [[6, 0, 0], [0, 6, 0], [0, 0, 10]]),
         "fluid": ([False] * 3, [[8, 0, 0], [0, 8, 0], [0, 0, 2]]),
         "axis": ([False] * 3, [[8, 0, 0], [0, 8, 0], [0, 0, 8]])}
read = 0
for run, (periodic, cell) in CELLS.items():
    all_atoms = ase.io.read(runs.RUNS / run / "particles.xyz", index=":")
    times = [time for time, _ in runs.frames(run, "particles")]
    runs.same(f"times of {run}", [atoms.info["Time"] for atoms in all_atoms], times)
    assert all_atoms[0].info["provenance"].startswith('{"command":['), all_atoms[0].info
    last, expected = all_atoms[-1], runs.last_particles(run)
    runs.same(f"periods of {run}", last.pbc, periodic)
    assert np.allclose(last.cell[:], np.array(cell), rtol=1e-12), last.cell
    runs.same(f"places of {run}", last.positions, runs.positions(expected))
    for array, column in (("radius", "radius"), ("id", "id")):
        runs.same(f"{array} of {run}", last.arrays[array], expected[column])
    if "mass" in last.arrays:
        runs.same(f"masses of {run}", last.arrays["mass"], expected["mass"])
        last.set_masses(last.arrays["mass"])
    assert last.arrays["velo"].shape == (len(last), 3)
    read += len(all_atoms)
print(f"ASE {ase.__version__} read {read} frames")
assert read > 10
