#!/bin/sh
# In FreeFEM u(x, y) has a value also if the point (x, y) is outside the mesh, and it depends on the space
# of u which one. P1, P2 and P1nc take the value at the nearest point of the border, at any distance; P0,
# P1dc and P2dc are 0. The same function in two spaces, which agree at each point inside, is therefore 2 and
# 0 at a point 0.01 beyond the border, without a word. chi(Th)(x, y) tells whether a point is inside.
# Packages: freefem++ 4.11 (Debian 12) and 4.15 (Debian 13).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian freefem++ 4.11+dfsg1-3 4.11+dfsg1-2 4.15+dfsg-1
command -v FreeFem++ >/dev/null || unavailable "FreeFem++ is not installed"

cat >"$folder/outside.edp" <<'END_OF_SCRIPT'
mesh Th = square(8, 8);
fespace S1(Th, P1);
fespace S2(Th, P2);
fespace S1nc(Th, P1nc);
fespace S0(Th, P0);
fespace S1dc(Th, P1dc);
fespace S2dc(Th, P2dc);
S1 p1 = 1 + x;
S2 p2 = 1 + x;
S1nc p1nc = 1 + x;
S0 p0 = 2;
S1dc p1dc = 1 + x;
S2dc p2dc = 1 + x;
real[int] places = [0.99, 1.01, 5];
for (int i = 0; i < places.n; i++) {
  real x0 = places[i], y0 = 0.3;
  cout << "x = " << x0 << ": P1 " << p1(x0, y0) << ", P2 " << p2(x0, y0) << ", P1nc " << p1nc(x0, y0)
       << "; P0 " << p0(x0, y0) << ", P1dc " << p1dc(x0, y0) << ", P2dc " << p2dc(x0, y0) << endl;
}
END_OF_SCRIPT
FreeFem++ -nw -v 0 "$folder/outside.edp" >"$folder/output" 2>&1
verdict "x = 0.99: P1 1.99, P2 1.99, P1nc 1.99; P0 2, P1dc 1.99, P2dc 1.99
x = 1.01: P1 2, P2 2, P1nc 2; P0 0, P1dc 0, P2dc 0
x = 5: P1 2, P2 2, P1nc 2; P0 0, P1dc 0, P2dc 0"
