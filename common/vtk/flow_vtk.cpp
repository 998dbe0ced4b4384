// VTK files of flows.
#include "viscontact/common/vtk/flow_vtk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "viscontact/common/files/file.hpp"
#include "viscontact/common/vtk/vtk_xml.hpp"

namespace viscontact {
namespace {

constexpr std::size_t kNodes = 6;
constexpr std::uint8_t kQuadraticTriangle = 22;

/// (a, b, 0) for each node, and (a, 0, b) with `on_axis`.
std::vector<double> vectors_of(const std::vector<double>& a, const std::vector<double>& b,
                               bool on_axis) {
  assert(a.size() == b.size());
  std::vector<double> vectors;
  vectors.reserve(3 * a.size());
  for (std::size_t k = 0; k < a.size(); ++k)
    vectors.insert(vectors.end(), {a[k], on_axis ? 0 : b[k], on_axis ? b[k] : 0});
  return vectors;
}

/// The component d of each vector of three numbers.
std::vector<double> component(const std::vector<double>& vectors, std::size_t d) {
  assert(d < 3 && vectors.size() % 3 == 0);
  std::vector<double> values;
  values.reserve(vectors.size() / 3);
  for (std::size_t i = d; i < vectors.size(); i += 3) values.push_back(vectors[i]);
  return values;
}

}  // namespace

std::string write_flow(const FlowField& flow, bool on_axis, std::string_view more_name,
                       const std::vector<double>& more) {
  assert(flow.y.size() == flow.x.size() && flow.velocity_x.size() == flow.x.size());
  assert(flow.velocity_y.size() == flow.x.size() && flow.pressure.size() == flow.x.size());
  assert(more.empty() || more.size() == flow.x.size());
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
