#!/bin/sh
# Two spheres of radius 1 in a fluid of viscosity 1 with a gap of 0.01; the first turns about an axis across the
# line of centres with the angular velocity 1, the other is at rest. `pair_style lubricate/poly` is the style for
# any radii, and equal radii are a case of it. The torque on the sphere at rest has the wrong sign: 8.90, where
# the terms ln(gap) that the style is made of give -5.79 (Jeffrey & Onishi 1984), and all terms -5.17. `lubricate`,
# the style for equal spheres, gives -12.30 for the same two spheres, and -16.64 for the torque on the sphere that
# turns, whose exact value is -41.09. Forces agree in both styles. A pair turns faster or slower than it should
# as soon as its spheres turn.
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
region all block -10 10 -10 10 -10 10
create_box 1 all
create_atoms 1 single 0 0 0
create_atoms 1 single 0 0 2.01
set group all diameter 2
set group all density 1
set atom 1 omega 0 1 0
pair_style ${style} 1 1 0 2.0005 2.5
pair_coeff * *
fix 1 all nve/sphere
dump 1 all custom 1 ${dump} fx tqy
dump_modify 1 sort id format float %.2f
run 0
END_OF_SCRIPT
for style in lubricate lubricate/poly; do
  lmp -in "$folder/script" -var style "$style" -var dump "$folder/dump" -log none -echo none \
    -screen none </dev/null
  tail -n 2 "$folder/dump" | sed "s|^|$style, force and torque: |; s/ *$//"
done >"$folder/output"
verdict "lubricate, force and torque: -14.47 -16.64
lubricate, force and torque: 14.47 -12.30
lubricate/poly, force and torque: -14.47 -37.83
lubricate/poly, force and torque: 14.47 8.90"
