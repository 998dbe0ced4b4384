#!/bin/sh
# meshio reads files of Gmsh by the ending .msh. When it writes a mesh to NAME.msh, the file is not one
# of Gmsh but one of ANSYS Fluent, which has no point data and no cell data. They are lost without a
# warning. file_format="gmsh" must be given.
# Packages: python3-meshio 5.0.0 (Debian 12, package 7.0.0-3) and 5.3.5 (Debian 13).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian python3-numpy 1:1.24.2-1+deb12u1 1:1.24.2-1 1:2.2.4+ds-1
debian python3-mdurl 0.1.2-1
debian python3-markdown-it 2.1.0-5 3.0.0-3
debian python3-rich 13.3.1-1 13.9.4-1
debian python3-meshio 7.0.0-3 7.0.0-really-5.3.5-6+deb13u1

python - "$folder" 2>/dev/null <<'END' | sed '/^$/d' >"$folder/output"
import sys

import meshio
import numpy as np

points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
mesh = meshio.Mesh(points, [("triangle", [[0, 1, 2]])], point_data={"speed": np.array([1.0, 2, 3])})
for name, options in (("default.msh", {}), ("gmsh.msh", {"file_format": "gmsh"})):
    path = f"{sys.argv[1]}/{name}"
    mesh.write(path, **options)
    print(name, "begins with", open(path, "rb").read(11), "and has", *meshio.read(path).point_data or ["no data"])
END
verdict "default.msh begins with b'(1 \"meshio ' and has no data
gmsh.msh begins with b'\$MeshFormat' and has speed gmsh:dim_tags"
