# %% [markdown]
# # The lecture's case
#
# A sphere is pushed towards a plane until t = 2 and then pulled back. The drag near the plane is
# the shipped fit to a table of FreeFEM. The model `inertial` resolves the film; `viscous_contact`
# does not, but recovers its thickness from gamma, which is minus the impulse that the film absorbed.
#
# Jupyter opens this file by Jupytext, and editors by their mode for cells. As a program, type in
# the source folder of Viscontact `python3 examples/python/lecture.py`.
#
# Numbers are in the units of the case. An error, such as a missing file or a motion that cannot be
# computed, ends the program with an exception of `viscontact`. A test compares the output with the
# lines that follow.
#
# It prints:
#
# R(q = 0.01) = 5761.06
# inertial: smallest gap 0.00296729 at t = 2.00072
# viscous_contact: smallest gap 0, film from gamma 0.000873904
# viscous_contact_regular_drag: smallest gap 0, film from gamma 0.00297238
# mass 10: smallest gap 0.00296352
# mass 20: smallest gap 0.00296729
# mass 40: smallest gap 0.00297492

# %%
import pathlib

import viscontact

data = pathlib.Path(__file__).parents[2] / "data"
fit = viscontact.Fit(data / "fits/lecture.json")
print(f"R(q = 0.01) = {fit.resistance(0.01):.6g}")

# %% [markdown]
# ## The models

# %%
case = data / "cases/lecture.toml"
motion = viscontact.simulate(case, fit)
for name in "inertial", "viscous_contact", "viscous_contact_regular_drag":
    trajectory = motion[name]
    k = trajectory.gap.argmin()
    film = trajectory.about["film_from_gamma"]
    print(f"{name}: smallest gap {trajectory.gap[k]:.6g}",
          f"at t = {trajectory.time[k]:.6g}" if film is None else f"film from gamma {film:.6g}",
          sep=" " if film is None else ", ")

# %% [markdown]
# ## A parameter of one's own choice
#
# `values` replaces numbers of the case, so that a loop, or an optimiser, varies them.

# %%
for mass in 10.0, 20.0, 40.0:
    heavy = viscontact.simulate(case, fit, models=["inertial"], values={"sphere.mass": mass})
    print(f"mass {mass:g}: smallest gap {heavy['inertial'].gap.min():.6g}")

# %% [markdown]
# ## A picture

# %%
try:
    import matplotlib.pyplot as pyplot
except ImportError:
    pass  # Debian: apt-get install python3-matplotlib
else:
    for name in "inertial", "viscous_contact":
        pyplot.plot(motion[name].time, motion[name].gap, label=name)
    pyplot.xlabel("time")
    pyplot.ylabel("gap")
    pyplot.legend()
    pyplot.show()
