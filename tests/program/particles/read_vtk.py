"""Reads a .pvd, .vtp or .vtu file by VTK and prints what is in it, a line for each thing."""
import sys
import xml.etree.ElementTree as xml

from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader


def show(name, array):
    values = [array.GetTuple(k) for k in range(array.GetNumberOfTuples())]
    print(name, " ".join(repr(float(x)) for row in values for x in row))


if sys.argv[1].endswith(".pvd"):
    for data in xml.parse(sys.argv[1]).getroot().iter("DataSet"):
        print(data.get("timestep"), data.get("file"))
    sys.exit()
xml.parse(sys.argv[1])  # the file is XML
is_flow = sys.argv[1].endswith(".vtu")
reader = vtkXMLUnstructuredGridReader() if is_flow else vtkXMLPolyDataReader()
reader.SetFileName(sys.argv[1])
reader.Update()
if reader.GetErrorCode():
    sys.exit("VTK cannot read it")
data = reader.GetOutput()
show("points", data.GetPoints().GetData())
if data.GetCellData().GetArray("kind"):
    for name in ("kind", "id", "force"):
        show(name, data.GetCellData().GetArray(name))
    sys.exit()
for name in ("velocity", "pressure") if is_flow else ("radius", "velocity", "id"):
    show(name, data.GetPointData().GetArray(name))
for name in () if is_flow else ("gap", "gamma", "i", "j"):
    show(name, data.GetCellData().GetArray(name))
for group, names in ((data.GetPointData(), ("body", "angle")), (data.GetCellData(), ("friction",))):
    for name in names:
        if group.GetArray(name):
            show(name, group.GetArray(name))
if is_flow:
    sizes = vtkCellSizeFilter()
    sizes.SetInputData(data)
    sizes.Update()
    show("areas", sizes.GetOutput().GetCellData().GetArray("Area"))
for k in range(data.GetNumberOfCells()):
    cell = data.GetCell(k)
    points = range(cell.GetNumberOfPoints())
    print("cell", cell.GetClassName(), *(cell.GetPointId(p) for p in points))
