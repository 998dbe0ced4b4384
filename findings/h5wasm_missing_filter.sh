#!/bin/sh
# h5wasm, the HDF5 library of browsers, lacks the filter lzf, which h5py offers beside gzip. One would
# expect an error when a data set needs it. The C library prints its errors on the standard error,
# but h5wasm throws nothing and returns an array of the right type and length whose numbers are not
# those of the file.
# Packages: h5wasm 0.10.3 (npm); h5py 3.7 (Debian 12) writes the file.
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian python3-h5py 3.7.0-8 3.13.0-1
npm_package h5wasm 0.10.3

python - "$folder" <<'END'
import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1] + "/numbers.h5", "w") as file:
    for filter in ("gzip", "lzf"):
        file.create_dataset(filter, data=np.arange(1.0, 1001.0), compression=filter)
END
cat >"$folder/read.mjs" <<'END'
import h5wasm from "./node_modules/h5wasm/dist/node/hdf5_hl.js";

await h5wasm.ready;
const file = new h5wasm.File(`${process.argv[2]}/numbers.h5`, "r");
for (const name of ["gzip", "lzf"]) {
  try {
    const numbers = file.get(name).value;
    const right = numbers.filter((number, k) => number === k + 1).length;
    console.log(`${name}: ${numbers.constructor.name} of ${numbers.length}, right numbers: ${right}`);
  } catch (error) {
    console.log(`${name}: error`);
  }
}
END
node "$folder/read.mjs" "$folder" >"$folder/output" 2>/dev/null
verdict "gzip: Float64Array of 1000, right numbers: 1000
lzf: Float64Array of 1000, right numbers: 0"
