#!/bin/sh
# VTK's reader of .vtp files has GetErrorCode(), 0 if there was no error. A file with an array of too few
# numbers is no small error: the reader prints messages and returns a mesh without any point, although
# the points themselves are whole. The code stays 0, so that a script that checks it goes on with
# nothing; it is 0 for a missing file, too. An observer of errors must be added, or the number of points be
# compared.
# Packages: python3-vtk9 9.1.0 (Debian 12) and 9.3.0 (Debian 13).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian python3-vtk9 9.1.0+really9.1.0+dfsg2-5+deb12u1 9.1.0+really9.1.0+dfsg2-5 9.3.0+dfsg1-4+b1
python -c 'import vtkmodules.vtkIOXML' 2>/dev/null || unavailable "the libraries of VTK are not installed"

python - "$folder" >"$folder/output" 2>/dev/null <<'END'
import sys

from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

TEXT = """<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<PolyData><Piece NumberOfPoints="2" NumberOfVerts="2">
<PointData><DataArray type="Float64" Name="radius" format="ascii">{}</DataArray></PointData>
<Points><DataArray type="Float64" Name="Points" NumberOfComponents="3" format="ascii">0 0 0 1 0 0</DataArray></Points>
<Verts><DataArray type="Int64" Name="connectivity" format="ascii">0 1</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">1 2</DataArray></Verts>
</Piece></PolyData></VTKFile>"""


def read(name, text=None):
    path = f"{sys.argv[1]}/{name}.vtp"
    if text:
        open(path, "w").write(text)
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    print(f"{name}: {reader.GetOutput().GetNumberOfPoints()} points, error code {reader.GetErrorCode()}")


read("whole", TEXT.format("1 2"))
read("short", TEXT.format("1"))
read("missing")
END
verdict "whole: 2 points, error code 0
short: 0 points, error code 0
missing: 0 points, error code 0"
