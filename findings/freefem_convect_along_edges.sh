#!/bin/sh
# convect of FreeFEM follows the path of each node back, from triangle to triangle, and loses its way where
# the path runs along edges of the mesh. Here u = x is carried by a constant velocity v for a time of 0.25.
# All of it is exact in P2, so that each node whose path stays inside should get x - 0.25 v_x, up to rounding.
# It does for v = (0.9, 0.37). In the directions of the edges, (1, 0) and (0.5, 0.5), one node in 20 gets
# another number, without a word, and some are wrong by more than twice the length of the path.
# Packages: freefem++ 4.11 (Debian 12) and 4.15 (Debian 13).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian freefem++ 4.11+dfsg1-3 4.11+dfsg1-2 4.15+dfsg-1
command -v FreeFem++ >/dev/null || unavailable "FreeFem++ is not installed"

cat >"$folder/convect.edp" <<'END_OF_SCRIPT'
mesh Th = square(20, 20);
fespace Space(Th, P2);
Space u = x;
real[int] vx = [0.9, 1, 0.5], vy = [0.37, 0, 0.5];
for (int i = 0; i < vx.n; i++) {
  real dx = 0.25 * vx[i], dy = 0.25 * vy[i];
  Space carried = convect([vx[i], vy[i]], -0.25, u);
  Space inside = (x - dx > 0.01) * (y - dy > 0.01) * (y < 0.99);
  Space error = abs(carried - (x - dx)) * inside;
  cout << "velocity (" << vx[i] << ", " << vy[i] << "): ";
  if (error[].max < 1e-6) cout << "no node is wrong" << endl;
  else if (error[].max < sqrt(dx^2 + dy^2)) cout << "nodes are wrong" << endl;
  else cout << "nodes are wrong by more than the length of the path" << endl;
}
END_OF_SCRIPT
FreeFem++ -nw -v 0 "$folder/convect.edp" >"$folder/output" 2>&1
verdict "velocity (0.9, 0.37): no node is wrong
velocity (1, 0): nodes are wrong by more than the length of the path
velocity (0.5, 0.5): nodes are wrong by more than the length of the path"
