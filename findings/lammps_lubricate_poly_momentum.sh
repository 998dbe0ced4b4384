#!/bin/sh
# Two spheres of radii 1 and 2 with a gap of 0.01 in a fluid of viscosity 1; the first turns about an axis across
# the line of centres with the angular velocity 1. Without flagfld `pair_style lubricate/poly` has the forces of
# the film between both only, terms 1/gap and ln(gap), which are opposite for any radii (Jeffrey & Onishi 1984). Its
# forces are -20.58 and 23.68, so that the film pushes the pair along, and its torques, -51.76 and 95.41, do not
# balance the couple of the forces either: momentum and angular momentum are made of nothing. The film's terms
# are -16.79 and 16.79, and the torques -33.58 and -16.79. With equal radii the forces are opposite.
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
boundary f f f
region all block -20 20 -20 20 -20 20
create_box 1 all
variable distance equal 1+${radius}+0.01
create_atoms 1 single 0 0 0
create_atoms 1 single 0 0 ${distance}
variable diameter equal 2*${radius}
set atom 1 diameter 2
set atom 2 diameter ${diameter}
set group all density 1
set atom 1 omega 0 1 0
variable inner equal ${distance}-0.009
variable outer equal ${distance}+0.4
pair_style lubricate/poly 1 1 0 ${inner} ${outer}
pair_coeff * *
fix 1 all nve/sphere
dump 1 all custom 1 ${dump} fx tqy
dump_modify 1 sort id format float %.2f
run 0
END_OF_SCRIPT
for radius in 1 2; do
  lmp -in "$folder/script" -var radius $radius -var dump "$folder/dump" -log none -echo none \
    -screen none </dev/null
  tail -n 2 "$folder/dump" | sed "s/^/radius $radius, force and torque: /; s/ *$//"
done >"$folder/output"
verdict "radius 1, force and torque: -14.47 -37.83
radius 1, force and torque: 14.47 8.90
radius 2, force and torque: -20.58 -51.76
radius 2, force and torque: 23.68 95.41"
