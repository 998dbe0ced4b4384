#!/bin/sh
# A ball of radius 1 rolls without slip along x on a flat floor, with the velocity 1; the coefficient of friction is
# 0.3, and nothing resists rolling, so that the motion goes on as it is. Siconos, which finds contacts with Bullet,
# turns it by 44 to 52 degrees within the time 1 if the floor is a `SiconosPlane`, with any time step, and also if
# `contactBreakingThreshold` is 1e-4 instead of 0.02, the default. On the flat side of a `SiconosBox` with this
# threshold the ball rolls straight on.
# Packages: python3-siconos 4.4.0 (Debian 12).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian python3-numpy 1:1.24.2-1+deb12u1 1:1.24.2-1
debian libbullet3.24 3.24+dfsg-2
debian libtmglib3 3.11.0-2
debian liblapacke 3.11.0-2
for part in numerics kernel control mechanics io; do
  debian libsiconos-${part}7 4.4.0+dfsg-2
done
debian siconos 4.4.0+dfsg-2
debian python3-siconos 4.4.0+dfsg-2
program siconos

cat >"$folder/ball.py" <<'END_OF_SCRIPT'
import math

import numpy
import siconos.kernel as kernel
import siconos.mechanics.collision as collision
from siconos.mechanics.collision.bullet import SiconosBulletCollisionManager, SiconosBulletOptions


def direction(shape, height, step, options):
    model = kernel.NonSmoothDynamicalSystem(0, 1)
    ball = collision.RigidBodyDS([0, 0, 1, 1, 0, 0, 0], [1, 0, 0, 0, 1, 0], 1, numpy.eye(3)*0.4)
    contactors = collision.SiconosContactorSet()
    contactors.append(collision.SiconosContactor(collision.SiconosSphere(1)))
    ball.setContactors(contactors)
    ball.setFExtPtr([0, 0, -9.81])
    model.insertDynamicalSystem(ball)
    manager = SiconosBulletCollisionManager(options)
    manager.insertNonSmoothLaw(kernel.NewtonImpactFrictionNSL(0, 0, 0.3, 3), 0, 0)
    floor = collision.SiconosContactorSet()
    floor.append(collision.SiconosContactor(shape))
    manager.insertStaticContactorSet(floor, [0, 0, height, 1, 0, 0, 0])
    simulation = kernel.TimeStepping(model, kernel.TimeDiscretisation(0, step))
    simulation.insertIntegrator(kernel.MoreauJeanOSI(0.5))
    simulation.insertNonSmoothProblem(kernel.FrictionContact(3))
    simulation.insertInteractionManager(manager)
    while simulation.hasNextEvent():
        simulation.computeOneStep()
        simulation.nextStep()
    x, y = ball.twist()[0:2]
    return math.degrees(math.atan2(y, x))


close = SiconosBulletOptions()
close.contactBreakingThreshold = 1e-4
for name, shape, height, options in (
        ("SiconosPlane", collision.SiconosPlane(), 0, SiconosBulletOptions()),
        ("SiconosPlane, threshold 1e-4", collision.SiconosPlane(), 0, close),
        ("SiconosBox, threshold 1e-4", collision.SiconosBox(100, 100, 1), -0.5, close)):
    for step in 1e-2, 1e-3:
        angle = abs(direction(shape, height, step, options))
        size = "more than 30" if angle > 30 else "less than 0.01" if angle < 0.01 else "%.2f" % angle
        print("%s, time step %g: the motion turns by %s degrees" % (name, step, size))
END_OF_SCRIPT
python "$folder/ball.py" >"$folder/output" 2>/dev/null || true
verdict "SiconosPlane, time step 0.01: the motion turns by more than 30 degrees
SiconosPlane, time step 0.001: the motion turns by more than 30 degrees
SiconosPlane, threshold 1e-4, time step 0.01: the motion turns by more than 30 degrees
SiconosPlane, threshold 1e-4, time step 0.001: the motion turns by more than 30 degrees
SiconosBox, threshold 1e-4, time step 0.01: the motion turns by less than 0.01 degrees
SiconosBox, threshold 1e-4, time step 0.001: the motion turns by less than 0.01 degrees"
