# %% [markdown]
# # A box of discs with a force of one's own
#
# 400 discs fall into a box. From t = 30 on, a magnet above the middle of the box lifts those that
# are near it. The program sets its force on each disc in each step; Viscontact computes the contacts.
#
# Jupyter opens this file by Jupytext, and editors by their mode for cells. As a program, type in
# the source folder of Viscontact `python3 examples/python/own_force.py`.
#
# Numbers are in the units of the case. An error, such as a missing file or a motion that cannot be
# computed, ends the program with an exception of `viscontact`. A test compares the output with the
# lines that follow.
#
# It prints:
#
# 400 discs in 600 steps: centre of mass at 14
# weight 400, on the floor 400
# the magnet holds discs: True

# %%
import numpy as np

import viscontact

# %% [markdown]
# ## The case
#
# The discs start on a lattice that is not quite regular. The sections of a case file are a
# dictionary here, and the particles are arrays.

# %%
rng = np.random.default_rng(1)
x, y = np.meshgrid(2.1 * np.arange(20) + 1.1, 2.1 * np.arange(20) + 1.1)
x, y = np.array([x.ravel(), y.ravel()]) + rng.uniform(-0.04, 0.04, (400, 2)).T
case = {
    "title": "A box of discs",
    "space": {"dimension": 2, "gravity": [0.0, -1.0]},
    "viscous_contact": {"time_step": 0.05, "end_time": 40.0, "gamma_min": -0.05},
    "solver": {"impulse_tolerance": 1e-6},
    "plane": [{"point": [0.0, 0.0], "normal": [0.0, 1.0]},
              {"point": [0.0, 0.0], "normal": [1.0, 0.0]},
              {"point": [43.0, 0.0], "normal": [-1.0, 0.0]}],
}
discs = viscontact.Particles(
    case, {"x": x, "y": y, "radius": rng.uniform(0.8, 1.0, 400), "mass": np.ones(400)})

# %% [markdown]
# ## They fall
#
# `positions` is a view of the present state, without a copy.

# %%
steps = discs.run(30.0)
positions = discs.positions
print(f"{len(discs)} discs in {steps} steps: centre of mass at {positions[:, 1].mean():.0f}")

# %% [markdown]
# The forces of the contacts with the floor bear the weight.

# %%
contacts = discs.contacts()
floor = contacts.first == -1
print(f"weight {discs.masses.sum():g}, on the floor {contacts.normal_force[floor].sum():.0f}")

# %% [markdown]
# ## The magnet
#
# It pulls towards its place, with a force that falls with the cube of the distance.

# %%
magnet = np.array([21.5, 38.0])
while not discs.finished:
    towards = magnet - positions
    distance = np.linalg.norm(towards, axis=1, keepdims=True)
    discs.forces[:] = 3e3 * towards / (distance**4 + 1e2)
    discs.step()
print(f"the magnet holds discs: {bool(np.any(distance < 3))}")
