#!/bin/sh
# An atom of style sphere has 1 kg by `set ... mass 1`, and its diameter is then set to the value that it has
# already: its mass becomes density pi d^3/6, with the density that it had before, which the setting
# of the mass leaves as it was. The manual of LIGGGHTS 3.8.0 says of `set ... diameter` that it does not
# change a mass, even one that was given by a density. With the diameter before the mass, the mass remains.
# Packages: liggghts 3.8.0 (Debian 12).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian libliggghts3 3.8.0+repack1-9+b2
debian liggghts 3.8.0+repack1-9+b2
program liggghts

cat >"$folder/script" <<'END_OF_SCRIPT'
units si
atom_style sphere
atom_modify map array
boundary f f f
region box block -1 1 -1 1 -1 1 units box
create_box 1 box
create_atoms 1 single 0 0 0 units box
variable mass equal mass[1]
set group all diameter 0.2 density 1000
print "density 1000: ${mass}"
set group all mass 1
print "mass 1: ${mass}"
set group all diameter 0.2
print "the same diameter: ${mass}"
set group all mass 1
print "mass 1: ${mass}"
END_OF_SCRIPT
liggghts -in "$folder/script" -log none -echo none </dev/null 2>/dev/null |
  awk -F ': ' '/^(density|mass|the)/ { printf "%s: %.3f\n", $1, $2 }' >"$folder/output"
verdict "density 1000: 4.189
mass 1: 1.000
the same diameter: 4.189
mass 1: 1.000"
