#!/usr/bin/env python3
"""Writes the CSV files of the cases in this folder, beside itself; run again, the same bytes.

Lengths, velocities and masses are in the units of the cases. Nothing is checked here: `viscontact
particles` refuses particles that overlap. An existing file is replaced; one that cannot be written
ends the script with an error. scripts/angle_of_repose uses heap_discs(). A change of a number
changes the results of a case, and so the pictures of docs/ and some tests.
"""
import math
import pathlib
import random

HERE = pathlib.Path(__file__).resolve().parent


def write(name, dimension, rows):
    """Writes rows of centre and velocity, each of `dimension` numbers, radius > 0 and mass > 0."""
    axes = "xyz"[:dimension]
    header = ",".join([*axes, *("v" + axis for axis in axes), "radius", "mass"])
    lines = [",".join(f"{value:.6g}" for value in row) for row in rows]
    (HERE / name).write_text("\n".join([f"# rows: {len(rows)}", header, *lines]) + "\n")


def triangle(apex, rows, spacing):
    """Centres of a rack of balls that opens to the right."""
    for row in range(rows):
        for k in range(row + 1):
            yield (apex[0] + row * spacing * math.sqrt(3) / 2, apex[1] + (k - row / 2) * spacing)


def billiard_break():
    """Fifteen balls racked with gaps of a hundredth of a radius, and the cue ball, a little off the middle line."""
    balls = [(x, y, 0, 0, 1, 1) for x, y in triangle((40, 20), 5, 2.01)]
    write("billiard_break.csv", 2, [(15, 20.3, 12, 0, 1, 1), *balls])


def billiards():
    """Balls at random places of a table, one of them shot."""
    random.seed(2)
    balls = [(6, 20, 14 * math.cos(math.radians(3)), 14 * math.sin(math.radians(3)), 1, 1)]
    while len(balls) < 40:
        x, y = random.uniform(12, 78), random.uniform(2, 38)
        if all(math.hypot(x - b[0], y - b[1]) > 2.8 for b in balls):
            balls.append((x, y, 0, 0, 1, 1))
    write("billiards.csv", 2, balls)


def lottery():
    """Spheres on a lattice within a cube of side 12 about the origin."""
    random.seed(3)
    rows = []
    for k in range(64):
        centre = [2.4 * (k // 4**axis % 4 - 1.5) + random.uniform(-0.1, 0.1) for axis in range(3)]
        radius = random.uniform(0.7, 1.0)
        rows.append((*centre, 0, 0, 0, radius, radius**3))
    write("lottery.csv", 3, rows)


def force_network():
    """Discs of radii 0.6 to 1 on a lattice in a box."""
    random.seed(4)
    rows = []
    for k in range(400):
        radius = random.uniform(0.6, 1.0)
        rows.append((1.1 + 2.25 * (k % 16), 1.1 + 2.3 * (k // 16), random.uniform(-0.3, 0.3), 0, radius, radius**2))
    write("force_network.csv", 2, rows)


def shaken_discs():
    """Discs of radii 0.7 to 1 on a lattice over the floor."""
    random.seed(5)
    rows = []
    for k in range(500):
        radius = random.uniform(0.7, 1.0)
        rows.append((1.05 + 2.1 * (k % 24), 1.05 + 2.1 * (k // 24), random.uniform(-0.5, 0.5), 0, radius, radius**2))
    write("shaken_discs.csv", 2, rows)


def settling():
    """Discs of radii 0.3 to 1 on a lattice over the floor."""
    random.seed(4)
    rows = []
    for k in range(300):
        radius = 0.3 * (1 / 0.3) ** random.random()
        x = 1.05 + 2.1 * (k % 15) + random.uniform(-0.05, 0.05)
        rows.append((x, 1.05 + 2.1 * (k // 15), 0, 0, radius, radius**2))
    write("settling.csv", 2, rows)


def raft():
    """Five rows of eight discs, square, with gaps of 0.05: columns are pushed together and pulled apart."""
    rows = []
    for row in range(5):
        for column in range(8):
            rows.append((2.05 * column, 2.05 * row, 0, 0, 1, 1))
    write("raft.csv", 2, rows)


def heap_discs(seed):
    """A row of HEAP_FLOOR discs of radius 0.5 that make the floor, and 300 discs of radii 0.4 to 0.6 in a steep triangle above it."""
    random.seed(seed)
    rows = [(k - HEAP_FLOOR / 2 + 0.5, 0, 0, 0, 0.5, 1) for k in range(HEAP_FLOOR)]
    for row in range(24):
        for k in range(24 - row):
            radius = 0.4 * (0.6 / 0.4) ** random.random()
            x = 1.22 * (k - (23 - row) / 2) + random.uniform(-0.005, 0.005)
            rows.append((x, 1.12 + 1.236 * row, 0, 0, radius, math.pi * radius**2))
    return rows


HEAP_FLOOR = 100


def heap():
    write("heap.csv", 2, heap_discs(1))


if __name__ == "__main__":
    for make in (billiard_break, billiards, force_network, heap, lottery, settling, shaken_discs, raft):
        make()
