#!/usr/bin/python3
"""Compares SciPy's Radau with the model `inertial` on the lecture's case at equal accuracy.

usage: bench/radau.py FIT.json STATES.csv

bench_inertial writes STATES.csv: error and time of `inertial`, and exact gaps at 400 times.
For the variables (q, u) and (ln q, u/q), this script finds the largest tolerance at which SciPy's
largest relative error of the gap is at most that of `inertial`. It prints SciPy's computing time
(median of 7, with the output at 400 times) and the ratio of the two times.
Needs NumPy and SciPy (apt-get install python3-scipy).
"""

import json
import math
import statistics
import sys
import time

import numpy
from scipy.integrate import solve_ivp

MASS = 20.0
PIECES = [(0.0, 2.0, -200.0), (2.0, 4.0, 200.0)]
EXPONENTS = {"1/q": -1, "1": 0, "q": 1, "q^2": 2, "q^3": 3}


def read_resistance(path):
    """R(q) and q dR/dq as functions of floats. Arrays of length 1 or 2 would take SciPy's side more
    time than the sum itself."""
    with open(path) as file:
        fit = json.load(file)
    weights = [0.0] * 5
    for term in fit["terms"]:
        weights[EXPONENTS[term["name"]] + 1] = -term["coefficient"] / fit["reference_velocity"]
    a, b, c, d, e = weights
    return (
        lambda q: a / q + b + q * (c + q * (d + q * e)),
        lambda q: -a / q + q * (c + q * (2 * d + q * 3 * e)),
    )


def in_gap(resistance, log_slope):
    """Variables (q, u), gap and velocity: q' = u, u' = (f - R u)/m."""

    def system(force):
        def derivative(_, y):
            q, u = y.tolist()
            return [u, (force - resistance(q) * u) / MASS]

        def jacobian(_, y):
            q, u = y.tolist()
            return numpy.array([[0.0, 1.0], [-log_slope(q) / q * u / MASS, -resistance(q) / MASS]])

        return derivative, jacobian

    # With an absolute tolerance of 1e-3 times the relative one, a gap of 3e-3 has about as many
    # digits as a gap of 1.
    return system, [1.0, 0.0], lambda y: y[0], lambda tolerance: [1e-3 * tolerance, tolerance]


def in_logarithm(resistance, log_slope):
    """Variables s = ln q and w = u/q: s' = w, w' = f/(m q) - R w/m - w^2."""

    def system(force):
        def derivative(_, y):
            s, w = y.tolist()
            q = math.exp(s)
            return [w, force / (MASS * q) - resistance(q) / MASS * w - w * w]

        def jacobian(_, y):
            s, w = y.tolist()
            q = math.exp(s)
            return numpy.array(
                [
                    [0.0, 1.0],
                    [
                        -force / (MASS * q) - log_slope(q) * w / MASS,
                        -resistance(q) / MASS - 2 * w,
                    ],
                ]
            )

        return derivative, jacobian

    return system, [0.0, 0.0], lambda y: numpy.exp(y[0]), lambda tolerance: [tolerance, tolerance]


def gaps(variables, times, tolerance):
    """Gaps at `times`, and the number of evaluations. Radau starts again where the force jumps."""
    system, state, gap, absolute = variables
    found, steps = [], 0
    for begin, end, force in PIECES:
        derivative, jacobian = system(force)
        wanted = times[(times > begin) & (times <= end)]
        solution = solve_ivp(
            derivative,
            (begin, end),
            state,
            method="Radau",
            t_eval=wanted,
            rtol=max(tolerance, 3e-14),
            atol=absolute(tolerance),
            jac=jacobian,
        )
        if not solution.success:
            raise RuntimeError(solution.message)
        found.append(gap(solution.y))
        state = solution.y[:, -1]
        steps += solution.nfev
    return numpy.concatenate(found), steps


def main():
    fit, states = sys.argv[1:]
    comments = {}
    with open(states) as file:
        for line in file:
            if line.startswith("# "):
                key, value = line[2:].split(": ")
                comments[key] = float(value)
    exact = numpy.loadtxt(states, delimiter=",", comments="#", skiprows=len(comments) + 1)
    bar, ours = comments["gap_error"], comments["milliseconds"]
    print(f"simulate_inertial: error {bar:.2g}, {ours:.3g} ms")
    resistance = read_resistance(fit)
    for name, make in (("q, u", in_gap), ("ln q, u/q", in_logarithm)):
        variables = make(*resistance)
        # Tolerances differ by a factor of 10^(1/8): so does the error, and the time by about 3 %.
        for eighths in range(40, 110):
            tolerance = 10 ** (-eighths / 8)
            found, evaluations = gaps(variables, exact[:, 0], tolerance)
            error = numpy.max(numpy.abs(found / exact[:, 1] - 1))
            if error <= bar:
                break
        else:
            print(f"Radau in ({name}): never that good, {error:.2g} at tolerance {tolerance:.1g}")
            continue
        seconds = []
        for _ in range(7):
            start = time.perf_counter()
            gaps(variables, exact[:, 0], tolerance)
            seconds.append(time.perf_counter() - start)
        theirs = 1e3 * statistics.median(seconds)
        print(
            f"Radau in ({name}): error {error:.2g} at tolerance {tolerance:.1g}, {theirs:.0f} ms,"
            f" {evaluations} evaluations; {theirs / ours:.0f} times as long"
        )


if __name__ == "__main__":
    main()
