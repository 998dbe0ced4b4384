#!/usr/bin/python3
"""Measures what the Python module costs: Fit.resistance on 10^6 gaps, a step of Particles beside
the same step in C++, and simulate() of the lecture's case.

    PYTHONPATH=build/release/python bench/python_module.py [ROUNDS]

needs a build with -D VISCONTACT_PYTHON=ON. Steps are those of the benchmark box2d with 1000 discs,
until t = 2.5 (the early fall, with the shortest steps) and until t = 10. The loop is in C++
(Particles.run), in Python (Particles.step), in Python with forces by NumPy, and in C++ again, which
shows the noise; in turn, ROUNDS times (default 60; of the long run a tenth). All times are CPU times,
because the machine may be shared.
"""

import pathlib
import statistics
import sys
import tempfile
import time

import numpy as np

import viscontact

SOURCE = pathlib.Path(__file__).parents[1]
COUNT = 1000


def milliseconds(function, times):
    """CPU times of calls [ms]: the least and the median."""
    taken = []
    for _ in range(times):
        start = time.process_time()
        function()
        taken.append(1e3 * (time.process_time() - start))
    return min(taken), statistics.median(taken)


def write_box(folder):
    """The case of tests/contact_dynamics/box2d/box2d_case.cpp, bit for bit."""
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


def loop_in_cpp(discs, until):
    discs.run(until)


def loop_in_python(discs, until):
    while discs.time < until * (1 - 1e-9):
        discs.step(until)


def loop_with_forces(discs, until):
    forces, positions = discs.forces, discs.positions
    while discs.time < until * (1 - 1e-9):
        np.multiply(positions, -1e-30, out=forces)
        discs.step(until)


LOOPS = {"in C++": loop_in_cpp, "in Python": loop_in_python, "with forces": loop_with_forces,
         "in C++ again": loop_in_cpp}


def compare_loops(box, until, rounds):
    taken = {name: [] for name in LOOPS}
    for _ in range(rounds):
        for name, loop in LOOPS.items():
            discs = viscontact.Particles(box)
            start = time.process_time()
            loop(discs, until)
            taken[name].append(1e3 * (time.process_time() - start) / discs.steps)
    for name, times in taken.items():
        ratio = statistics.median(t / cpp for t, cpp in zip(times, taken["in C++"]))
        print(f"step of {COUNT} discs until t = {until}, {name}: {min(times):.4f} ms CPU, median "
              f"{statistics.median(times):.4f}; over C++ {min(times) / min(taken['in C++']):.3f}, "
              f"median of the ratios {ratio:.3f}")


def main():
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 60
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
        compare_loops(box, 2.5, rounds)
        compare_loops(box, 10, max(rounds // 10, 1))


if __name__ == "__main__":
    main()
