#!/usr/bin/python3
"""Benchmark beside Siconos (python3-siconos of Debian 12): discs or spheres fall into a box, with friction.

  bench/siconos_box.py [COUNT] [UNTIL] [VISCONTACT] [DIMENSION]

Both compute the same steps, without films (gamma_min = 0), with h = 0.05 and mu_s = 0.3:
- Coulomb's law, (5.2) and (5.6) of docs/physics.md. Siconos solves it by its block Gauss-Seidel method (NSGS).
- the convex relaxation, (5.9). Siconos solves it by its interior-point method (IPM), which knows contacts in space only; discs have a second
  tangent along which nothing moves.
The times of Siconos are those of its solvers alone, without the search for contacts and the assembly. The time of Viscontact is that of the whole
process, without its start. Residuals are in mean radii: those of Siconos are the natural map of each contact, those of Viscontact are the
largest_residual of run.json, which is the same map but for the scale of the impulses.
"""
import json
import math
import multiprocessing
import os
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


def box(count, dimension):
    """Places, radii and masses on a lattice of spacing 2.1 with random displacements, and the width of the box."""
    random.seed(7)
    columns = math.ceil(count ** (1 / dimension) - 1e-9)
    places, radii = [], []
    for k in range(count):
        radii.append(random.uniform(0.8, 1))
        places.append([1.05 + 2.1 * (k // columns**d % columns) + random.uniform(-0.05, 0.05) for d in range(dimension)])
    return np.array(places), np.array(radii), np.array(radii) ** dimension, 2.1 * columns


def walls(dimension, width):
    """Normals and offsets of the floor and of the walls: normal.x + offset is the distance."""
    up = dimension - 1
    yield np.eye(dimension)[up], 0.0
    for d in range(up):
        yield np.eye(dimension)[d], 0.0
        yield -np.eye(dimension)[d], width


class Box:
    """The particles, and one step of the scheme with a solver of Siconos."""

    def __init__(self, count, dimension, is_convex):
        self.x, self.r, self.m, self.width = box(count, dimension)
        self.d, self.is_convex = dimension, is_convex
        turns = 1 if dimension == 2 else 3
        self.masses = np.column_stack([self.m] * dimension + [self.m * self.r**2 * (0.5 if dimension == 2 else 0.4)] * turns)
        self.v = np.zeros_like(self.masses)
        self.impulses, self.seconds, self.residuals, self.iterations = {}, [], [], []

    def contacts(self, reach):
        """Pairs (i, j, normal, gap) with gaps up to `reach`; i < 0: floor and walls."""
        apart = self.x[None] - self.x[:, None]
        distance = np.linalg.norm(apart, axis=2)
        np.fill_diagonal(distance, np.inf)
        first, second = np.nonzero(np.triu(distance - self.r[:, None] - self.r[None] <= reach))
        found = [(i, j, apart[i, j] / distance[i, j], distance[i, j] - self.r[i] - self.r[j]) for i, j in zip(first, second)]
        for wall, (normal, offset) in enumerate(walls(self.d, self.width)):
            gaps = self.x @ normal + offset - self.r
            found += [(-1 - wall, j, normal, gaps[j]) for j in np.nonzero(gaps <= reach)[0]]
        return found

    def tangents(self, n):
        if self.d == 2:
            return [np.array([-n[1], n[0]])]
        t = np.cross(n, np.eye(3)[np.argmin(np.abs(n))])
        t /= np.linalg.norm(t)
        return [t, np.cross(n, t)]

    def rows(self, contacts):
        """The velocities of gaps and slips as a matrix times those of the particles, a block of D rows for each contact."""
        rows, columns, values = [], [], []
        size = self.masses.shape[1]
        for c, (i, j, n, _) in enumerate(contacts):
            for k, direction in enumerate([n, *self.tangents(n)]):
                # The surface of j is at -r n from its centre, that of i at +r n.
                turn = np.atleast_1d(n[0] * direction[1] - n[1] * direction[0] if self.d == 2 else np.cross(n, direction)) * (k > 0)
                for body, sign in ((j, 1), (i, -1)):
                    if body >= 0:
                        rows += [self.d * c + k] * size
                        columns += range(size * body, size * (body + 1))
                        values += [*(sign * direction), *(-self.r[body] * turn)]
        return sp.csr_matrix((values, (rows, columns)), shape=(self.d * len(contacts), self.masses.size))

    def step(self, options):
        free = self.v.copy()
        free[:, self.d - 1] -= H
        contacts = self.contacts(2 * H * np.abs(free[:, :self.d]).max() + 1e-3)
        u = free.ravel()
        if contacts:
            g = self.rows(contacts)
            q = np.zeros(len(contacts) * self.d)
            q[::self.d] = [gap for *_, gap in contacts]
            w = (H * (g @ sp.diags(1 / self.masses.ravel()) @ g.T)).tocsc()
            before = np.array([self.impulses.get(c[:2], np.zeros(self.d)) for c in contacts]).ravel()
            r = (self.interior_points if self.is_convex else self.gauss_seidel)(g, w, q, u, before, options)
            u = u + (g.T @ r) / self.masses.ravel()
            self.impulses = {c[:2]: r[self.d * k:self.d * (k + 1)] for k, c in enumerate(contacts)}
            self.residuals.append(self.residual(q + H * (g @ u), r, w.diagonal()))
        else:
            self.seconds.append(0.0)
        self.v = u.reshape(self.v.shape)
        self.x = self.x + H * self.v[:, :self.d]

    def gauss_seidel(self, g, w, q, free, r, options):
        _, blocks = sn.SBM_from_csparse(self.d, sp.coo_matrix(w))
        q = q + H * (g @ free)
        problem = sn.FrictionContactProblem(self.d, len(q) // self.d, blocks, q, np.full(len(q) // self.d, FRICTION))
        u, begin = np.zeros_like(q), time.process_time()
        (sn.fc2d_driver if self.d == 2 else sn.fc3d_driver)(problem, r, u, options)
        self.seconds.append(time.process_time() - begin)
        self.iterations.append(options.iparam[1])
        return r

    def interior_points(self, g, w, q, free, _, options):
        count, d = len(q) // self.d, self.d
        place = np.arange(3 * count).reshape(-1, 3)[:, :d].ravel()  # of the rows among those of contacts in space
        spread = sp.csr_matrix((np.ones(len(q)), (place, np.arange(len(q)))), shape=(3 * count, len(q)))
        problem = sn.GlobalFrictionContactProblem()
        problem.dimension, problem.numberOfContacts = 3, count
        problem.M, problem.H = sp.diags(self.masses.ravel()).tocsc(), (spread @ g).T.tocsc()
        problem.q, problem.b, problem.mu = self.masses.ravel() * free, spread @ q / H, np.full(count, FRICTION)
        r, u, v = np.zeros(3 * count), np.zeros(3 * count), free.copy()
        begin = time.process_time()
        sn.gfc3d_driver(problem, r, u, v, options)
        self.seconds.append(time.process_time() - begin)
        self.iterations.append(options.iparam[1])
        return r[place]

    def residual(self, values, r, w):
        values, r, w = (a.reshape(-1, self.d) for a in (values, r, w))
        q = r - values / w[:, :1]
        normal, slip = q[:, 0], np.linalg.norm(q[:, 1:], axis=1)
        if self.is_convex:  # the projection on the cone
            along = np.clip((normal + FRICTION * slip) / (1 + FRICTION**2), 0, None)
            load = np.where(slip <= FRICTION * normal, normal, along)
            bound = FRICTION * load
        else:
            load, bound = np.maximum(normal, 0), FRICTION * np.maximum(r[:, 0], 0)
        factor = np.minimum(1, bound / np.maximum(slip, 1e-300))
        projected = np.column_stack([load, q[:, 1:] * factor[:, None]])
        return (w[:, 0] * np.linalg.norm(r - projected, axis=1)).max() / self.r.mean()


def report(name, parts, mean, iterations, failed, steps, residual):
    print(f"{name:22}" + "  ".join(f"{1e3 * t:8.2f} ms" for t in parts) + f"   mean {1e3 * mean:8.2f} ms; {iterations:5.0f} iterations; "
          f"not converged {failed} of {steps} steps, largest residual {residual:.1e}", flush=True)


def run_siconos(count, until, dimension, is_convex, done):
    # The solvers print each iteration, which would cost time in a terminal.
    sys.stdout = os.fdopen(os.dup(1), "w")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    if is_convex:
        options = sn.SolverOptions(sn.SICONOS_GLOBAL_FRICTION_3D_IPM)
    else:
        options = sn.SolverOptions(sn.SICONOS_FRICTION_2D_NSGS if dimension == 2 else sn.SICONOS_FRICTION_3D_NSGS)
        options.iparam[0] = ITERATIONS
    options.dparam[sn.SICONOS_DPARAM_TOL] = TOLERANCE  # the error of NSGS is relative to the norm of q
    state = Box(count, dimension, is_convex)
    steps = round(until / H)
    for done.value in range(steps):
        state.step(options)
    third = steps // 3
    report("Siconos " + ("IPM" if is_convex else "NSGS"), [sum(state.seconds[k * third:(k + 1) * third]) / third for k in range(3)],
           sum(state.seconds) / steps, np.mean(state.iterations), sum(x > TOLERANCE for x in state.residuals), steps, max(state.residuals))


def run_viscontact(count, until, program, dimension, is_convex):
    x, r, m, width = box(count, dimension)
    names = "xyz"[:dimension]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        np.savetxt(folder / "box.csv", np.column_stack([x, r, m]), fmt="%.17g", delimiter=",", comments="", header=",".join([*names, "radius", "mass"]))
        planes = "".join(f"[[plane]]\npoint = {list(-offset * n)}\nnormal = {list(n)}\n" for n, offset in walls(dimension, width))
        times = []
        for part in range(4):
            end = max(H, until * part / 3)
            (folder / "box.toml").write_text(
                f'title = "Box"\n[space]\ndimension = {dimension}\ngravity = {[0.0] * (dimension - 1) + [-1.0]}\n'
                f"[viscous_contact]\ntime_step = {H}\nend_time = {end}\ngamma_min = 0.0\n"
                f'[friction]\ncoefficient = {FRICTION}\nmethod = "{"convex" if is_convex else "coulomb"}"\n'
                f"[solver]\ntolerance = {TOLERANCE / 10}\nimpulse_tolerance = {TOLERANCE / 10}\n"
                f'[output]\nevery = {until}\n[particles]\nfile = "box.csv"\n' + planes)
            usage = resource.getrusage(resource.RUSAGE_CHILDREN)
            done = subprocess.run([program, "particles", folder / "box.toml", "-o", folder / f"out{part}", "-j", "1"], capture_output=True, text=True)
            if done.returncode not in (0, 4):  # 4: some steps did not converge
                sys.exit(done.stderr)
            now = resource.getrusage(resource.RUSAGE_CHILDREN)
            times.append(now.ru_utime + now.ru_stime - usage.ru_utime - usage.ru_stime)
        record = json.loads((folder / "out3/run.json").read_text())
    steps = record["steps"]
    report("Viscontact " + ("convex" if is_convex else "Coulomb"), [(times[k + 1] - times[k]) / (steps / 3) for k in range(3)],
           (times[3] - times[0]) / steps, record["iterations"] / steps, record["unconverged_steps"], steps, record["largest_residual"])


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 500
    until = float(sys.argv[2]) if len(sys.argv) > 2 else 9.0
    if until < 3 * H:
        sys.exit(f"UNTIL is {until}; it must be at least {3 * H}")
    program = sys.argv[3] if len(sys.argv) > 3 else "build/release/viscontact"
    dimension = int(sys.argv[4]) if len(sys.argv) > 4 else 2
    print(f"{count} particles in {dimension} dimensions, CPU time a step in each third of t < {until:g}:")
    for is_convex in (False, True):
        run_viscontact(count, until, program, dimension, is_convex)
        # An assertion of Siconos ends its process.
        done = multiprocessing.Value("i", 0)
        siconos = multiprocessing.Process(target=run_siconos, args=(count, until, dimension, is_convex, done))
        siconos.start()
        siconos.join()
        if siconos.exitcode != 0:
            how = f"by signal {-siconos.exitcode}" if siconos.exitcode < 0 else f"with the exit code {siconos.exitcode}"
            print(f"Siconos ended in step {done.value + 1} of {round(until / H)} {how}", flush=True)


if __name__ == "__main__":
    main()
