#!/bin/sh
# Two spheres of radius 1 with a liquid of viscosity 1 between them approach each other with the velocity v = 0.001. The
# viscous force of `cohesion washino/capillary/viscous` is 6 pi mu v R^2/h at the gap h, with R = 1/2, as in
# Reynolds' theory. minSeparationDistanceRatio limits it at small gaps; the manual of LIGGGHTS 3.8.0 recommends
# 1.01. With this value the force is the same at all gaps, 6 pi mu v R/1.01 = 0.0093, at h = 0.01 a fiftieth of what
# it should be, and no film slows a collision. The program compares the value with h/R; 1.01 would be right for
# the distance of centres, as is 1.1, recommended for maxSeparationDistanceRatio. With 0.001 the forces are right.
# Packages: liggghts 3.8.0 (Debian 12).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian libliggghts3 3.8.0+repack1-9+b2
debian liggghts 3.8.0+repack1-9+b2
program liggghts

cat >"$folder/script" <<'END_OF_SCRIPT'
units si
atom_style sphere
atom_modify map array
boundary f f f
newton off
communicate single vel yes
region box block -4 4 -4 4 -4 4 units box
create_box 1 box
variable place equal 2+${gap}
create_atoms 1 single 0 0 0 units box
create_atoms 1 single 0 0 ${place} units box
set group all diameter 2 density 1000
set atom 2 vz -0.001
neighbor 0.1 bin
fix 1 all property/global youngsModulus peratomtype 5e6
fix 2 all property/global poissonsRatio peratomtype 0.3
fix 3 all property/global coefficientRestitution peratomtypepair 1 1
fix 4 all property/global coefficientFriction peratomtypepair 1 0
fix 5 all property/global minSeparationDistanceRatio scalar ${ratio}
fix 6 all property/global maxSeparationDistanceRatio scalar 1.1
fix 7 all property/global surfaceLiquidContentInitial scalar 1
fix 8 all property/global surfaceTension scalar 0
fix 9 all property/global fluidViscosity scalar 1
fix 10 all property/global contactAngle peratomtype 0
pair_style gran model hertz tangential no_history cohesion washino/capillary/viscous
pair_coeff * *
fix 11 all nve/sphere
thermo_style custom step
timestep 1e-9
variable force equal fz[2]
variable theory equal 6*PI*0.001*0.25/${gap}
run 1
print "seen ${force} ${theory}"
END_OF_SCRIPT
for ratio in 1.01 0.001; do
  for gap in 0.005 0.01 0.02 0.1; do
    liggghts -in "$folder/script" -var ratio $ratio -var gap $gap -log none -echo none </dev/null 2>/dev/null |
      awk -v r=$ratio -v g=$gap '/^seen/ { printf "ratio %s, gap %s: force %.4f, theory %.4f\n", r, g, $2, $3 }'
  done
done >"$folder/output"
verdict "ratio 1.01, gap 0.005: force 0.0093, theory 0.9425
ratio 1.01, gap 0.01: force 0.0093, theory 0.4712
ratio 1.01, gap 0.02: force 0.0093, theory 0.2356
ratio 1.01, gap 0.1: force 0.0093, theory 0.0471
ratio 0.001, gap 0.005: force 0.9425, theory 0.9425
ratio 0.001, gap 0.01: force 0.4712, theory 0.4712
ratio 0.001, gap 0.02: force 0.2356, theory 0.2356
ratio 0.001, gap 0.1: force 0.0471, theory 0.0471"
