#!/bin/sh
# A square of side 8 with a round hole, moved along the diagonal. buildmesh makes the mesh at 0, 1e3,
# 1e5, 1e6 and 1e9, but not at 1e7 and 1e8, where it throws an error, although doubles have more
# digits for the square there than at 1e9.
# Packages: freefem++ 4.11 (Debian 12).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian freefem++ 4.11+dfsg1-3 4.11+dfsg1-2
command -v FreeFem++ >/dev/null || unavailable "FreeFem++ is not installed"

cat >"$folder/moved.edp" <<'END'
real[int] places = [0, 1e3, 1e5, 1e6, 1e7, 1e8, 1e9];
for [k, place : places] {
  border bottom(t = 0, 8) { x = place + t; y = place; }
  border right(t = 0, 8) { x = place + 8; y = place + t; }
  border top(t = 8, 0) { x = place + t; y = place + 8; }
  border left(t = 8, 0) { x = place; y = place + t; }
  border hole(t = 0, 2 * pi) { x = place + 3 + cos(t); y = place + 4 + sin(t); }
  try {
    mesh Th = buildmesh(bottom(12) + right(12) + top(12) + left(12) + hole(-24));
    cout << "place " << place << " mesh of area " << Th.area << endl;
  } catch (...) {
    cout << "place " << place << " error" << endl;
  }
}
END
FreeFem++ -nw -v 0 "$folder/moved.edp" 2>&1 | sed -n 's/^place //p' | paste -s -d ',' >"$folder/output"
verdict "0 mesh of area 60.8942,1000 mesh of area 60.8942,100000 mesh of area 60.8942,1e+06 mesh of area 60.8942,1e+07 error,1e+08 error,1e+09 mesh of area 60.8942"
