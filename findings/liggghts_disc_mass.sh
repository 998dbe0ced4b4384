#!/bin/sh
# One data file with two atoms of style sphere, of radius 1 mm and 100 mm and density 1000, is read with
# `units si` and `dimension 2` by LIGGGHTS and by LAMMPS, from which LIGGGHTS was made. In LIGGGHTS a mass is
# density pi r^2, that of a disc, in LAMMPS density 4/3 pi r^3, that of a sphere: they differ by 3/(4 r), so
# that the small atom is 750 times as heavy in LIGGGHTS. In three dimensions they agree. The
# manual of LIGGGHTS 3.8.0 says at `dimension` that atoms are spheres in two dimensions as well, not discs, and
# at `read_data` that the density is multiplied by a volume, which for spheres is one of three dimensions. Only
# the page of units allows for it: a density is in kilograms/meter^dim.
# Packages: liggghts 3.8.0 and lammps 2022-01-06 (Debian 12).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian libliggghts3 3.8.0+repack1-9+b2
debian liggghts 3.8.0+repack1-9+b2
debian libvoro++1 0.5+revert-to-0.4.6+dfsg1-1
debian libkim-api2 2.3.0-1+b1
debian liblammps0 20220106.git7586adbb6a+ds1-2+b2
debian lammps 20220106.git7586adbb6a+ds1-2+b2
program liggghts
program lmp

cat >"$folder/atoms" <<'END_OF_ATOMS'
two atoms: number, type, diameter, density, place

2 atoms
1 atom types
-1 1 xlo xhi
-1 1 ylo yhi
-0.5 0.5 zlo zhi

Atoms

1 1 0.002 1000 0 0 0
2 1 0.2 1000 0.5 0 0
END_OF_ATOMS
cat >"$folder/script" <<'END_OF_SCRIPT'
units si
atom_style sphere
atom_modify map array
dimension ${dimension}
boundary f f p
read_data ${atoms}
variable first equal mass[1]
variable second equal mass[2]
print "dimension ${dimension}: ${first} ${second}"
END_OF_SCRIPT
for program in liggghts lmp; do
  for dimension in 2 3; do
    "$program" -in "$folder/script" -var dimension "$dimension" -var atoms "$folder/atoms" -log none \
      -echo none </dev/null 2>/dev/null | sed -n "s/^dimension/$program, &/p"
  done
done | awk '{ printf "%s %s %s %.3e %.3e\n", $1, $2, $3, $4, $5 }' >"$folder/output"
verdict "liggghts, dimension 2: 3.142e-03 3.142e+01
liggghts, dimension 3: 4.189e-06 4.189e+00
lmp, dimension 2: 4.189e-06 4.189e+00
lmp, dimension 3: 4.189e-06 4.189e+00"
