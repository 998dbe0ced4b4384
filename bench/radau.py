#!/usr/bin/python3
"""SciPy's Radau on the lecture's case with inertia, at the accuracy that `inertial` reaches.

usage: bench/radau.py FIT.json STATES.csv

STATES.csv is what bench_inertial writes: its error and time, and exact gaps at 400 times. Prints for the variables (q, u) and (ln q, u/q) the loosest tolerance
at which SciPy's largest relative error of the gap at those times is not above that, its time (median of 7, the 400 states included), and the ratio of both.
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
    """R and q dR/dq, of floats; arrays of length 1 or 2 would cost SciPy's side more than the sum."""
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
    """(q, u), the sphere's own: q' = u, u' = (f - R u)/m."""

    def system(force):
        def derivative(_, y):
            q, u = y.tolist()
            return [u, (force - resistance(q) * u) / MASS]

        def jacobian(_, y):
            q, u = y.tolist()
            return numpy.array([[0.0, 1.0], [-log_slope(q) / q * u / MASS, -resistance(q) / MASS]])

        return derivative, jacobian

    # A gap of 3e-3 is to have as many digits as one of 1.
    return system, [1.0, 0.0], lambda y: y[0], lambda tolerance: [1e-3 * tolerance, tolerance]


def in_logarithm(resistance, log_slope):
    """s = ln q and w = u/q: s' = w, w' = f/(m q) - R w/m - w^2."""

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
    """At `times`, and the steps taken. A fresh start where the force jumps."""
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
        # 10^(1/8) apart: the error falls by that, and the time grows by a thirtieth.
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
