"""h5py reads particles.h5: python3 read_by_h5py.py RUNS"""
import h5py

import runs

for run in ("dry", "pour"):
    with h5py.File(runs.RUNS / run / "particles.h5") as file:
        times = [time for time, _ in runs.frames(run, "particles")]
        runs.same(f"times of {run}", file["time"][:], times)
        begin, end = file["particles/begin"][-2:]
        last = runs.last_particles(run)
        runs.same(f"places of {run}", file["particles/position"][begin:end], runs.positions(last))
        for name in ("radius", "mass", "id"):
            runs.same(f"{name} of {run}", file[f"particles/{name}"][begin:end], last[name])
        assert isinstance(file.attrs["title"], str) and '"command":[' in file.attrs["provenance"]
print(f"h5py {h5py.__version__} read 2 files")
