// Writes the opening. The labels 1 to 4 of a box are in the order of particles::SideVelocities.
#include "viscontact/freefem_flow/process/opening.hpp"

#include <fmt/format.h>

#include <array>
#include <cassert>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/particles/shapes/shape_contacts.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::BoxDomain;
using particles::CylinderDomain;
using particles::DiscDomain;
using particles::WallVelocity;

std::string words_of(std::span<const double> values) {
  std::string text;
  for (const double value : values) text += ' ' + format_number(value);
  return text;
}

/// The numbers and words of a shape with sides, which must be a rounded polygon or line: its extent
/// along its axis, its radius, and the corners of its core.
std::string rounded_polygon(const particles::Shape& shape) {
  const auto core = particles::core_of({shape});
  assert(!core.corners.empty());
  auto text = words_of(std::array{shape.at(0).point[0], core.radius}) +
              fmt::format(" rounded {}", core.corners.size());
  for (const auto& corner : core.corners) text += words_of(corner);
  return text;
}

/// A disc with centre and radius; a box with its lower left and upper right corners and 1 or 0 for
/// each axis, periodic or not; a cylinder with radius and height.
std::string domain_line(const particles::Domain& domain) {
  if (const auto* disc = std::get_if<DiscDomain>(&domain))
    return "domain disc" + words_of(std::array{disc->centre[0], disc->centre[1], disc->radius});
  if (const auto* box = std::get_if<BoxDomain>(&domain))
    return "domain box" + words_of(std::array{box->from[0], box->from[1], box->to[0], box->to[1]}) +
           (box->periodic[0] ? " 1" : " 0") + (box->periodic[1] ? " 1" : " 0");
  const auto& cylinder = std::get<CylinderDomain>(domain);
  return "domain cylinder" + words_of(std::array{cylinder.radius, cylinder.height});
}

/// The labels of the walls (mesh_boundary.hpp). Periodic sides of a box are no walls.
std::vector<int> walls_of(const particles::Domain& domain) {
  if (std::holds_alternative<DiscDomain>(domain)) return {1};
  if (std::holds_alternative<CylinderDomain>(domain)) return {1, 2, 3};
  const auto& box = std::get<BoxDomain>(domain);
  std::vector<int> labels;
  if (!box.periodic[0]) labels = {1, 2};
  if (!box.periodic[1]) labels.insert(labels.end(), {3, 4});
  return labels;
}

/// The eight coefficients of walls_at(). On a cylinder, x is the distance from the axis and y is z.
using WallCoefficients = std::array<double, 8>;

std::string wall_line(int label, const char* kind, const WallCoefficients& coefficients) {
  return fmt::format("{} {}{}\n", label, kind, words_of(coefficients));
}

/// Those of the side of a box with this label. They are 0 if the side is open, which means that
/// fluid flows through it freely.
WallCoefficients side_coefficients(int label, const WallVelocity& velocity,
                                   const particles::FlowStep& step) {
  assert(label >= 1 && label <= 4);
  const auto value = velocity.at(step.time, step.from, step.to);
  switch (velocity.kind) {
    case WallVelocity::Kind::kConstant:
      return {value[0], 0, 0, value[1]};
    case WallVelocity::Kind::kOpen:
      return {};
    case WallVelocity::Kind::kParabolic:
      break;
  }
  const double speed = value[0];  // along the inward normal
  const bool inward_is_positive = label == 1 || label == 3;
  WallCoefficients coefficients{};
  coefficients[label <= 2 ? 6 : 7] = inward_is_positive ? speed : -speed;
  return coefficients;
}

/// In a linear flow they are those of the gradient, and do not depend on the wall.
WallCoefficients wall_coefficients(const particles::Fluid& fluid, int label,
                                   const particles::FlowStep& step) {
  if (const auto* flow = std::get_if<particles::LinearFlow>(&fluid.boundary)) {
    const auto& g = flow->gradient;
    return {flow->at_origin[0], g[0], g[1], flow->at_origin[1], g[2], g[3], 0, 0};
  }
  const auto& sides = std::get<particles::SideVelocities>(fluid.boundary);
  return side_coefficients(label, sides[static_cast<std::size_t>(label - 1)], step);
}

