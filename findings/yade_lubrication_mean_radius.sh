#!/bin/sh
# Two spheres with a gap of 0.01 in a fluid of viscosity 1 approach each other with the velocity 0.001. For radii 1
# and 1 the normal force of `Law2_ScGeom_ImplicitLubricationPhys` is that of Reynolds' lubrication theory,
# 6 pi mu u (r1 r2/(r1 + r2))^2/gap = 0.4712, to 1e-4. For radii 1 and 5 it is 4.24 where the theory gives 1.309,
# because the law takes the mean of both radii for each: the force is the same as for radii 3 and 3. The
# manual calls the law one "between two spheres" and does not say that they must be equal. The error is the
# factor ((r1 + r2)^2/(4 r1 r2))^2, 1.15 for radii 1 and 1.7, and 9.2 for 1 and 10.
# Packages: yade 2023.02a-1 (Debian 12).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian yade 2023.02a-1
program yade

cat >"$folder/pairs.py" <<'END_OF_SCRIPT'
from yade import *


def force(radius1, radius2, gap=0.01, velocity=1e-3):
    O.reset()
    O.materials.append(FrictMat(young=1e9, poisson=0.3, frictionAngle=0, density=1000))
    O.bodies.append(sphere((0, 0, 0), radius1, fixed=True))
    O.bodies.append(sphere((0, 0, radius1 + radius2 + gap), radius2, fixed=True))
    O.bodies[0].state.vel = (0, 0, velocity)
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.5)]),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1.5)],
            [Ip2_FrictMat_FrictMat_LubricationPhys(eta=1, eps=1e-9)],
            [Law2_ScGeom_ImplicitLubricationPhys(activateTangencialLubrication=False,
                                                 activateTwistLubrication=False,
                                                 activateRollLubrication=False)]),
        NewtonIntegrator(damping=0)]
    O.dt = 1e-7
    for step in range(1000):  # the gap changes by 1e-7, the spring of the solids has come to rest
        O.step()
    pair = O.interactions[0, 1]
    print("radii %g and %g: force %.3f" % (radius1, radius2, abs(pair.phys.normalForce[2])))


for radii in (1, 1), (3, 3), (1, 5):
    force(*radii)
END_OF_SCRIPT
(cd "$folder" && yade -n -x pairs.py </dev/null 2>/dev/null | grep '^radii' >output) || true
verdict "radii 1 and 1: force 0.471
radii 3 and 3: force 4.241
radii 1 and 5: force 4.241"
