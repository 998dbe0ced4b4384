#!/bin/sh
# An atom of style sphere slides over a floor without turning, at 1 m/s, until friction makes it roll. About
# the line of contact nothing turns it, so that v + k r w, with a moment of inertia k m r^2, remains 1, and the
# motion shows k. With `dimension 3` k is 0.40, and compute erotate/sphere gives the energy of this k. With
# `dimension 2` k is 0.50, that of a disc, but compute erotate/sphere gives the energy with 0.40: the energy of
# turning is a fifth too small, and with it the sum of energies. The manual of LIGGGHTS 3.8.0 says at
# `dimension` and at the compute that the moment of inertia in two dimensions is the same as in three.
# Packages: liggghts 3.8.0 (Debian 12).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian libliggghts3 3.8.0+repack1-9+b2
debian liggghts 3.8.0+repack1-9+b2
program liggghts

cat >"$folder/atom" <<'END_OF_ATOM'
one atom: number, type, diameter, density, place; velocity, angular velocity

1 atoms
1 atom types
-10 10 xlo xhi
-1 1 ylo yhi
-0.5 0.5 zlo zhi

Atoms

1 1 0.2 1000 0 0.1 0

Velocities

1 1 0 0 0 0 0
END_OF_ATOM
cat >"$folder/script" <<'END_OF_SCRIPT'
units si
atom_style sphere
atom_modify map array
dimension ${dimension}
boundary f f p
newton off
communicate single vel yes
read_data ${atom}
neighbor 0.01 bin
fix 1 all property/global youngsModulus peratomtype 1e8
fix 2 all property/global poissonsRatio peratomtype 0.3
fix 3 all property/global coefficientRestitution peratomtypepair 1 0.1
fix 4 all property/global coefficientFriction peratomtypepair 1 0.5
pair_style gran model hertz tangential history
pair_coeff * *
fix 5 all gravity 9.81 vector 0 -1 0
fix 6 all wall/gran model hertz tangential history primitive type 1 yplane 0
fix 7 all nve/sphere
compute turning all erotate/sphere
thermo_style custom step c_turning
thermo_modify norm no
thermo 100000
timestep 1e-5
run 100000
variable m equal mass[1]
variable v equal vx[1]
variable w equal omegaz[1]
variable e equal c_turning
print "seen ${m} ${v} ${w} ${e}"
END_OF_SCRIPT
for dimension in 2 3; do
  liggghts -in "$folder/script" -var dimension "$dimension" -var atom "$folder/atom" -log none -echo none \
    </dev/null 2>/dev/null |
    awk -v d="$dimension" '/^seen/ {
      r = 0.1
      printf "dimension %d: v %.2f, k of the motion %.2f, k of the energy %.2f\n", d, $3,
             (1 - $3) / (-r * $4), 2 * $5 / ($2 * r * r * $4 * $4)
    }'
done >"$folder/output"
verdict "dimension 2: v 0.67, k of the motion 0.50, k of the energy 0.40
dimension 3: v 0.71, k of the motion 0.40, k of the energy 0.40"
