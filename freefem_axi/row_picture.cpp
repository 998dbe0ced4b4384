// Reads the meshes and the flow that scripts/pictures.idp prints, and writes them for ParaView.
// Units are those of row_picture.hpp.
#include "viscontact/freefem_axi/row_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <sstream>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/freefem_axi/motions/motion_row.hpp"

namespace viscontact::freefem_axi {
namespace {

/// Reads the meshes that pictures.idp writes.
class PictureReader {
 public:
  explicit PictureReader(const std::string& output) : stream_(output) {}

  /// Reads the next mesh, with `columns` numbers for each node. The numbers after (rho, z) are
  /// stored in `fields`.
  CurvedMesh read_mesh(std::size_t columns, std::vector<std::vector<double>>& fields) {
    std::string line;
    while (std::getline(stream_, line) && !line.starts_with("viscontact-mesh ")) {
    }
    std::istringstream head(line);
    std::string word;
    head >> word;
    CurvedMesh mesh;
    mesh.nodes.resize(size_from(head));
    mesh.triangles.resize(size_from(head));
    mesh.boundary.resize(size_from(head));
    fields.assign(columns - 2, std::vector<double>(mesh.nodes.size()));
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
      for (double& coordinate : mesh.nodes[i]) coordinate = number();
      for (auto& field : fields) field[i] = number();
    }
    for (auto& triangle : mesh.triangles)
      for (auto& node : triangle) node = node_of(mesh);
    for (auto& edge : mesh.boundary) {
      edge.kind = boundary_kind();
      for (auto& node : edge.nodes) node = node_of(mesh);
    }
    return mesh;
  }

 private:
  [[noreturn]] static void fail() {
    throw Error(ErrorKind::kExternalProgram,
                "the mesh and flow that FreeFEM wrote for a picture are incomplete");
  }
  static std::size_t size_from(std::istream& stream) {
    // A larger number can only come from a damaged line; it would exhaust the memory.
    constexpr std::size_t kLargest = 100'000'000;
    std::size_t size = 0;
    if (!(stream >> size) || size > kLargest) fail();
    return size;
  }
  double number() {
    double value = 0;
    if (!(stream_ >> value) || !std::isfinite(value)) fail();
    return value;
  }
  BoundaryKind boundary_kind() {
    // In the order of BoundaryKind.
    constexpr std::array kWords = {"wall", "sphere", "axis", "shear_free", "interface"};
    std::string word;
    stream_ >> word;
    const auto found = std::ranges::find(kWords, word);
    if (found == kWords.end()) fail();
    return static_cast<BoundaryKind>(found - kWords.begin());
  }
  std::size_t node_of(const CurvedMesh& mesh) {
    std::size_t node = 0;
    if (!(stream_ >> node) || node >= mesh.nodes.size()) fail();
    return node;
  }

  std::istringstream stream_;
};

template <class Write>
std::string data_array(std::string_view attributes, std::size_t count, const Write& write) {
  std::string text = fmt::format("<DataArray {} format=\"ascii\">\n", attributes);
  for (std::size_t i = 0; i < count; ++i) text += write(i) + "\n";
  return text + "</DataArray>\n";
}

/// What velocities, pressure and the last column of FreeFEM are multiplied by.
std::array<double, 4> factors_of_approach(const Tabulation& tabulation, double velocity) {
  const auto scale = solve_scale(tabulation, velocity);
  return {scale.speed, scale.speed, scale.viscosity * scale.speed, scale.speed};
}
std::array<double, 4> factors_of_motion(const Tabulation& tabulation,
                                        lubrication::MotionKind motion, double velocity) {
  const double length = motion == lubrication::MotionKind::kSlide ? 1 : tabulation.radius;
  const double speed = velocity * length;
  return {speed, speed, tabulation.viscosity * speed / tabulation.radius, speed};
}

/// The output of FreeFEM for a motion across the axis or around it.
std::string picture_of_motion(const FreeFem& freefem, const Tabulation& tabulation,
                              lubrication::MotionKind motion, double gap) {
  const bool spins = motion == lubrication::MotionKind::kSpin;
  const char* solution = motion == lubrication::MotionKind::kRoll ? "2" : "1";
  std::string output;
  (void)solve_motions(freefem, tabulation, spins ? MotionGroup::kAround : MotionGroup::kAcross, gap,
                      {"-picture", solution}, &output);
  return output;
}

}  // namespace

