#!/usr/bin/python3
"""Benchmark beside Siconos (python3-siconos of Debian 12): discs fall into a box, with Coulomb's friction.

  bench/siconos_box.py [COUNT] [UNTIL] [VISCONTACT]

Both compute the same steps: u = argmin of the energy norm with D + h G u >= 0 and Coulomb's law, D the gaps at the beginning of the step
(docs/physics.md, equations 5.2 and 5.6), no films (gamma_min = 0), h = 0.05, mu_s = 0.3. Siconos solves them by its block Gauss-Seidel
(SICONOS_FRICTION_2D_NSGS) on sparse blocks; its time is that of the solver alone, without the search for contacts and the assembly.
The time of Viscontact is that of the whole process, without its start. The residual is measured in the same way for both: the natural
map of gap and slip, in mean radii.
"""
import json
import math
import pathlib
import random
import resource
import subprocess
import sys
import tempfile
import time
import warnings

import numpy as np
import scipy.sparse as sp
import siconos.numerics as sn

warnings.filterwarnings("ignore")  # Siconos warns of each conversion of indices to 64 bits
H, FRICTION, TOLERANCE, ITERATIONS = 0.05, 0.3, 1e-6, 10000


def box(count):
    """Discs (x, y, radius, mass) on a lattice of spacing 2.1 with random displacements, and the width of the box."""
    random.seed(7)
    columns = math.ceil(math.sqrt(count))
    discs = []
    for k in range(count):
        radius = random.uniform(0.8, 1)
        place = [1.05 + 2.1 * i + random.uniform(-0.05, 0.05) for i in (k % columns, k // columns)]
        discs.append((*place, radius, radius**2))
    return np.array(discs), 2.1 * columns


class Box:
    """The discs and one step of the scheme."""

    def __init__(self, count):
        discs, self.width = box(count)
        self.x, self.r, self.m = discs[:, :2].copy(), discs[:, 2], discs[:, 3]
        self.inertia = self.m * self.r**2 / 2
        self.v, self.w = np.zeros_like(self.x), np.zeros(count)
        self.impulses = {}

    def contacts(self, reach):
        """Pairs (i, j, normal, gap) with gaps up to `reach`; i < 0: floor and walls."""
        apart = self.x[None] - self.x[:, None]
        distance = np.hypot(apart[..., 0], apart[..., 1])
        np.fill_diagonal(distance, np.inf)
        first, second = np.nonzero(np.triu(distance - self.r[:, None] - self.r[None] <= reach))
        found = [(i, j, apart[i, j] / distance[i, j], distance[i, j] - self.r[i] - self.r[j]) for i, j in zip(first, second)]
        for wall, (normal, offset) in enumerate([((0, 1), 0), ((1, 0), 0), ((-1, 0), self.width)]):
            gaps = self.x @ np.array(normal, float) + offset - self.r
            found += [(-1 - wall, j, np.array(normal, float), gaps[j]) for j in np.nonzero(gaps <= reach)[0]]
        return found

    def step(self, options, seconds):
        free = self.v + H * np.array([0, -1.0])
        contacts = self.contacts(2 * H * np.abs(free).max() + 1e-3)
        rows, columns, values, q = [], [], [], []
        for c, (i, j, n, gap) in enumerate(contacts):
            t = np.array([-n[1], n[0]])
            for row, direction, arm in ((2 * c, n, 0), (2 * c + 1, t, 1)):
                for body, sign in ((j, 1), (i, -1)):
                    if body < 0:
                        continue
                    rows += [row] * 3
                    columns += [3 * body, 3 * body + 1, 3 * body + 2]
                    # The surface of j is at -r n, that of i at +r n; both turn against the tangent of their own normal.
                    values += [sign * direction[0], sign * direction[1], -arm * self.r[body]]
            q += [gap, 0.0]
        count = len(self.m)
        u = np.column_stack([free, self.w]).ravel()
        if not contacts:
            r = np.zeros(0)
        else:
            g = sp.csr_matrix((values, (rows, columns)), shape=(2 * len(contacts), 3 * count))
            inverse = sp.diags(np.column_stack([1 / self.m, 1 / self.m, 1 / self.inertia]).ravel())
            w = (H * (g @ inverse @ g.T)).tocsc()
            q = np.array(q) + H * (g @ u)
            r = np.array([self.impulses.get((i, j), (0, 0)) for i, j, _, _ in contacts], float).ravel()
            iterations, residual = self.solve(w, q, r, options, seconds)
            u = u + inverse @ (g.T @ r)
            self.impulses = {(c[0], c[1]): r[2 * k:2 * k + 2] for k, c in enumerate(contacts)}
        u = u.reshape(-1, 3)
        self.v, self.w = u[:, :2], u[:, 2]
        self.x = self.x + H * self.v
        return (len(contacts), iterations, residual) if contacts else (0, 0, 0.0)

    def solve(self, w, q, r, options, seconds):
        _, blocks = sn.SBM_from_csparse(2, sp.coo_matrix(w))
        problem = sn.FrictionContactProblem(2, len(q) // 2, blocks, q, np.full(len(q) // 2, FRICTION))
        u = np.zeros_like(q)
        before = time.process_time()
        sn.fc2d_driver(problem, r, u, options)
        seconds.append(time.process_time() - before)
        u, diagonal = w @ r + q, w.diagonal()
        normal = np.abs(np.minimum(u[::2], diagonal[::2] * r[::2]))
        bound = FRICTION * np.maximum(r[::2], 0)
        slip = diagonal[1::2] * np.abs(r[1::2] - np.clip(r[1::2] - u[1::2] / diagonal[1::2], -bound, bound))
        return options.iparam[1], max(normal.max(), slip.max()) / self.r.mean()


def run_siconos(count, until):
    options = sn.SolverOptions(sn.SICONOS_FRICTION_2D_NSGS)
    options.iparam[0] = ITERATIONS
    options.dparam[sn.SICONOS_DPARAM_TOL] = TOLERANCE  # its error is relative to the norm of q
    state, seconds, residuals, iterations = Box(count), [], [], []
    steps = round(until / H)
    for _ in range(steps):
        _, taken, residual = state.step(options, seconds)
        residuals.append(residual)
        iterations.append(taken)
    third = steps // 3
    print("Siconos    " + "  ".join(
        f"{1e3 * sum(seconds[k * third:(k + 1) * third]) / third:9.2f} ms" for k in range(3))
        + f"   mean {1e3 * sum(seconds) / steps:.2f} ms a step; {np.mean(iterations):.0f} iterations; residual above {TOLERANCE:g} in "
        f"{sum(x > TOLERANCE for x in residuals)} of {steps} steps, largest {max(residuals):.1e}")


def run_viscontact(count, until, program):
    discs, width = box(count)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        lines = [f"{x:.17g},{y:.17g},0,0,{r:.17g},{m:.17g}" for x, y, r, m in discs]
        (folder / "box.csv").write_text("\n".join(["x,y,vx,vy,radius,mass", *lines]) + "\n")
        planes = "".join(f"[[plane]]\npoint = [{p}, 0.0]\nnormal = {n}\n"
                         for p, n in ((0.0, "[0.0, 1.0]"), (0.0, "[1.0, 0.0]"), (width, "[-1.0, 0.0]")))
        times, before = [], 0.0
        for part in range(4):
            end = max(H, until * part / 3)
            (folder / "box.toml").write_text(
                f'title = "Box"\n[space]\ndimension = 2\ngravity = [0.0, -1.0]\n[viscous_contact]\ntime_step = {H}\nend_time = {end}\n'
                f"gamma_min = 0.0\n[friction]\ncoefficient = {FRICTION}\n[solver]\ntolerance = {TOLERANCE}\nimpulse_tolerance = {TOLERANCE}\n"
                f'[output]\nevery = {until}\n[particles]\nfile = "box.csv"\n' + planes)
            usage = resource.getrusage(resource.RUSAGE_CHILDREN)
            subprocess.run([program, "particles", folder / "box.toml", "-o", folder / f"out{part}", "-j", "1"], capture_output=True)
            now = resource.getrusage(resource.RUSAGE_CHILDREN)
            times.append(now.ru_utime + now.ru_stime - usage.ru_utime - usage.ru_stime)
        record = json.loads((folder / "out3/run.json").read_text())
    steps = record["steps"]
    print("Viscontact " + "  ".join(f"{1e3 * (times[k + 1] - times[k]) / (steps / 3):9.2f} ms" for k in range(3))
          + f"   mean {1e3 * (times[3] - times[0]) / steps:.2f} ms a step; {record['iterations'] / steps:.0f} iterations; "
          f"{record['unconverged_steps']} of {steps} steps not converged, largest residual {record['largest_residual']:.1e}")


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 500
    until = float(sys.argv[2]) if len(sys.argv) > 2 else 9.0
    program = sys.argv[3] if len(sys.argv) > 3 else "build/release/viscontact"
    print(f"{count} discs, CPU time a step in each third of t < {until:g}:")
    run_viscontact(count, until, program)
    run_siconos(count, until)


if __name__ == "__main__":
    main()
