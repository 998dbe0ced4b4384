#!/bin/sh
# ParaView 5.11 of Debian 12 reads no .vtp file with raw appended data, the format that VTK's writers use
# if nothing else is asked for, since libexpat of Debian 12 was updated (2.5.0-1+deb12u2 and later): the
# parser meets the raw numbers, which are no XML, and the mesh is empty. With the libexpat of the first
# release (2.5.0-1+deb12u1) it reads the same file, and so does VTK 9.1 (python3-vtk9) of Debian 12 with
# either. A file with inline arrays is read by all.
# Packages: python3-paraview 5.11.0+dfsg-1+b1, libexpat1 2.5.0-1+deb12u5 (Debian 12). If they are not
# installed, they are installed in a minimal system of their own, which needs root, 3 GB and 5 minutes.
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages

cat >"$folder/write.py" <<'END'
"""write.py FOLDER: 100 points, with raw appended and with inline arrays."""
import base64
import struct
import sys

COUNT = 100
arrays = {"Points": struct.pack(f"<{3 * COUNT}d", *[0.1 * k for k in range(3 * COUNT)]),
          "connectivity": struct.pack(f"<{COUNT}q", *range(COUNT)),
          "offsets": struct.pack(f"<{COUNT}q", *range(1, COUNT + 1))}
for kind in ("appended", "inline"):
    appended, elements = b"", {}
    for name, numbers in arrays.items():
        data = struct.pack("<Q", len(numbers)) + numbers
        head = f'<DataArray type="{"Float64" if name == "Points" else "Int64"}" Name="{name}" NumberOfComponents="{3 if name == "Points" else 1}"'
        if kind == "inline":
            elements[name] = f'{head} format="binary">{base64.b64encode(data).decode()}</DataArray>'
        else:
            elements[name] = f'{head} format="appended" offset="{len(appended)}"/>'
            appended += data
    text = f"""<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<PolyData><Piece NumberOfPoints="{COUNT}" NumberOfVerts="{COUNT}">
<Points>{elements["Points"]}</Points>
<Verts>{elements["connectivity"]}{elements["offsets"]}</Verts>
</Piece></PolyData>
""".encode()
    if appended:
        text += b'<AppendedData encoding="raw">\n_' + appended + b"\n</AppendedData>\n"
    open(f"{sys.argv[1]}/{kind}.vtp", "wb").write(text + b"</VTKFile>\n")
END
cat >"$folder/read.py" <<'END'
"""read.py FOLDER: the numbers of points that ParaView reads."""
import sys

from paraview.simple import OpenDataFile

for kind in ("appended", "inline"):
    source = OpenDataFile(f"{sys.argv[1]}/{kind}.vtp")
    source.UpdatePipeline()
    print(f"{kind}: {source.GetDataInformation().GetNumberOfPoints()} points")
END

version() {
  dpkg-query -W -f '${Version}' "$1" 2>/dev/null || true
}
if [ "$(version python3-paraview)" = 5.11.0+dfsg-1+b1 ] && [ "$(version libexpat1)" = 2.5.0-1+deb12u5 ]; then
  /usr/bin/python3 "$folder/write.py" "$folder"
  pvpython "$folder/read.py" "$folder" >"$folder/output" 2>/dev/null
else
  [ "$(id -u)" -eq 0 ] || unavailable "ParaView is not installed, and only root can make a system for it"
  system=$folder/system
  ../scripts/make_debian bookworm "$system" >/dev/null 2>&1 || unavailable "no system can be made"
  ../scripts/in_debian "$system" sh -c 'apt-get update -qq && apt-get install -qq -y --no-install-recommends \
    python3-paraview=5.11.0+dfsg-1+b1 libexpat1=2.5.0-1+deb12u5' >/dev/null 2>&1 ||
    unavailable "python3-paraview 5.11.0+dfsg-1+b1 with libexpat1 2.5.0-1+deb12u5 cannot be had"
  cp "$folder/write.py" "$folder/read.py" "$system/tmp"
  ../scripts/in_debian "$system" python3 /tmp/write.py /tmp
  ../scripts/in_debian "$system" pvpython /tmp/read.py /tmp >"$folder/output" 2>/dev/null
fi
echo "$name: python3-paraview 5.11.0+dfsg-1+b1, libexpat1 2.5.0-1+deb12u5"
verdict "appended: 0 points
inline: 100 points"
