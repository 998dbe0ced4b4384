// Reads the meshes and the flow that scripts/pictures.idp prints, and writes them for ParaView.
#include "viscontact/freefem_axi/row_picture.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>

#include "viscontact/common/error.hpp"
#include "viscontact/freefem_axi/motion_row.hpp"

namespace viscontact::freefem_axi {
namespace {

/// Reads the meshes in the output of FreeFEM, one after the other, in the format of pictures.idp.
class PictureReader {
 public:
  explicit PictureReader(const std::string& output) : stream_(output) {}

  /// Each node has `columns` numbers, >= 2: its distance rho from the axis, its height z, and
  /// values. `fields` gets a vector over the nodes for each value. Throws Error(kExternalProgram)
  /// if a number is missing, not finite or out of range.
  QuadraticMesh read_mesh(std::size_t columns, std::vector<std::vector<double>>& fields,
                          std::vector<BoundaryEdge>& boundary) {
    assert(columns >= 2);
    std::string line;
    while (std::getline(stream_, line) && !line.starts_with("viscontact-mesh ")) {
    }
    std::istringstream head(line);
    std::string word;
    head >> word;
    QuadraticMesh mesh;
    const auto nodes = size_from(head);
    mesh.x.resize(nodes);
    mesh.y.resize(nodes);
    mesh.triangles.resize(size_from(head));
    boundary.resize(size_from(head));
    fields.assign(columns - 2, std::vector<double>(nodes));
    for (std::size_t i = 0; i < nodes; ++i) {
      mesh.x[i] = number();
      mesh.y[i] = number();
      for (auto& field : fields) field[i] = number();
    }
    // FreeFEM's node 3 + i is the middle of the side opposite to corner i; QuadraticMesh lists the
    // middles of the sides 0-1, 1-2 and 2-0.
    for (auto& triangle : mesh.triangles)
      for (const std::size_t place : {0, 1, 2, 4, 5, 3})
        triangle.at(place) = static_cast<std::int32_t>(node_below(nodes));
    for (auto& edge : boundary) {
      edge.kind = boundary_kind();
      for (auto& node : edge.nodes) node = node_below(nodes);
    }
    return mesh;
  }

 private:
  [[noreturn]] static void fail() {
    throw Error(ErrorKind::kExternalProgram,
                "the mesh and flow that FreeFEM wrote for a picture are incomplete");
  }
  static std::size_t size_from(std::istream& stream) {
    // A larger number comes from a damaged line, and would exhaust the memory. Any limit far above
    // the number of nodes for which FreeFEM can solve (some 1e5) works.
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
    // The words that pictures.idp writes, in the order of BoundaryKind.
    constexpr std::array kWords = {"wall", "sphere", "axis", "shear_free", "interface"};
    std::string word;
    stream_ >> word;
    const auto found = std::ranges::find(kWords, word);
    if (found == kWords.end()) fail();
    return static_cast<BoundaryKind>(found - kWords.begin());
  }
  std::size_t node_below(std::size_t nodes) {
    std::size_t node = 0;
    if (!(stream_ >> node) || node >= nodes) fail();
    return node;
  }

  std::istringstream stream_;
};

/// The factors from FreeFEM's units to those of the case, for the velocities u_rho and u_z, the
/// pressure and the last column: the stream function for the approach, u_phi for other motions.
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
  constexpr std::size_t kColumns = 6;  // rho, z and the four that factors_of_approach() scales
  std::vector<std::vector<double>> fields;
  static_cast<QuadraticMesh&>(picture.flow) = reader.read_mesh(kColumns, fields, picture.boundary);
  const auto factors = approaches ? factors_of_approach(tabulation, reference_velocity)
                                  : factors_of_motion(tabulation, motion, reference_velocity);
  for (std::size_t k = 0; k < fields.size(); ++k)
    for (double& value : fields[k]) value *= factors.at(k);
  picture.flow.velocity_x = std::move(fields[0]);
  picture.flow.velocity_y = std::move(fields[1]);
  picture.flow.pressure = std::move(fields[2]);
  (approaches ? picture.stream_function : picture.azimuthal_velocity) = std::move(fields[3]);
  std::vector<BoundaryEdge> boundary;
  picture.coarsest = reader.read_mesh(2, fields, boundary);
  return picture;
}

std::string write_vtu(const RowPicture& picture) {
  return picture.azimuthal_velocity.empty()
             ? write_flow(picture.flow, false, "stream_function", picture.stream_function)
             : write_flow(picture.flow, false, "azimuthal_velocity", picture.azimuthal_velocity);
}

}  // namespace viscontact::freefem_axi
