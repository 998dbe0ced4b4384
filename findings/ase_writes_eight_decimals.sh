#!/bin/sh
# ASE reads small lengths from an extended XYZ file with all digits. When it writes the same atoms as
# extended XYZ, every number has eight digits after the point, so that lengths in metres are gone: a
# radius of 1 nm becomes 0. The file that results is valid, and there is no warning.
# Packages: python3-ase 3.22.1 (Debian 12) and 3.24.0 (Debian 13).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian python3-numpy 1:1.24.2-1+deb12u1 1:1.24.2-1 1:2.2.4+ds-1
debian python3-scipy 1.10.1-2 1.15.3-1
debian python3-ase 3.22.1-3+deb12u1 3.22.1-3 3.24.0-1

cat >"$folder/in.xyz" <<END
1
pbc="F F F" Properties=species:S:1:pos:R:3:radius:R:1
X 2.5e-9 0 0.125 1e-9
END
python - "$folder" >"$folder/output" <<'END'
import sys

import ase.io

folder = sys.argv[1]
atoms = ase.io.read(folder + "/in.xyz")
print("read:", atoms.positions[0, 0], atoms.arrays["radius"][0])
ase.io.write(folder + "/out.xyz", atoms)
atoms = ase.io.read(folder + "/out.xyz")
print("written and read again:", atoms.positions[0, 0], atoms.arrays["radius"][0])
END
verdict "read: 2.5e-09 1e-09
written and read again: 0.0 0.0"
