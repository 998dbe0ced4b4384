#!/bin/sh
# 256 spheres of radius 1 on a face-centred cubic lattice, which allows volume fractions up to 0.74, move with
# the velocity 1 through a fluid of viscosity 1. `pair_style lubricate/poly` with flagfld = 1 and flagVF = 1 (its
# default) adds the drag of each sphere in the suspension to the forces of pairs, which are 0 here. This drag is
# 6 pi (1 + 2.725 phi - 6.583 phi^2) times the velocity, a parabola fitted to dilute suspensions. Above
# phi = 0.648 it is negative, and drives the spheres: they gain energy from a fluid at rest. LAMMPS says nothing,
# and its manual names no largest volume fraction. Random packings reach 0.64, of unequal spheres more.
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
units lj
atom_style sphere
newton off
comm_modify mode single vel yes
variable number equal ${fraction}*3/(4*PI)
lattice fcc ${number}
region all block 0 4 0 4 0 4
create_box 1 all
create_atoms 1 box
set group all diameter 2
set group all density 1
velocity all set 1 0 0 units box
pair_style lubricate/poly 1 1 1 2.0001 2.5 1 1
pair_coeff * *
fix 1 all nve/sphere
compute force all reduce ave fx
variable force equal c_force
thermo_style custom step c_force
run 0
print "drag at a volume fraction of ${fraction}: $(v_force:%.2f)"
END_OF_SCRIPT
for fraction in 0.10 0.50 0.64 0.66 0.70; do
  lmp -in "$folder/script" -var fraction $fraction -log none -echo none </dev/null 2>/dev/null |
    grep '^drag'
done >"$folder/output"
verdict "drag at a volume fraction of 0.10: -22.75
drag at a volume fraction of 0.50: -13.51
drag at a volume fraction of 0.64: -0.90
drag at a volume fraction of 0.66: 1.30
drag at a volume fraction of 0.70: 6.00"