RowPicture solve_row_for_picture(const FreeFem& freefem, const Tabulation& tabulation, double gap,
                                 double reference_velocity, lubrication::MotionKind motion) {
  RowPicture picture;
  picture.motion = motion;
  picture.gap = gap;
  picture.reference_velocity = reference_velocity;
  const bool approaches = motion == lubrication::MotionKind::kApproach;
  std::string output;
  if (approaches)
    (void)solve_row(freefem, tabulation, gap, reference_velocity, {"-picture", "1"}, &output);
  else
    output = picture_of_motion(freefem, tabulation, motion, gap);
  PictureReader reader(output);
  constexpr std::size_t kColumns = 6;
  std::vector<std::vector<double>> fields;
  picture.flow.mesh = reader.read_mesh(kColumns, fields);
  const auto factors = approaches ? factors_of_approach(tabulation, reference_velocity)
                                  : factors_of_motion(tabulation, motion, reference_velocity);
  for (std::size_t k = 0; k < fields.size(); ++k)
    for (double& value : fields[k]) value *= factors.at(k);
  picture.flow.velocity.resize(fields[0].size());
  for (std::size_t i = 0; i < fields[0].size(); ++i)
    picture.flow.velocity[i] = {fields[0][i], fields[1][i]};
  picture.flow.pressure = std::move(fields[2]);
  (approaches ? picture.flow.stream_function : picture.flow.azimuthal_velocity) =
      std::move(fields[3]);
  picture.coarsest = reader.read_mesh(2, fields);
  return picture;
}

std::string write_vtu(const Flow& flow) {
  constexpr int kQuadraticTriangle = 22;  // number of this cell type in VTK
  constexpr std::size_t kNodes = 6;
  const auto& mesh = flow.mesh;
  const auto at_point = [&](const std::vector<double>& field) {
    return [&field](std::size_t i) { return format_number(field[i]); };
  };
  const auto vector = [&](const std::vector<std::array<double, 2>>& field) {
    return [&field](std::size_t i) {
      return format_number(field[i][0]) + " " + format_number(field[i][1]) + " 0";
    };
  };
  const std::size_t points = mesh.nodes.size(), cells = mesh.triangles.size();
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
      points, cells);
  text += "<PointData Scalars=\"pressure\" Vectors=\"velocity\">\n";
  text += data_array(R"(type="Float64" Name="velocity" NumberOfComponents="3")", points,
                     vector(flow.velocity));
  text += data_array(R"(type="Float64" Name="pressure")", points, at_point(flow.pressure));
  const bool is_axisymmetric = flow.azimuthal_velocity.empty();
  text += data_array(fmt::format(R"(type="Float64" Name="{}")",
                                 is_axisymmetric ? "stream_function" : "azimuthal_velocity"),
                     points,
                     at_point(is_axisymmetric ? flow.stream_function : flow.azimuthal_velocity));
  text += "</PointData>\n<Points>\n";
  text += data_array(R"(type="Float64" NumberOfComponents="3")", points, vector(mesh.nodes));
  text += "</Points>\n<Cells>\n";
  text += data_array(R"(type="Int64" Name="connectivity")", cells, [&](std::size_t i) {
    // The mid-side nodes of VTK are in the order of the sides, those of CurvedMesh in the order of
    // the opposite vertices.
    const auto& [v0, v1, v2, m0, m1, m2] = mesh.triangles[i];
    return fmt::format("{} {} {} {} {} {}", v0, v1, v2, m2, m0, m1);
  });
  text += data_array(R"(type="Int64" Name="offsets")", cells,
                     [](std::size_t i) { return std::to_string((i + 1) * kNodes); });
  text += data_array(R"(type="UInt8" Name="types")", cells,
                     [](std::size_t) { return std::to_string(kQuadraticTriangle); });
  return text + "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace viscontact::freefem_axi