bool is_open(const particles::Fluid& fluid, int label) {
  const auto* sides = std::get_if<particles::SideVelocities>(&fluid.boundary);
  return sides != nullptr &&
         (*sides)[static_cast<std::size_t>(label - 1)].kind == WallVelocity::Kind::kOpen;
}

/// Throws Error(kBadInput) if the domain is missing or does not fit the dimension or the boundary.
void check_domain(const particles::Fluid& fluid, const particles::Domain& domain, int dimension) {
  const bool on_axis = std::holds_alternative<CylinderDomain>(domain);
  if (std::holds_alternative<std::monostate>(domain))
    throw Error(ErrorKind::kBadInput,
                "the fluid has no domain; it must be a disc, a box or a cylinder");
  if (on_axis != (dimension == 1))
    throw Error(ErrorKind::kBadInput,
                "the domain of the fluid must be a cylinder if the particles are on an axis, and a "
                "disc or a box in the plane");
  if (std::holds_alternative<particles::SideVelocities>(fluid.boundary) &&
      !std::holds_alternative<BoxDomain>(domain))
    throw Error(ErrorKind::kBadInput,
                "velocities of single sides of the domain are given; the domain must be a box");
}

}  // namespace

std::string opening(const particles::Fluid& fluid, const particles::Domain& domain,
                    std::span<const particles::Shape> shapes, int dimension) {
  check_domain(fluid, domain, dimension);
  assert(fluid.cut_areas.empty() || fluid.cut_areas.size() >= shapes.size());
  const bool penalty = fluid.constraint == particles::RigidConstraint::kPenalty;
  std::string text = fmt::format(
      "viscontact-fluid {}\ndimension {}\nviscosity {}\nconstraint {}\nmesh {}\nedges {}\n",
      fluid.has_inertia() ? 3 : 2, dimension, format_number(fluid.viscosity),
      penalty ? "penalty " + format_number(fluid.penalty) : "rigid 0",
      fluid.mesh == particles::FluidMesh::kFitted ? "fitted" : "fixed", fluid.edges_per_particle);
  text += domain_line(domain) + '\n';

  const auto labels = walls_of(domain);
  const auto* flow = std::get_if<particles::LinearFlow>(&fluid.boundary);
  text += fmt::format("walls {}\n", labels.size());
  for (const int label : labels)
    text += wall_line(label, is_open(fluid, label) ? "open" : "moving",
                      wall_coefficients(fluid, label, {}));
  // If there are walls, their velocities contain the gradient.
  const bool mean_gradient = flow != nullptr && labels.empty();
  text += "gradient" + words_of(mean_gradient ? flow->gradient : std::array<double, 4>{}) + '\n';
  const bool are_round = std::ranges::all_of(shapes, &particles::Shape::is_round);
  const bool are_outlines =
      !fluid.cut_areas.empty() ||
      std::ranges::any_of(shapes, [](const auto& shape) { return shape.sides() > 0; });
  text += fmt::format("{} {}\n",
                      are_outlines ? "outlines"
                      : are_round  ? "particles"
                                   : "ellipses",
                      shapes.size());
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const auto& shape = shapes[k];
    if (shape.sides() > 0)
      text += rounded_polygon(shape);
    else if (are_round && !are_outlines)
      text += format_number(shape.bounding_radius());
    else
      text += words_of(shape.semi_axes());
    if (are_outlines && !fluid.cut_areas.empty() && fluid.cut_areas[k] > 0)
      text += " cut" + words_of(std::array{fluid.cut_areas[k]});
    else if (are_outlines && shape.sides() == 0)
      text += " ellipse";
    text += '\n';
  }
  if (fluid.has_inertia())
    text +=
        fmt::format("density {}\nadvection {}\n", format_number(fluid.density),
                    fluid.advection == particles::Advection::kCharacteristics ? "characteristics"
                                                                              : "semi_implicit");
  return text;
}

std::string gradient_request(const particles::Fluid& fluid) {
  if (fluid.has_inertia() || fluid.pressure_gradient == std::array<double, 2>{}) return "";
  return "pressure_gradient" + words_of(fluid.pressure_gradient) + '\n';
}

std::string walls_at(const particles::Fluid& fluid, const particles::Domain& domain,
                     const particles::FlowStep& step) {
  std::string text;
  for (const int label : walls_of(domain))
    text += words_of(wall_coefficients(fluid, label, step)) + '\n';
  return text;
}

}  // namespace viscontact::freefem_flow
