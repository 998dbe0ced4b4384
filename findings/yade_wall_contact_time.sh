#!/bin/sh
# A sphere meets another free sphere, or a body that does not move, all of one `ViscElMat` with the contact time
# tc = 0.01 and a coefficient of restitution en. With en = 1 the contact of two spheres takes 0.0100; with a wall, a
# facet or a fixed sphere it takes 0.0141, sqrt(2) times as long. A fixed sphere counts as a free one, and a body
# without mass as one of the mass of the sphere, so that the effective mass is half of what it is. A fixed `box`
# counts with the mass of its volume: the larger it is, the better the result. With en = 0.5 the spheres bounce with
# 0.550, right for a spring and a damper that part when their force is 0 (Schwager & Poeschel 2007); at the wall
# it is 0.646.
# Packages: yade 2023.02a-1 (Debian 12).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian yade 2023.02a-1
program yade

cat >"$folder/bounce.py" <<'END_OF_SCRIPT'
from yade import *


def bounce(name, target, restitution):
    O.reset()
    O.materials.append(ViscElMat(tc=0.01, en=restitution, et=1, density=1000, frictionAngle=0))
    O.bodies.append(target())
    O.bodies.append(sphere((0, 0, 1), 1))
    O.bodies[1].state.vel = (0, 0, -1)
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb(), Bo1_Facet_Aabb(), Bo1_Box_Aabb()]),
        InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom(),
                         Ig2_Box_Sphere_ScGeom()],
                        [Ip2_ViscElMat_ViscElMat_ViscElPhys()], [Law2_ScGeom_ViscElPhys_Basic()]),
        NewtonIntegrator(damping=0)]
    O.dt = 1e-6
    for step in range(20000):
        O.step()
        if O.forces.f(1)[2] > 0:
            end = O.time
    print("en = %g, %s: time of contact %.4f, restitution %.3f"
          % (restitution, name, end, O.bodies[1].state.vel[2] - O.bodies[0].state.vel[2]))


targets = {
    "sphere": lambda: sphere((0, 0, -1), 1),
    "fixed sphere": lambda: sphere((0, 0, -1), 1, fixed=True),
    "wall": lambda: wall(0, axis=2),
    "facet": lambda: facet([(-5, -5, 0), (5, -5, 0), (0, 8, 0)]),
    "box of 8": lambda: box((0, 0, -1), (1, 1, 1), fixed=True),
    "box of 200": lambda: box((0, 0, -1), (5, 5, 1), fixed=True)}
for restitution in 1, 0.5:
    for name in targets:
        bounce(name, targets[name], restitution)
END_OF_SCRIPT
(cd "$folder" && yade -n -x bounce.py </dev/null 2>/dev/null | grep '^en =' >output) || true
verdict "en = 1, sphere: time of contact 0.0100, restitution 1.000
en = 1, fixed sphere: time of contact 0.0141, restitution 1.000
en = 1, wall: time of contact 0.0141, restitution 1.000
en = 1, facet: time of contact 0.0141, restitution 1.000
en = 1, box of 8: time of contact 0.0123, restitution 1.000
en = 1, box of 200: time of contact 0.0101, restitution 1.000
en = 0.5, sphere: time of contact 0.0086, restitution 0.550
en = 0.5, fixed sphere: time of contact 0.0126, restitution 0.646
en = 0.5, wall: time of contact 0.0126, restitution 0.646
en = 0.5, facet: time of contact 0.0126, restitution 0.646
en = 0.5, box of 8: time of contact 0.0109, restitution 0.610
en = 0.5, box of 200: time of contact 0.0087, restitution 0.553"
