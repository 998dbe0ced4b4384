"""meshio reads the flows: python3 read_by_meshio.py RUNS"""
import meshio
import numpy as np

import runs

read = 0
for run in ("fluid", "axis"):
    for _, file in runs.frames(run, "flow"):
        mesh = meshio.read(file)
        assert [block.type for block in mesh.cells] == ["triangle6"] and len(mesh.cells[0].data) > 100
        velocity, speed = mesh.point_data["velocity"], mesh.point_data["speed"]
        assert velocity.shape == (len(mesh.points), 3) == mesh.points.shape
        # hypot() of two numbers and the norm of three differ by rounding.
        assert np.allclose(np.linalg.norm(velocity, axis=1), speed, rtol=1e-14, atol=0) and speed.max() > 0
        assert np.isfinite(mesh.point_data["pressure"]).all()
        read += 1
print(f"meshio {meshio.__version__} read {read} files")
assert read >= 2
