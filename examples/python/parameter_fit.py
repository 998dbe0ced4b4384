# %% [markdown]
# # Viscosity and mass from a measured motion
#
# A sphere is pushed towards a plane and pulled back, and its gap is measured with an error of a
# thousandth of the radius. Which viscosity and which mass explain the measurement best? Gauss and
# Newton's method answers with the model `inertial`, and says how well both are known.
#
# Jupyter opens this file by Jupytext, and editors by their mode for cells. As a program, type in
# the source folder of Viscontact `python3 examples/python/parameter_fit.py`.
#
# Numbers are in the units of the case. An error, such as a missing file or a motion that cannot be
# computed, ends the program with an exception of `viscontact`. A test compares the output with the
# lines that follow.
#
# It prints:
#
# viscosity: 3.4 within 0.06 %
# mass: 24 within 0.2 %
# misfit of a measured gap: 0.0009

# %%
import pathlib

import numpy as np

import viscontact

data = pathlib.Path(__file__).parents[2] / "data"
fit = viscontact.Fit(data / "fits/lecture.json")
times = np.linspace(0.1, 4.0, 40)


def gaps(viscosity, mass):
    """The gap at the times of the measurement."""
    values = {"fluid.viscosity": viscosity, "sphere.mass": mass}
    motion = viscontact.simulate(data / "cases/lecture.toml", fit, models=["inertial"],
                                 values=values)["inertial"]
    return np.interp(times, motion.time, motion.gap)


# %% [markdown]
# ## The measurement
#
# It stands for one of a laboratory: the motion with a viscosity and a mass that we pretend not to
# know, and noise.

# %%
noise = 1e-3
measured = gaps(3.4, 24.0) + np.random.default_rng(7).normal(scale=noise, size=len(times))

# %% [markdown]
# ## The fit
#
# Each iteration linearises the gaps at the present parameters, with differences for the derivatives.
# Logarithms of the parameters keep both positive. After 20 iterations the fit is taken as it is.

# %%
logs = np.log([3.0, 20.0])  # a guess: the case's own values
for iteration in range(20):
    here = gaps(*np.exp(logs))
    step = 1e-4
    derivatives = np.column_stack([(gaps(*np.exp(logs + step * unit)) - here) / step
                                   for unit in np.eye(2)])
    change, *_ = np.linalg.lstsq(derivatives, measured - here, rcond=None)
    logs += change
    if np.abs(change).max() < 1e-6:
        break

# %% [markdown]
# The inverse of the matrix of the normal equations tells the standard errors.

# %%
errors = noise * np.sqrt(np.diag(np.linalg.inv(derivatives.T @ derivatives)))
for name, value, error in zip(["viscosity", "mass"], np.exp(logs), errors):
    print(f"{name}: {value:.3g} within {100 * error:.1g} %")
print(f"misfit of a measured gap: {np.sqrt(np.mean((measured - gaps(*np.exp(logs)))**2)):.1g}")
