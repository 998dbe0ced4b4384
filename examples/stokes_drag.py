#!/usr/bin/env python3
"""A fluid solver of one's own: each particle feels its Stokes drag, and no other particle or wall.

Viscontact asks it instead of FreeFEM with

    [fluid]
    solver = ["python3", "examples/stokes_drag.py"]

by the protocol of docs/fluid-solver.md: requests come on standard input and answers go to standard
output, as words separated by white space. Messages may go to standard error.

The drag of a sphere of radius r that moves with U in a fluid at rest (Stokes 1851) is
F = -6 pi mu r U. A disc in an unbounded plane has no such law (Stokes' paradox). Discs therefore
feel, per unit length, F = -4 pi mu U and the torque T = -4 pi mu r^2 w. The torque is exact for a
disc alone; the force is a stand-in of the right dimension. U and w are relative to the motion that
the fluid would have without particles: that of the walls if all of them have the same affine
velocity, else none. A free particle with force f and inertia I (mass over time step) has

    (I + R) U = f + R U_fluid,    R = 6 pi mu r for a sphere.
"""

import math
import sys


def words():
    """All words of standard input, one by one. Reads no further than the line that it needs."""
    for line in sys.stdin:
        yield from line.split()


class StokesDrag:
    def __init__(self, word):
        self.word = word
        self.read_opening()

    def number(self):
        return float(next(self.word))

    def numbers(self, count):
        return [self.number() for _ in range(count)]

    def expect(self, name):
        found = next(self.word)
        if found != name:
            raise ValueError(f"'{found}' came in place of '{name}'")

    def read_opening(self):
        self.expect("viscontact-fluid")
        self.expect("2")
        self.expect("dimension")
        self.dimension = int(next(self.word))
        self.expect("viscosity")
        self.viscosity = self.number()
        # How FreeFEM solves the problem does not matter here.
        for name, count in ("constraint", 2), ("mesh", 1), ("edges", 1), ("domain", 0):
            self.expect(name)
            for _ in range(count):
                next(self.word)
        for _ in range({"disc": 3, "box": 6, "cylinder": 2}[next(self.word)]):
            next(self.word)
        self.expect("walls")
        walls = []
        for _ in range(int(next(self.word))):
            next(self.word)  # label
            kind = next(self.word)
            walls.append((kind, self.numbers(8)))
        self.expect("gradient")
        g = self.numbers(4)
        self.expect("particles")
        self.radii = self.numbers(int(next(self.word)))
        # Coefficients of the fluid's velocity (a0 + ax x + ay y, b0 + bx x + by y).
        self.affine = [0, g[0], g[1], 0, g[2], g[3]]
        if walls:
            same = all(wall == walls[0] for wall in walls)
            kind, coefficients = walls[0]
            is_affine = kind == "moving" and coefficients[6:] == [0, 0]
            self.affine = coefficients[:6] if same and is_affine else [0] * 6
        self.components = 1 if self.dimension == 1 else 3

    def fluid_motion(self, place):
        """Velocity and angular velocity of the fluid without particles, where a particle is."""
        a0, ax, ay, b0, bx, by = self.affine
        if self.dimension == 1:
            return [b0 + by * place[0]]
        x, y = place[:2]
        return [a0 + ax * x + ay * y, b0 + bx * x + by * y, (bx - ay) / 2]

    def resistance(self, radius):
        if self.dimension == 1:
            return [6 * math.pi * self.viscosity * radius]
        along = 4 * math.pi * self.viscosity
        return [along, along, along * radius**2]

    def place(self):
        n, m = len(self.radii), self.components
        self.places = [self.numbers(m) for _ in range(n)]
        self.expect("driven")
        self.driven = {}
        for _ in range(int(next(self.word))):
            k = int(next(self.word))
            self.driven[k] = self.numbers(m)
        self.expect("inertia")
        self.inertia = self.numbers(int(next(self.word))) or [0] * (n * m)
        return ["placed", 0]

    def velocities(self, driving, forces):
        m = self.components
        v = []
        for k, (radius, place) in enumerate(zip(self.radii, self.places)):
            if k in self.driven:
                v += self.driven[k] if driving else [0] * m
                continue
            fluid = self.fluid_motion(place) if driving else [0] * m
            for i, resistance in enumerate(self.resistance(radius)):
                force = forces[k * m + i] + resistance * fluid[i]
                v.append(force / (resistance + self.inertia[k * m + i]))
        return v

    def solve(self):
        driving = next(self.word) == "1"
        v = self.velocities(driving, self.numbers(len(self.radii) * self.components))
        if driving:
            self.last = v
        return ["velocities", *v]

    def vary(self):
        # There is no mesh and no penalty, and so no error of either.
        return ["varied", 0] if next(self.word) == "penalty" else ["varied", 0, 0, 0]

    def quantities(self):
        """The drag of each particle, and the power that the particles give to the fluid by it."""
        m = self.components
        drag, dissipation = [], 0
        for k, (radius, place) in enumerate(zip(self.radii, self.places)):
            fluid = self.fluid_motion(place)
            for i, resistance in enumerate(self.resistance(radius)):
                relative = self.last[k * m + i] - fluid[i]
                drag.append(-resistance * relative)
                dissipation += resistance * relative**2
        # The dissipation of the fluid without particles is not known here.
        return ["quantities", dissipation, 0, *drag]

    def flow(self):
        return ["flow", 0, 0]

    def run(self):
        print("ready places", flush=True)
        requests = {name: getattr(self, name)
                    for name in ("place", "solve", "quantities", "vary", "flow")}
        for request in self.word:
            if request == "end":
                return
            # Python writes a number with as many digits as it needs to be read back.
            print(*requests[request](), flush=True)


if __name__ == "__main__":
    try:
        StokesDrag(words()).run()
    except StopIteration:
        sys.exit("the input ended within a request")
    except (KeyError, ValueError) as problem:
        print(f"error the request is wrong: {problem}", flush=True)
        sys.exit(1)
