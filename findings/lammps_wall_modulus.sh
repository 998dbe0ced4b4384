#!/bin/sh
# A sphere of radius 1 overlaps by 0.01 with an equal sphere, and another one by as much with a wall. Pair and wall
# have the same coefficients, `hertz/material` with Young's modulus 1e8 and Poisson's ratio n. The manual says that
# the force of a wall is that of a pair, in the limit of one particle of infinite radius: by Hertz, sqrt(2) times
# the force between equal spheres. It is 1 + n times as large as that, because the modulus of the pair is
# E/(2 (1 - n^2)) and that of the wall E/(2 (1 - n)): a wall of rubber, n = 0.5, is harder than spheres of the same
# rubber by half, and contacts with it are shorter. `dmt` has the same modulus and does the same.
# Packages: lammps 2022-01-06 (Debian 12).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian libkim-api2 2.3.0-1+b1
debian libvoro++1 0.5+revert-to-0.4.6+dfsg1-1
debian liblammps0 20220106.git7586adbb6a+ds1-2+b2
debian lammps 20220106.git7586adbb6a+ds1-2+b2
program lmp

cat >"$folder/script" <<'END_OF_SCRIPT'
units si
atom_style sphere
atom_modify map array
newton off
comm_modify mode single vel yes
boundary f f f
region all block -10 10 -10 10 -10 10
create_box 1 all
create_atoms 1 single 0 0 -9.01
create_atoms 1 single 5 5 0
create_atoms 1 single 5 5 1.99
set group all diameter 2
set group all density 1000
pair_style granular
pair_coeff * * ${coefficients}
fix wall all wall/gran granular ${coefficients} zplane -10 NULL
thermo_style custom step
timestep 1e-6
fix 1 all nve/sphere
variable wall equal fz[1]
variable pair equal fz[3]
variable hertz equal 4/3*1e8/2/(1-${ratio}^2)*sqrt(0.5)*0.01^1.5
run 0
print "n = ${ratio}: pair $(v_pair/v_hertz:%.4f) of Hertz, wall/pair $(v_wall/v_pair/sqrt(2):%.4f) of sqrt(2)"
END_OF_SCRIPT
for ratio in 0 0.3 0.5; do
  lmp -in "$folder/script" -var ratio $ratio -log none -echo none \
    -var coefficients "hertz/material 1e8 0 $ratio tangential linear_nohistory 0 0" </dev/null 2>/dev/null |
    grep 'of sqrt'
done >"$folder/output"
verdict "n = 0: pair 1.0000 of Hertz, wall/pair 1.0000 of sqrt(2)
n = 0.3: pair 1.0000 of Hertz, wall/pair 1.3000 of sqrt(2)
n = 0.5: pair 1.0000 of Hertz, wall/pair 1.5000 of sqrt(2)"
