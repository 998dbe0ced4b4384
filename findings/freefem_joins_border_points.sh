#!/bin/sh
# buildmesh of FreeFEM joins two points of the border that are nearer to each other than 1/16 of the
# shortest edge of the border, without a word, although both belong to the curves that it was given. Here an
# octagon with edges of 0.191 is above the floor of a square, with a corner straight above a point of the
# floor. With a gap of 0.015 the mesh has all 18 points. With 0.011 it has 17: the corner and the point of
# the floor have become one, so that the octagon touches the floor. fixedborder=1, which forbids the mesh
# generator to change the border, makes no difference.
# Packages: freefem++ 4.11 (Debian 12) and 4.15 (Debian 13).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian freefem++ 4.11+dfsg1-3 4.11+dfsg1-2 4.15+dfsg-1
command -v FreeFem++ >/dev/null || unavailable "FreeFem++ is not installed"

cat >"$folder/border.edp" <<'END_OF_SCRIPT'
func int count(real gap, int fixed) {
  border bottom(t = 0, 1) { x = t; y = 0; label = 1; }
  border right(t = 0, 1) { x = 1; y = t; label = 1; }
  border top(t = 0, 1) { x = 1 - t; y = 1; label = 1; }
  border left(t = 0, 1) { x = 0; y = 1 - t; label = 1; }
  border octagon(t = 0, 8) {
    x = 0.5 - 0.25 * sin(t * pi / 4);
    y = 0.25 + gap - 0.25 * cos(t * pi / 4);
    label = 2;
  }
  mesh Th = buildmesh(bottom(4) + right(2) + top(2) + left(2) + octagon(8), fixedborder = (fixed > 0));
  int[int] onBorder(Th.nv), onOctagon(Th.nv);
  onBorder = 0;
  onOctagon = 0;
  for (int e = 0; e < Th.nbe; e++)
    for (int k = 0; k < 2; k++) {
      onBorder[Th.be(e)[k]] = 1;
      if (Th.be(e).label == 2) onOctagon[Th.be(e)[k]] = 1;
    }
  int both = 0;
  for (int e = 0; e < Th.nbe; e++)
    if (Th.be(e).label == 1 && onOctagon[Th.be(e)[0]]) both++;
  cout << "gap " << gap << ", fixedborder=" << fixed << ": " << onBorder.sum << " points, "
       << both << " of the floor also of the octagon" << endl;
  return 0;
}
real[int] gaps = [0.015, 0.011];
for (int i = 0; i < gaps.n; i++)
  for (int fixed = 0; fixed < 2; fixed++) count(gaps[i], fixed);
END_OF_SCRIPT
FreeFem++ -nw -v 0 "$folder/border.edp" >"$folder/output" 2>&1
verdict "gap 0.015, fixedborder=0: 18 points, 0 of the floor also of the octagon
gap 0.015, fixedborder=1: 18 points, 0 of the floor also of the octagon
gap 0.011, fixedborder=0: 17 points, 1 of the floor also of the octagon
gap 0.011, fixedborder=1: 17 points, 1 of the floor also of the octagon"
