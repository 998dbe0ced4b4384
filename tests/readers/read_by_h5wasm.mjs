// h5wasm, the HDF5 library of browsers, reads particles.h5: node read_by_h5wasm.mjs MODULE RUNS
import assert from "node:assert";
import fs from "node:fs";
import path from "node:path";

const [module, runs] = process.argv.slice(2);
const h5wasm = await import(path.join(module, "dist/node/hdf5_hl.js"));
await h5wasm.ready;

for (const run of ["dry", "pour"]) {
  const lines = fs.readFileSync(path.join(runs, run, "final_particles.csv"), "utf8")
    .split("\n").filter((line) => line !== "" && !line.startsWith("#"));
  const names = lines[0].split(",");
  const rows = lines.slice(1).map((line) => line.split(",").map(Number));
  const column = (name) => rows.map((row) => row[names.indexOf(name)]);

  const file = new h5wasm.File(path.join(runs, run, "particles.h5"), "r");
  // 64-bit whole numbers are BigInt.
  const [begin, end] = Array.from(file.get("particles/begin").value.slice(-2), Number);
  assert.strictEqual(end - begin, rows.length);
  for (const name of ["radius", "mass", "id"])
    assert.deepStrictEqual(Array.from(file.get(`particles/${name}`).value.slice(begin, end)), column(name), name);
  const places = Array.from(file.get("particles/position").slice([[begin, end], [0, 3]]));
  assert.deepStrictEqual(places.filter((_, k) => k % 3 === 0), column("x"));
  assert.ok(file.attrs.provenance.value.startsWith("# provenance: {"));
  file.close();
}
console.log("h5wasm read 2 files");
