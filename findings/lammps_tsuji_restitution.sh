#!/bin/sh
# Two equal spheres meet head-on with `pair_style granular`, `hertz/material` and `damping tsuji`, for which the
# manual says that the coefficient of damping is the coefficient of restitution e, from which a polynomial gives the
# factor a of the damping a sqrt(m k), with the effective mass m. They part with 0.616 for e = 0.5, with 0.235 for
# 0.1 and with 0.928 for 0.9; e = 1 is right. With this damping Hertz spheres have the restitution
# exp(-pi a/sqrt(5 - a^2)) (Antypov & Elliott 2011), 0.616 for the a = 0.341 of the polynomial at 0.5. The polynomial
# is sqrt(2) too small for the effective mass: with the mass of one of the spheres it would be right. A sphere at a
# wall rebounds with the same wrong numbers.
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
create_atoms 1 single 0 0 -1.001
create_atoms 1 single 0 0 1.001
create_atoms 1 single 5 5 -8.999
set group all diameter 2
set group all density 1000
set atom 1 vz 1
set atom 2 vz -1
set atom 3 vz -1
pair_style granular
pair_coeff * * hertz/material 1e8 ${e} 0.3 damping tsuji tangential linear_nohistory 0 0
fix wall all wall/gran granular hertz/material 1e8 ${e} 0.3 damping tsuji tangential linear_nohistory 0 0 &
  zplane -10 NULL
thermo_style custom step
timestep 2e-6
fix 1 all nve/sphere
variable pair equal vz[2]
variable wall equal vz[3]
run 60000
print "e = ${e}: two spheres $(v_pair:%.3f), sphere at a wall $(v_wall:%.3f)"
END_OF_SCRIPT
for e in 0.1 0.5 0.9 1; do
  lmp -in "$folder/script" -var e $e -log none -echo none </dev/null 2>/dev/null | grep '^e ='
done >"$folder/output"
verdict "e = 0.1: two spheres 0.235, sphere at a wall 0.235
e = 0.5: two spheres 0.616, sphere at a wall 0.616
e = 0.9: two spheres 0.928, sphere at a wall 0.928
e = 1: two spheres 1.000, sphere at a wall 1.000"
