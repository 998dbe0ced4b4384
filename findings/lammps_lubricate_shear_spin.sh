#!/bin/sh
# A sphere of radius 1 alone in a cubic box that `fix deform ... xy erate 1 remap v` shears, in a fluid of
# viscosity 1. `pair_style lubricate` with flagfld = 1 is to give it the motion of the fluid around it: the
# velocity of the fluid at its centre, and half the vorticity as angular velocity, -1/2, in every box. In a box
# of length 6 it comes to turn with -3, in one of length 12 with -6: minus half the velocity between the two
# faces of the box, where the shear rate is meant. The velocity is right, and so is the stress, 5/2 of the
# volume fraction times the viscosity. lubricate/poly does the same. Films between spheres see the same wrong angular
# velocity.
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
region all prism 0 ${length} 0 ${length} 0 ${length} 0 0 0
create_box 1 all
create_atoms 1 single 1 2 1
set group all diameter 2
set group all density 1
velocity all set 0 0 0
pair_style ${style} 1 1 1 2.0005 2.5 1 0
pair_coeff * *
timestep 1e-3
fix 1 all nve/sphere
fix 2 all deform 1 xy erate 1 remap v
compute pressure all pressure NULL virial
compute speed all property/atom vx
compute spin all property/atom omegaz
compute motion all reduce sum c_speed c_spin
thermo_style custom step c_motion[1] c_motion[2] c_pressure[4]
variable factor equal -c_pressure[4]*vol/(4/3*PI)
run 5000
print "${style}, box of ${length}: velocity $(c_motion[1]:%.3f), angular velocity $(c_motion[2]:%.3f), &
stress $(v_factor:%.3f)"
END_OF_SCRIPT
for style in lubricate lubricate/poly; do
  for length in 6 12; do
    lmp -in "$folder/script" -var style $style -var length $length -log none -echo none </dev/null 2>/dev/null |
      grep '^lubricate.*box'
  done
done >"$folder/output"
verdict "lubricate, box of 6: velocity 2.000, angular velocity -3.000, stress 2.500
lubricate, box of 12: velocity 2.000, angular velocity -6.000, stress 2.500
lubricate/poly, box of 6: velocity 2.000, angular velocity -3.000, stress 2.500
lubricate/poly, box of 12: velocity 2.000, angular velocity -6.000, stress 2.500"
