// Writes flows as VTK files for freefem_axi/ and particles/, and reads them for particles/picture/.
// Places are in [L], velocities in [L/T], pressures in [M/(L T^2)], in the units of the case; there
// is one number for each node, and nodes of triangles are counted from 0. When a file is written,
// lengths of lists are not checked and nothing is thrown. A file that cannot be read, is no such
// file or is cut short is an Error(kBadInput) with its path; that numbers are finite is not
// checked. A change must keep the names of the arrays and the order of the nodes, because the
// reader and users' pictures rely on them.
#include "viscontact/common/vtk/flow_vtk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viscontact/common/files/file.hpp"
#include "viscontact/common/vtk/vtk_xml.hpp"

namespace viscontact {
namespace {

// A quadratic triangle: the number of its nodes, and VTK's number of this type of cell.
constexpr std::size_t kNodes = 6;
constexpr std::uint8_t kQuadraticTriangle = 22;

/// Three numbers for each node: (a, b, 0) for a flow in the plane, and (a, 0, b) with `on_axis`,
/// where a is along x and b along the axis z of VTK.
std::vector<double> vectors_of(const std::vector<double>& a, const std::vector<double>& b,
                               bool on_axis) {
  std::vector<double> vectors;
  vectors.reserve(3 * a.size());
  for (std::size_t k = 0; k < a.size(); ++k)
    vectors.insert(vectors.end(), {a[k], on_axis ? 0 : b[k], on_axis ? b[k] : 0});
  return vectors;
}

/// The component d (0, 1 or 2) of each vector; `vectors` has three numbers for each.
std::vector<double> component(const std::vector<double>& vectors, std::size_t d) {
  std::vector<double> values;
  values.reserve(vectors.size() / 3);
  for (std::size_t i = d; i < vectors.size(); i += 3) values.push_back(vectors[i]);
  return values;
}

}  // namespace

/// The text of a VTK file of quadratic triangles, whose nodes have the arrays "velocity",
/// "pressure" and "speed" (the length of the velocity) in 64-bit numbers. If `more` is not empty,
/// its numbers, one for each node in any unit, become the array `more_name`. With `on_axis`, y of
/// `flow` is the axis z of VTK, and the file says so by the field "axisymmetric". A triangle has
/// six nodes in the order of VTK: its corners 0, 1, 2, and the middles of the sides 0-1, 1-2 and
/// 2-0.
std::string write_flow(const FlowField& flow, bool on_axis, std::string_view more_name,
                       const std::vector<double>& more) {
  std::vector<double> speeds;
  speeds.reserve(flow.x.size());
  for (std::size_t k = 0; k < flow.x.size(); ++k)
    speeds.push_back(std::hypot(flow.velocity_x[k], flow.velocity_y[k]));
  std::vector<std::int64_t> nodes, ends;
  for (const auto& triangle : flow.triangles) {
    nodes.insert(nodes.end(), triangle.begin(), triangle.end());
    ends.push_back(std::ssize(nodes));
  }
  const std::vector<std::uint8_t> types(flow.triangles.size(), kQuadraticTriangle);
  auto text = vtk_opening("UnstructuredGrid");
  text += "<UnstructuredGrid>\n";
  if (on_axis)
    text +=
        "<FieldData>\n<DataArray type=\"Int32\" Name=\"axisymmetric\" NumberOfTuples=\"1\" "
        "format=\"ascii\">1</DataArray>\n</FieldData>\n";
  text += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", flow.x.size(),
                      flow.triangles.size());
  text += "<PointData Scalars=\"speed\" Vectors=\"velocity\">\n";
  text += vtk_array("velocity", 3, vectors_of(flow.velocity_x, flow.velocity_y, on_axis));
  text += vtk_array("pressure", 1, flow.pressure);
  text += vtk_array("speed", 1, speeds);
  if (!more.empty()) text += vtk_array(more_name, 1, more);
  text += "</PointData>\n<Points>\n";
  text += vtk_array("Points", 3, vectors_of(flow.x, flow.y, on_axis));
  text += "</Points>\n<Cells>\n";
  text += vtk_array("connectivity", 1, nodes);
  text += vtk_array("offsets", 1, ends);
  text += vtk_array("types", 1, types);
  text += "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
  text += kVtkClosing;
  return text;
}

/// Reads a file of write_flow(). Throws Error(kBadInput) if it cannot be read, lacks an array, has
/// arrays of different lengths, other cells than quadratic triangles, or a triangle with a node
/// that does not exist.
FlowField read_flow(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  const VtkReader reader(text, path.string(), "flow");
  const std::size_t second = reader.has_array("FieldData", "axisymmetric") ? 2 : 1;
  const auto points = reader.array<double>("Points", "Points");
  const auto velocities = reader.array<double>("PointData", "velocity");
  FlowField flow;
  flow.pressure = reader.array<double>("PointData", "pressure");
  if (points.size() != 3 * flow.pressure.size() || velocities.size() != points.size())
    reader.refuse();
  flow.x = component(points, 0);
  flow.y = component(points, second);
  flow.velocity_x = component(velocities, 0);
  flow.velocity_y = component(velocities, second);
  const auto nodes = reader.array<std::int64_t>("Cells", "connectivity");
  const auto types = reader.array<std::uint8_t>("Cells", "types");
  if (nodes.size() != kNodes * types.size() ||
      std::ranges::any_of(types, [](auto type) { return type != kQuadraticTriangle; }))
    reader.refuse();
  flow.triangles.resize(nodes.size() / kNodes);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n] < 0 || nodes[n] >= std::ssize(flow.x)) reader.refuse();
    flow.triangles[n / kNodes][n % kNodes] = static_cast<std::int32_t>(nodes[n]);
  }
  return flow;
}

}  // namespace viscontact
