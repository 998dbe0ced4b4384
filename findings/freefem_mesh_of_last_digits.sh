#!/bin/sh
# A square with a round hole, whose 36 points are given twice: as they are, and as 1 - (1 - x), which moves
# them by less than 1e-16. buildmesh makes 166 vertices of the first and 168 of the second, each time that it
# is called. Of 69 meshes with 8 to 96 points, 19 differ so. A computer whose cos differs in the last digit can
# then compute on another mesh.
# Packages: freefem++ 4.11 (Debian 12).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian freefem++ 4.11+dfsg1-3 4.11+dfsg1-2
command -v FreeFem++ >/dev/null || unavailable "FreeFem++ is not installed"

cat >"$folder/hole.edp" <<'END_OF_SCRIPT'
func real there(real place, int moved) {
  return moved > 0 ? 1 - (1 - place) : place;
}
func int vertices(int n, int edges, int moved) {
  border bottom(t = 0, 1) { x = t; y = 0; }
  border right(t = 0, 1) { x = 1; y = t; }
  border top(t = 0, 1) { x = 1 - t; y = 1; }
  border left(t = 0, 1) { x = 0; y = 1 - t; }
  border hole(t = 0, 2 * pi) {
    x = there(0.5 + 0.3 * cos(t), moved);
    y = there(0.5 + 0.3 * sin(t), moved);
  }
  mesh Th = buildmesh(bottom(edges) + right(edges) + top(edges) + left(edges) + hole(-n));
  return Th.nv;
}
real farthest = 0;
for (int k = 0; k < 36; k++) {
  real t = 2 * pi * k / 36;
  real X = 0.5 + 0.3 * cos(t), Y = 0.5 + 0.3 * sin(t);
  farthest = max(farthest, max(abs(there(X, 1) - X), abs(there(Y, 1) - Y)));
}
cout << "coordinates moved by less than 1e-16: " << (farthest > 0 && farthest < 1e-16 ? "yes" : "no") << endl;
for (int again = 0; again < 3; again++)
  cout << "vertices " << vertices(36, 10, 0) << ", moved " << vertices(36, 10, 1) << endl;
int meshes = 0, different = 0;
for (int n = 8; n < 100; n += 4)
  for (int edges = 5; edges < 20; edges += 5) {
    meshes++;
    if (vertices(n, edges, 0) != vertices(n, edges, 1)) different++;
  }
cout << different << " of " << meshes << " differ" << endl;
END_OF_SCRIPT
FreeFem++ -nw -v 0 "$folder/hole.edp" >"$folder/output" 2>&1
verdict "coordinates moved by less than 1e-16: yes
vertices 166, moved 168
vertices 166, moved 168
vertices 166, moved 168
19 of 69 differ"
