#!/bin/sh
# Two spheres of radius 1 in a fluid of viscosity 1, without forces. `pair_style lubricateU` computes the
# velocities at which nothing acts on them: 0 in a fluid at rest, whatever their distance, and those of the fluid
# in a shear flow if the spheres are beyond the cutoff. The program gives -nan instead for all velocities, and
# goes on without an error; lubricateU/poly does the same. Its conjugate gradients probably divide by the residual
# of the start, which is 0 there. Spheres in a shear flow within the cutoff have the right velocities.
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
region all block -20 20 -20 20 -20 20
create_box 1 all
create_atoms 1 single 0 ${y} 0
create_atoms 1 single 0 -${y} 0
set group all diameter 2
set group all density 1
velocity all set 0 0 0
pair_style ${style} 1 1 2.0001 3 ${rate} 1 0
pair_coeff * *
timestep 1e-3
fix 1 all nve/sphere
compute speed all reduce sum vx
thermo_style custom step c_speed
variable sum equal abs(c_speed)
run 1
print "${style}, distance $(2*v_y:%.2f), shear rate ${rate}: sum of the velocities $(v_sum:%.2f)"
END_OF_SCRIPT
for style in lubricateU lubricateU/poly; do
  for flow in '1.03 1' '1.03 0' '5 1'; do
    lmp -in "$folder/script" -var style $style -var y "${flow% *}" -var rate "${flow#* }" -log none -echo none \
      </dev/null 2>/dev/null | grep '^lubricateU.*sum'
  done
done >"$folder/output"
verdict "lubricateU, distance 2.06, shear rate 1: sum of the velocities 0.00
lubricateU, distance 2.06, shear rate 0: sum of the velocities nan
lubricateU, distance 10.00, shear rate 1: sum of the velocities nan
lubricateU/poly, distance 2.06, shear rate 1: sum of the velocities 0.00
lubricateU/poly, distance 2.06, shear rate 0: sum of the velocities nan
lubricateU/poly, distance 10.00, shear rate 1: sum of the velocities nan"
