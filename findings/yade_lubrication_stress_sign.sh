#!/bin/sh
# Two spheres in a periodic cell push each other apart, because they overlap (the law of Cundall and Strack), or because
# the film between them is squeezed (`Law2_ScGeom_ImplicitLubricationPhys`); in two more cases the first slides past the
# second. The stress is minus force on the second times distance over the volume, because Yade counts tension as
# positive. `getStress()`, which is for all contact laws, gives this for solids, and the opposite for films: those
# that are squeezed seem to pull, and the viscosity of a suspension is negative. `getTotalStresses()` of the law is
# right; an example of the package, SimpleShear_lubrication.py, writes both as the total stress. The contacts of
# this law store the forces on the first sphere, those of other laws the forces on the second.
# Packages: yade 2023.02a-1 (Debian 12).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian yade 2023.02a-1
program yade

cat >"$folder/pairs.py" <<'END_OF_SCRIPT'
from yade import *

size = 10


def pair(text, distance, velocity, axis, physics, law):
    O.reset()
    O.periodic = True
    O.cell.setBox(size, size, size)
    O.materials.append(FrictMat(young=1e9, poisson=0.3, frictionAngle=0.5, density=1000))
    O.bodies.append(sphere((5, 5, 4), 1, fixed=True))
    O.bodies.append(sphere((5, 5, 4 + distance), 1, fixed=True))
    O.bodies[0].state.vel = velocity
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.5)]),
        InteractionLoop([Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1.5)], [physics], [law]),
        NewtonIntegrator(damping=0)]
    O.dt = 1e-7
    for step in range(1000):
        O.step()
    force = O.forces.f(1)[axis]
    exact = -force*distance/size**3
    result = "getStress() %.2f" % (getStress()[axis, 2]/exact)
    if hasattr(law, "getTotalStresses"):
        result += ", getTotalStresses() %.2f" % (sum(stress[axis, 2] for stress in law.getTotalStresses())/exact)
    print("%s, force %.4f along %s: %s" % (text, force, "xyz"[axis], result))


def solid():
    return Ip2_FrictMat_FrictMat_FrictPhys(), Law2_ScGeom_FrictPhys_CundallStrack()


def film():
    return Ip2_FrictMat_FrictMat_LubricationPhys(eta=1, eps=1e-9), Law2_ScGeom_ImplicitLubricationPhys()


pair("overlap", 1.999, (0, 0, 0), 2, *solid())
pair("overlap and friction", 1.999, (-1, 0, 0), 0, *solid())
pair("squeezed film", 2.01, (0, 0, 1e-3), 2, *film())
pair("sheared film", 2.01, (-1e-3, 0, 0), 0, *film())
END_OF_SCRIPT
(cd "$folder" && yade -n -x pairs.py </dev/null 2>/dev/null | grep 'getStress' >output) || true
verdict "overlap, force 1000000.0000 along z: getStress() 1.00
overlap and friction, force -29965.0326 along x: getStress() 1.00
squeezed film, force 0.4712 along z: getStress() -1.00, getTotalStresses() 1.00
sheared film, force -0.0135 along x: getStress() -1.00, getTotalStresses() 1.00"
