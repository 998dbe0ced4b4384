#!/bin/sh
# A column of whole numbers in an extended XYZ file has no limit in the format. ASE stores it in 32
# bits: the number 3000000000 is read as -1294967296, without an error or a warning. Python and numpy
# themselves refuse such a number (OverflowError) where they are asked to store it in 32 bits.
# Packages: python3-ase 3.22.1 (Debian 12) with numpy 1.24.
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian python3-numpy 1:1.24.2-1+deb12u1 1:1.24.2-1
debian python3-scipy 1.10.1-2
debian python3-ase 3.22.1-3+deb12u1 3.22.1-3

cat >"$folder/in.xyz" <<END
2
pbc="F F F" Properties=species:S:1:pos:R:3:id:I:1
X 0 0 0 3000000000
X 1 0 0 2147483647
END
python - "$folder" >"$folder/output" <<'END'
import sys

import ase.io

print("ids:", *ase.io.read(sys.argv[1] + "/in.xyz").arrays["id"])
END
verdict "ids: -1294967296 2147483647"
