"""ParaView opens frames, links and flows by their .pvd files: pvpython read_by_paraview.py RUNS"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from paraview.servermanager import Fetch
from paraview.simple import GetParaViewVersion, OpenDataFile
from vtkmodules.util.numpy_support import vtk_to_numpy

import runs


def block_at(source, time):
    source.UpdatePipeline(time)
    data = Fetch(source)
    while hasattr(data, "GetBlock"):
        data = data.GetBlock(0)
    return data


def arrays_of(group):
    return {group.GetArrayName(k): vtk_to_numpy(group.GetArray(k)) for k in range(group.GetNumberOfArrays())}


read = 0
for run in runs.PARTICLES:
    for kind in ("particles", "links", "flow"):
        if not (runs.RUNS / run / f"{kind}.pvd").exists():
            continue
        files = runs.frames(run, kind)
        source = OpenDataFile(str(runs.RUNS / run / f"{kind}.pvd"))
        runs.same(f"times of {run}", list(source.TimestepValues), [time for time, _ in files])
        for time, file in files:
            data = block_at(source, time)
            assert data is not None and (data.GetNumberOfPoints() > 0 or run == "pour" and time == 0), file
            read += 1
        points, cells = arrays_of(data.GetPointData()), arrays_of(data.GetCellData())
        if kind == "particles":
            last = runs.last_particles(run)
            runs.same(f"places of {run}", vtk_to_numpy(data.GetPoints().GetData()), runs.positions(last))
            runs.same(f"radii of {run}", points["radius"], last["radius"])
            runs.same(f"ids of {run}", points["id"], last["id"])
            assert run not in ("dry", "pour") or len(cells["gamma"]) == data.GetNumberOfCells() > 0
        elif kind == "flow":
            assert data.GetNumberOfCells() > 100 and points["speed"].max() > 0
            # Quadratic triangles with six nodes.
            assert data.GetCell(0).GetCellType() == 22 and data.GetCell(0).GetNumberOfPoints() == 6
        else:
            assert cells["kind"].tolist() == [1] and cells["force"].shape == (1, 3)
print(f"ParaView {GetParaViewVersion()} read {read} files")
assert read > 15
