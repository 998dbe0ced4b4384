#!/usr/bin/python3
"""Measures what the Python module costs: Fit.resistance on 10^6 gaps, a step of Particles beside
the same step in C++, and simulate() of the lecture's case.

    PYTHONPATH=build/release/python bench/python_module.py [ROUNDS]

needs a build with -D VISCONTACT_PYTHON=ON and build/bench/box2d. Steps are those of the benchmark
box2d with 1000 discs until t = 2.5: Python and C++ run them in turn, ROUNDS times (default 9). All
times are CPU times, because the machine may be shared.
"""

import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import viscontact

SOURCE = pathlib.Path(__file__).parents[1]
COUNT, UNTIL = 1000, 2.5


def milliseconds(function, times):
    """CPU times of calls [ms]: the least and the median."""
    taken = []
    for _ in range(times):
        start = time.process_time()
        function()
        taken.append(1e3 * (time.process_time() - start))
    return min(taken), statistics.median(taken)


def write_box(folder):
    """The case of tests/particles/box2d/box2d_case.cpp, bit for bit."""
    state = 12345

    def uniform():
        nonlocal state
        state = (6364136223846793005 * state + 1442695040888963407) % 2**64
        return (state >> 11) * 2.0**-53

    side = int(np.ceil(np.sqrt(COUNT)))
    lines = ["x,y,radius,mass"]
    for k in range(COUNT):
        radius = 0.8 + 0.2 * uniform()
        x, y = 0.1 * (uniform() - 0.5), 0.1 * (uniform() - 0.5)
        lines.append(f"{1.05 + 2.1 * (k % side) + x!r},{1.05 + 2.1 * (k // side) + y!r},"
                     f"{radius!r},{radius * radius!r}")
    (folder / "discs.csv").write_text("\n".join(lines) + "\n")
    planes = [("0.0, 0.0", "0.0, 1.0"), ("0.0, 0.0", "1.0, 0.0"),
              (f"{2.1 * side!r}, 0.0", "-1.0, 0.0")]
    case = folder / "box.toml"
    case.write_text("title = \"box2d\"\n[space]\ndimension = 2\ngravity = [0.0, -1.0]\n"
                    "[viscous_contact]\ntime_step = 0.05\nend_time = 10.0\ngamma_min = -2.0\n"
                    "[solver]\ntolerance = 1e-6\nimpulse_tolerance = 1e-10\n"
                    "[particles]\nfile = \"discs.csv\"\n"
                    + "".join(f"[[plane]]\npoint = [{p}]\nnormal = [{n}]\n" for p, n in planes))
    return case


def step_in_cpp():
    """CPU time of a step [ms]."""
    printed = subprocess.run([SOURCE / "build/bench/box2d", "--count", str(COUNT), "--until",
                              str(UNTIL)], check=True, capture_output=True, text=True).stdout
    return float(printed.split(" ms CPU a step")[0].split()[-1])


def step_in_python(case, with_forces):
    discs = viscontact.Particles(case)
    forces, positions = discs.forces if with_forces else None, discs.positions
    spent, steps = 0, 0
    while discs.time < UNTIL * (1 - 1e-9):
        start = time.process_time()
        if with_forces:
            np.multiply(positions, -1e-30, out=forces)
        discs.step(UNTIL)
        spent += time.process_time() - start
        steps += 1
    return 1e3 * spent / steps


def main():
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 9
    for basis in "lecture", "asymptotic_extended":
        fit = viscontact.fit(SOURCE / "data/tables/lecture.csv", basis)
        gaps = np.geomspace(*fit.interval, 10**6)
        gaps[0], gaps[-1] = fit.interval
        print("Fit.resistance, 10^6 gaps, {}: {:.1f} ms CPU, median {:.1f}".format(
            basis, *milliseconds(lambda: fit.resistance(gaps), 20)))
    fit = viscontact.Fit(SOURCE / "data/fits/lecture.json")
    case = SOURCE / "data/cases/lecture.toml"
    for what, models in (("all six models", []), ("inertial", ["inertial"]),
                         ("viscous_contact", ["viscous_contact"])):
        print("simulate, lecture's case, {}: {:.2f} ms CPU, median {:.2f}".format(
            what, *milliseconds(lambda: viscontact.simulate(case, fit, models=models), 30)))
    with tempfile.TemporaryDirectory() as folder:
        box = write_box(pathlib.Path(folder))
        cpp, python, forced = [], [], []
        for _ in range(rounds):
            cpp.append(step_in_cpp())
            python.append(step_in_python(box, False))
            forced.append(step_in_python(box, True))
    ratios = [b / a for a, b in zip(cpp, python)]
    print(f"step, {COUNT} discs: C++ {min(cpp):.4f} ms CPU, median {statistics.median(cpp):.4f}; "
          f"Python {min(python):.4f}, median {statistics.median(python):.4f}; ratio of the least "
          f"{min(python) / min(cpp):.3f}, median of ratios {statistics.median(ratios):.3f}")
    print(f"the same with a force of NumPy in each step: {min(forced):.4f} ms CPU, median "
          f"{statistics.median(forced):.4f}")


if __name__ == "__main__":
    main()
