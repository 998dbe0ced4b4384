#!/bin/sh
# 512 spheres far from each other in a fluid, with `pair_style lubricate`, which brakes their motion, and `brownian`,
# which drives it with random forces; flagfld is 1 and all parameters are the same in both, as the manual asks for. At
# the temperature 1 each of the three motions along axes and of the three turns about axes has the mean energy 1/2. With
# flaglog = 1 this is so. With flaglog = 0, which is to leave out the logarithmic terms of pairs, the turns die away,
# because `lubricate` brakes them as before and `brownian` gives no sphere a random torque. Orientations do not diffuse.
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
region all block 0 48 0 48 0 48
create_box 1 all
lattice sc $(1/216)
create_atoms 1 box
set group all diameter 2
set group all density 1
velocity all set 1 0 0
set group all omega 1 0 0
pair_style hybrid/overlay lubricate 1 ${log} 1 2.001 2.5 1 0 brownian 1 ${log} 1 2.001 2.5 1 12345 1 0
pair_coeff * * lubricate
pair_coeff * * brownian
timestep 0.002
fix 1 all nve/sphere
compute moves all ke
compute turns all erotate/sphere
variable moves equal c_moves/(1.5*count(all))
variable turns equal c_turns/(1.5*count(all))
thermo_style custom step c_moves c_turns
thermo_modify norm no
run 2000
reset_timestep 0
fix means all ave/time 10 1000 10000 v_moves v_turns
run 10000
print "flaglog ${log}: temperature of the motion $(f_means[1]:%.1f), of the turning $(f_means[2]:%.1f)"
END_OF_SCRIPT
for log in 0 1; do
  lmp -in "$folder/script" -var log $log -log none -echo none </dev/null 2>/dev/null | grep '^flaglog'
done >"$folder/output"
verdict "flaglog 0: temperature of the motion 1.0, of the turning 0.0
flaglog 1: temperature of the motion 1.0, of the turning 1.0"
