// Reads [domain], [fluid] and [[probe]].
#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <system_error>

#include "viscontact/particle_runs/case/particles_sections.hpp"

namespace viscontact::particles {

namespace {

void disc_keys(case_file::Keys& keys, DiscDomain& disc) {
  keys.optional("centre", vector(disc.centre, 2), {"centre of the circle", "`[0.0, 0.0]`"});
  keys.required("radius", case_file::number(disc.radius, kModeratelyPositive),
                {"radius of the circle"});
}

/// `dimension` is 2 or 3.
void box_keys(case_file::Keys& keys, BoxDomain& box, int dimension) {
  Vector from{}, to{};
  const auto axes = static_cast<std::size_t>(dimension);
  keys.required("from", vector(from, dimension), {"corner with the smallest coordinates"});
  keys.required("to", vector(to, dimension), {"corner with the largest coordinates"});
  for (std::size_t d = 0; d < axes; ++d) {
    keys.require(to[d] - from[d] >= 1 / kLargestNumber, "to",
                 "contains {}; it must be greater than {}, the same coordinate of from", to[d],
                 from[d]);
    box.from[d] = from[d];
    box.to[d] = to[d];
  }
  const auto read_periodic = [&](const case_file::TomlSection& section, std::string_view key) {
    const auto periodic = section.truths(key, axes);
    for (std::size_t d = 0; d < axes; ++d) box.periodic[d] = periodic[d];
  };
  keys.optional("periodic", case_file::custom("such as `[true, false]`", read_periodic),
                {"whether the two sides across x are joined, those across y, and those across z",
                 "false along each axis"});
}

void cylinder_keys(case_file::Keys& keys, CylinderDomain& cylinder) {
  keys.required("radius", case_file::number(cylinder.radius, kModeratelyPositive),
                {"radius of the cylinder"});
  keys.required("height", case_file::number(cylinder.height, kModeratelyPositive),
                {"height of the lid; the floor is at z = 0"});
}

template <class Shape, void (*declaration)(case_file::Keys&, Shape&)>
void read_shape(const case_file::TomlSection& section, std::string_view key, Domain& domain) {
  case_file::read_keys(section.section(key), declaration, domain.emplace<Shape>());
}

/// The corners of a box have 3 coordinates if the dimension is 3, otherwise 2.
void read_box(const case_file::TomlSection& section, std::string_view key, Domain& domain,
              int dimension) {
  case_file::read_keys(section.section(key), box_keys, domain.emplace<BoxDomain>(),
                       dimension == 3 ? 3 : 2);
}

void domain_keys(case_file::Keys& keys, Domain& domain, int dimension) {
  keys.optional(
      "disc", case_file::custom("`{ centre, radius }`", read_shape<DiscDomain, disc_keys>, domain),
      {"the inside of a circle, for discs. Its wall has the number -1"});
  keys.optional("box", case_file::custom("`{ from, to, periodic }`", read_box, domain, dimension),
                {"a rectangle between two corners, for discs, or a cuboid, for spheres. Its walls "
                 "have the numbers -1, -2, ... in the order left, right (across x), bottom, top "
                 "(across y), for spheres left, right, front, back (across y), bottom, top (across "
                 "z); periodic sides have no number"});
  keys.optional(
      "cylinder",
      case_file::custom("`{ radius, height }`", read_shape<CylinderDomain, cylinder_keys>, domain),
      {"a closed cylinder, for spheres on its axis. Its walls have the numbers -1 (side), -2 "
       "(floor) and -3 (lid)"});
}

/// Throws Error(kBadInput) unless [domain] has exactly one shape, which belongs to the dimension of
/// the case (1: spheres on an axis, 2 or 3).
void check_shape(const case_file::TomlSection& section, int dimension) {
  // The shapes with the dimensions of their cases; a box may have 2 or 3.
  const std::array kShapes = {std::pair("disc", 2),
                              std::pair("box", dimension == 1 ? 2 : dimension),
                              std::pair("cylinder", 1)};
  const std::pair<const char*, int>* given = nullptr;
  for (const auto& shape : kShapes) {
    if (!section.has(shape.first)) continue;
    if (given != nullptr)
      section.fail(shape.first, "must be left out, because {} is given; a case has one domain",
                   given->first);
    given = &shape;
  }
  section.finish();
  if (given == nullptr)
    section.fail(dimension == 1 ? "cylinder" : "box",
                 "is missing; [domain] must have one of disc, box and cylinder");
  section.require(given->second == dimension, given->first,
                  "belongs to a case with dimension {}, but space.dimension is {}; {}",
                  given->second == 1 ? "\"axisymmetric\"" : "2",
                  dimension == 1 ? "\"axisymmetric\"" : std::to_string(dimension),
                  dimension == 3 ? "it must be a box = { from, to, periodic }"
                  : dimension == 1
                      ? "it must be a cylinder = { radius, height }"
                      : "it must be a disc = { centre, radius } or a box = { from, to, periodic }");
}

// At the lower bound velocities have rounding errors of about 1e-16/penalty = 1e-4 (fluid.hpp).
constexpr Allowed kPenalty = {[](double v) { return v >= 1e-12 && v <= 1; }, "from 1e-12 to 1"};
constexpr Allowed kGap = {[](double v) { return v >= 0 && v <= kLargestNumber; },
                          "from 0 to 1e100"};

// In the order of SideVelocities.
constexpr std::array kSides = {"left", "right", "bottom", "top"};

/// Axis of the normal of a side: 0 for left and right, 1 for bottom and top.
std::size_t axis_of(std::size_t side) { return side / 2; }

void side_keys(case_file::Keys& keys, WallVelocity& wall) {
  // pieces() keeps references to these numbers, so that they are static. kNoEnd: the pieces of time
  // need not cover the run, because the last one is extended below.
  static const int kAlong = 1, kInPlane = 2;
  static const double kNoEnd = 0;
  const bool is_parabola =
      keys.optional("parabolic", pieces(wall.pieces, kAlong, kNoEnd),
                    {"largest speed of a parabola along the side, into the box",
                     "one of both is required", "a number, or pieces"});
  const bool is_constant = keys.optional(
      "constant", pieces(wall.pieces, kInPlane, kNoEnd),
      {"velocity of the whole side", "one of both is required", "`[u, v]`, or pieces"});
  keys.require(is_parabola != is_constant, "parabolic",
               "and constant exclude each other; a table of a side must have one of them");
  keys.optional("period", case_file::number(wall.period, kModeratelyPositiveOr0),
                {"if it is > 0, the velocity is multiplied by 1 + `amplitude` sin(2 pi "
                 "t/`period`); needs `density`"});
  keys.optional("amplitude", case_file::number(wall.amplitude, kModerate), {"see `period`"});
  keys.require(wall.period > 0 || !keys.has("amplitude"), "amplitude",
               "has no effect without a period > 0");
  if (!keys.reads()) return;
  wall.kind = is_parabola ? WallVelocity::Kind::kParabolic : WallVelocity::Kind::kConstant;
  auto& pieces = wall.pieces.pieces;
  if (pieces.empty()) return;
  pieces.back().until = std::numeric_limits<double>::max();
  if (pieces.size() > 1) return;
  wall.value = {pieces.front().value[0], pieces.front().value[1]};
  pieces.clear();
}

/// Reads a velocity [L/T], "open", or a table.
void read_side(const case_file::TomlSection& section, std::string_view side, WallVelocity& wall) {
  if (section.is_text(side) && section.text(side) == "open") {
    wall.kind = WallVelocity::Kind::kOpen;
  } else if (section.is_table(side)) {
    case_file::read_keys(section.section(side), side_keys, wall);
  } else if (section.is_array(side)) {
    Vector velocity;
    read_vector(section, side, velocity, 2);
    wall.value = {velocity[0], velocity[1]};
  } else {
    section.fail(side,
                 "is {}; it must be a velocity [u, v], \"open\", or a table {{ parabolic = SPEED "
                 "}} or {{ constant = VELOCITY }}",
                 section.shown(side));
  }
}

/// The flux into the box through a side at time 0 [L^2/T], < 0 if fluid leaves the box. It is 0 for
/// an open side, whose flux is not given. `side` counts in the order of kSides from 0.
double influx(const BoxDomain& box, std::size_t side, const WallVelocity& of_side) {
  assert(side < kSides.size());
  WallVelocity wall = of_side;
  wall.value = of_side.at(0);
  const auto axis = axis_of(side);
  const double length = box.to[1 - axis] - box.from[1 - axis];
  // The mean of a parabola that is 0 at both ends is two thirds of its largest value.
  if (wall.kind == WallVelocity::Kind::kParabolic) return 2.0 / 3 * wall.value[0] * length;
  if (wall.kind == WallVelocity::Kind::kOpen) return 0;
  const bool is_first = side % 2 == 0;
  return (is_first ? wall.value[axis] : -wall.value[axis]) * length;
}

/// True if fluid may ever flow through the side, whose normal is along `axis` (0: x, 1: y).
bool brings_fluid(const WallVelocity& wall, std::size_t axis) {
  if (wall.kind != WallVelocity::Kind::kConstant) return true;
  return wall.value[axis] != 0 || std::ranges::any_of(wall.pieces.pieces, [&](const auto& piece) {
           return piece.value[axis] != 0;
         });
}

struct VelocityKeys {
  std::optional<double> shear_rate, strain_rate;  // [1/T]
  SideVelocities sides;
  std::array<bool, 4> has_side{};
};

void velocity_keys(case_file::Keys& keys, VelocityKeys& velocity) {
  keys.optional("shear_rate", case_file::number(velocity.shear_rate, kModerate),
                {"s: the velocity of the walls is (s y, 0)"});
  keys.optional("strain_rate", case_file::number(velocity.strain_rate, kModerate),
                {"s: the velocity of the walls is (s x, -s y)"});
  for (std::size_t side = 0; side < kSides.size(); ++side)
    velocity.has_side[side] = keys.optional(
        kSides[side],
        case_file::custom("`[u, v]`, `{ parabolic = SPEED }`, another table (below) or `\"open\"`",
                          read_side, velocity.sides[side]),
        {"velocity of this side of a box: constant, a parabola into the box with its largest speed "
         "in the middle, or open (no stress acts there)",
         "at rest"});
}

/// Throws Error(kBadInput) if a velocity of a side is given in a domain that is no box, or for a
/// periodic side, and if no side is open although the fluxes through all sides do not add up to 0
/// or depend on time. `section` is the table fluid.velocity.
void check_sides(const case_file::TomlSection& fluid, const case_file::TomlSection& section,
                 const VelocityKeys& velocity, const Domain& domain) {
  const auto* box = std::get_if<BoxDomain>(&domain);
  bool any_open = false, any_changes = false;
  double net = 0, sum = 0;
  for (std::size_t side = 0; side < kSides.size(); ++side) {
    if (!velocity.has_side[side]) continue;
    if (box == nullptr)
      section.fail(kSides[side],
                   "belongs to a box; in a disc the velocity must be { shear_rate = NUMBER } or { "
                   "strain_rate = NUMBER }");
    section.require(!box->periodic[axis_of(side)], kSides[side],
                    "must be left out, because domain.box.periodic makes this side periodic along "
                    "{}, so that it is no wall",
                    axis_of(side) == 0 ? "x" : "y");
    const auto& wall = velocity.sides[side];
    any_open = any_open || wall.kind == WallVelocity::Kind::kOpen;
    any_changes = any_changes || (wall.depends_on_time() && brings_fluid(wall, axis_of(side)));
    net += influx(*box, side, wall);
    sum += std::abs(influx(*box, side, wall));
  }
  fluid.require(any_open || !any_changes, "velocity",
                "has a flux into the domain that depends on time; a side must be \"open\", because "
                "the fluid is incompressible");
  // Relative error of a net flux that users balance with rounded numbers.
  constexpr double kRounding = 1e-9;
  fluid.require(any_open || std::abs(net) <= kRounding * sum, "velocity",
                "gives a net flux of {:.6g} into the domain; it must be 0, because the fluid is "
                "incompressible and no side is \"open\"",
                net);
}

/// Throws Error(kBadInput) if the velocity that belongs to `key` (a shear, if `is_shear`, or a
/// strain) is not the same on both sides of a period. In a domain that is periodic both ways any
/// gradient is allowed, because there it is the mean gradient. With a period along x only, a shear
/// is allowed, because its velocity (shear_rate y, 0) does not depend on x.
void check_periods(const case_file::TomlSection& section, const char* key, bool is_shear,
                   const Domain& domain) {
  const auto* box = std::get_if<BoxDomain>(&domain);
  if (box == nullptr || box->periodic[0] == box->periodic[1]) return;
  if (is_shear && box->periodic[0]) return;
  section.fail(key,
               "does not fit a box that is periodic along {} only, because the velocity {} of its "
               "walls is not the same on both sides of the period; {}",
               box->periodic[0] ? "x" : "y", is_shear ? "(s y, 0)" : "(s x, -s y)",
               is_shear ? "the box may be periodic along x, both ways or not at all"
                        : "the box may be periodic both ways or not at all");
}

void read_velocity(const case_file::TomlSection& fluid, std::string_view key, const Domain& domain,
                   Fluid& result) {
  fluid.require(!std::holds_alternative<CylinderDomain>(domain), key,
                "must be left out, because the walls of a cylinder are at rest");
  const auto section = fluid.section(key);
  VelocityKeys velocity;
  case_file::read_keys(section, velocity_keys, velocity);
  const auto& [shear, strain, sides, has_side] = velocity;
  const char* rate = shear ? "shear_rate" : "strain_rate";
  const bool any_side = std::ranges::count(has_side, true) > 0;
  section.require(!(shear && strain), "strain_rate",
                  "must be left out, because shear_rate is given");
  section.require(!((shear || strain) && any_side), rate,
                  "must be left out, because the velocities of single sides are given");
  if (any_side) {
    check_sides(fluid, section, velocity, domain);
    result.boundary = sides;
    return;
  }
  if (shear || strain) check_periods(section, rate, shear.has_value(), domain);
  LinearFlow flow;
  if (shear) flow.gradient[1] = *shear;
  if (strain) flow.gradient = {*strain, 0, 0, -*strain};
  result.boundary = flow;
}

void gradient_keys(case_file::Keys& keys, Fluid& fluid) {
  Vector value{};
  keys.required("value", vector(value, 2), {"the mean of the pressure gradient"});
  fluid.pressure_gradient = {value[0], value[1]};
  keys.required("period", case_file::number(fluid.gradient_period, kModeratelyPositive),
                {"the gradient is `value` times 1 + `amplitude` sin(2 pi t/`period`)"});
  keys.required("amplitude", case_file::number(fluid.gradient_amplitude, kModerate),
                {"see `period`"});
}

void read_pressure_gradient(const case_file::TomlSection& section, std::string_view key,
                            Fluid& fluid) {
  if (section.is_table(key)) {
    case_file::read_keys(section.section(key), gradient_keys, fluid);
    return;
  }
  Vector vector;
  read_vector(section, key, vector, 2);
  fluid.pressure_gradient = {vector[0], vector[1]};
}

void inertia_keys(case_file::Keys& keys, Fluid& fluid) {
  keys.optional("density", case_file::number(fluid.density, kModeratelyPositiveOr0),
                {"rho_f of a fluid [with inertia](fluid.md#inertia-of-the-fluid); 0: Stokes flow"});
  keys.optional(
      "advection",
      case_file::one_of(fluid.advection, {{"semi_implicit", Advection::kSemiImplicit},
                                          {"characteristics", Advection::kCharacteristics}}),
      {"how the fluid carries its velocity along: in the linear problem, with the velocity "
       "extrapolated from the steps before, or by the lecture's characteristics"});
  keys.optional(
      "start",
      case_file::one_of(fluid.start, {{"rest", FlowStart::kRest}, {"stokes", FlowStart::kStokes}}),
      {"the flow at time 0: at rest, or the Stokes flow around particles that move without "
       "inertia, and therefore must have no `velocity`"});
  keys.optional(
      "pressure_gradient",
      case_file::custom("`[NUMBER, NUMBER]`, or `{ value, period, amplitude }`",
                        read_pressure_gradient, fluid),
      {"uniform pressure gradient that is added. It drives the fluid, and the particles in "
       "it, along a period of a box, or in a box with an open side. With a period it "
       "pulsates, which needs `density`",
       "0"});
  for (const auto* key : {"advection", "start"})
    keys.require(fluid.density > 0 || !keys.has(key), key,
                 "has no effect on Stokes flow; fluid.density must be > 0");
}

/// Throws Error(kBadInput) if there is a pressure gradient that moves nothing, because the pressure
/// of closed walls or of a cell of Stokes flow balances it, or one that the solver does not know.
void check_gradient(case_file::Keys& keys, const Fluid& fluid, const Domain& domain) {
  constexpr auto kKey = "pressure_gradient";
  if (!keys.reads() || !keys.has(kKey)) return;
  const auto* box = std::get_if<BoxDomain>(&domain);
  keys.require(
      box != nullptr, kKey,
      "has no effect in a closed {}, whose walls balance it; it belongs to a box, and must "
      "be left out",
      std::holds_alternative<CylinderDomain>(domain) ? "cylinder" : "disc");
  keys.require(fluid.solver.empty(), kKey,
               "is not known to fluid.solver, a program of your own; it must be left out");
  keys.require(fluid.density > 0 || !(fluid.gradient_period > 0), kKey,
               "depends on time, which Stokes flow does not know; fluid.density must be > 0");
  keys.require(fluid.density > 0 || !box->periodic[0] || !box->periodic[1], kKey,
               "has no effect on Stokes flow in a box that is periodic both ways, because the mean "
               "velocity there is 0; it must be left out, or fluid.density be > 0");
  const auto* sides = std::get_if<SideVelocities>(&fluid.boundary);
  const bool is_open = sides != nullptr && std::ranges::any_of(*sides, [](const auto& side) {
                         return side.kind == WallVelocity::Kind::kOpen;
                       });
  for (const std::size_t d : {0U, 1U}) {
    const char* axis = d == 0 ? "x" : "y";
    keys.require(is_open || box->periodic[d] || fluid.pressure_gradient[d] == 0, kKey,
                 "is {:.6g} along {}, where it has no effect, because closed walls balance it; it "
                 "must be 0 along {}, unless the box is periodic there or a side is open",
                 fluid.pressure_gradient[d], axis, axis);
  }
}

/// Throws Error(kBadInput) if velocities depend on time although the density is 0, and if a fluid
/// with a density > 0 has a solver of the user's own, or a shear or strain of a box that is
/// periodic along x and y.
void check_inertia(case_file::Keys& keys, const Fluid& fluid, const Domain& domain) {
  const auto* sides = std::get_if<SideVelocities>(&fluid.boundary);
  const bool depends_on_time =
      sides != nullptr &&
      std::ranges::any_of(*sides, [](const auto& side) { return side.depends_on_time(); });
  keys.require(fluid.density > 0 || !depends_on_time, "velocity",
               "depends on time, which Stokes flow does not know; fluid.density must be > 0");
  if (!(fluid.density > 0)) return;
  keys.require(fluid.solver.empty(), "solver",
               "is a program of your own, which computes Stokes flow; it must be left out if "
               "fluid.density is > 0");
  const auto* box = std::get_if<BoxDomain>(&domain);
  const auto* flow = std::get_if<LinearFlow>(&fluid.boundary);
  keys.require(box == nullptr || !box->periodic[0] || !box->periodic[1] || flow == nullptr ||
                   flow->gradient == decltype(flow->gradient){},
               "velocity",
               "shears or strains a box that is periodic both ways, whose cell keeps its shape; "
               "with fluid.density > 0 the box must have walls, or be at rest");
}

void fluid_keys(case_file::Keys& keys, Fluid& fluid, const Domain& domain) {
  keys.required("viscosity", case_file::number(fluid.viscosity, kModeratelyPositive),
                {"dynamic viscosity mu"});
  inertia_keys(keys, fluid);
  keys.optional(
      "constraint",
      case_file::one_of(fluid.constraint, {{"penalty", RigidConstraint::kPenalty},
                                           {"rigid", RigidConstraint::kRigid}}),
      {"a particle is a very viscous fluid, or the motions of the particles are unknowns"});
  keys.optional("penalty", case_file::number(fluid.penalty, kPenalty),
                {"epsilon of (6.1) in "
                 "[physics.md](physics.md#6-fluid-around-particles-freefem_flow-immersed), "
                 "used with `constraint = \"penalty\"`; with bodies or links at least 1e-10"});
  keys.optional(
      "mesh",
      case_file::one_of(fluid.mesh, {{"fitted", FluidMesh::kFitted}, {"fixed", FluidMesh::kFixed}}),
      {"whether the mesh follows the particles, with curved edges, or does not know them (not with "
       "`constraint = \"rigid\"`)"});
  keys.require(fluid.mesh != FluidMesh::kFixed || fluid.constraint != RigidConstraint::kRigid,
               "mesh",
               "is 'fixed'; it must be \"fitted\" with constraint = \"rigid\", because the "
               "velocity of a rigid body can be set only at nodes on its surface");
  keys.optional("edges_per_particle", case_file::count(fluid.edges_per_particle, 6, 400),
                {"edges of the mesh on the circumference of the smallest particle"});
  keys.optional("coupling",
                case_file::one_of(fluid.coupling, {{"constrained", Coupling::kConstrained},
                                                   {"splitting", Coupling::kSplitting}}),
                {"contact forces act in the problem of the fluid, or the velocities that the fluid "
                 "gives are projected (masses must be > 0)"});
  keys.optional("threshold_gap", case_file::number(fluid.threshold_gap, kGap),
                {"gap at which contact is made. Rough solids touch at the gap 2 `roughness`: a "
                 "smaller value is an error, and the default is at least this gap",
                 "0.05 of the smallest radius or semi-axis, or half of the smallest gap at the "
                 "start if this is smaller"});
  keys.optional("solver", case_file::texts(fluid.solver),
                {"command of a [fluid solver of your own](fluid-solver.md) in place of FreeFEM. A "
                 "text with the name of a file is relative to the case file; a first text without "
                 "a slash is a program on PATH"});
  keys.require(
      fluid.solver.empty() || !fluid.solver.front().empty(), "solver",
      "begins with an empty text; it must be a list with the name of a program and its arguments");
  keys.optional("velocity", case_file::custom("a table, see below", read_velocity, domain, fluid),
                {"velocity of the walls", "at rest"});
  check_inertia(keys, fluid, domain);
  check_gradient(keys, fluid, domain);
}

}  // namespace

Domain read_domain(const case_file::TomlSection& section, int dimension) {
  Domain domain;
  check_shape(section, dimension);
  case_file::read_keys(section, domain_keys, domain, dimension);
  return domain;
}

Fluid read_fluid(const case_file::TomlSection& section, const Domain& domain) {
  Fluid fluid;
  case_file::read_keys(section, fluid_keys, fluid, domain);
  return fluid;
}

namespace {

/// When keys are read, `domain` must be a box.
void probe_keys(case_file::Keys& keys, Probe& probe, const Domain& domain) {
  keys.required("name", case_file::text(probe.name),
                {"in `probes.csv`: letters, digits, `_` and `-`; no two are equal"});
  keys.require(std::ranges::all_of(probe.name,
                                   [](char c) {
                                     return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                                            (c >= '0' && c <= '9') || c == '_' || c == '-';
                                   }) &&
                   (!keys.reads() || !probe.name.empty()),
               "name", "is '{}'; it must consist of letters, digits, _ and -", probe.name);
  Vector from{}, to{};
  keys.required("from", vector(from, 2), {"a point on a wall of the box"});
  keys.required(
      "to", vector(to, 2),
      {"a point on another wall. A flow to the right of the way from `from` to `to` is positive"});
  probe.from = {from[0], from[1]};
  probe.to = {to[0], to[1]};
  if (!keys.reads()) return;
  const auto* box = std::get_if<BoxDomain>(&domain);
  assert(box != nullptr);
  // The walls of the box that a point is on, as bits 0 to 3 in the order of SideVelocities; a
  // corner is on two of them. Periodic sides do not count.
  const auto sides_of = [&](const std::array<double, 2>& x) {
    unsigned sides = 0;
    for (std::size_t d = 0; d < 2; ++d) {
      const double length = box->to[d] - box->from[d], other = box->to[1 - d] - box->from[1 - d];
      constexpr double kRounding = 1e-9;  // far above rounding errors
      const bool is_beside = x[1 - d] < box->from[1 - d] - kRounding * other ||
                             x[1 - d] > box->to[1 - d] + kRounding * other;
      if (box->periodic[d] || is_beside) continue;
      if (std::abs(x[d] - box->from[d]) <= kRounding * length) sides |= 1U << (2 * d);
      if (std::abs(x[d] - box->to[d]) <= kRounding * length) sides |= 2U << (2 * d);
    }
    return sides;
  };
  const auto first = sides_of(probe.from), second = sides_of(probe.to);
  keys.require(first != 0, "from", "is ({}, {}), which is on no wall of the box; it must be on one",
               from[0], from[1]);
  keys.require(second != 0, "to", "is ({}, {}), which is on no wall of the box; it must be on one",
               to[0], to[1]);
  keys.require(
      (first & second) == 0, "to",
      "is ({}, {}), on the same wall as from; the line must go across the channel, from one "
      "wall to another",
      to[0], to[1]);
}

}  // namespace

void read_probes(const case_file::TomlSection& root, const Domain& domain,
                 std::optional<Fluid>& fluid) {
  if (!root.has("probe")) return;
  for (const auto& section : root.sections("probe")) {
    section.require(fluid.has_value(), "name",
                    "belongs to a case with a fluid; the case has no section [fluid]");
    section.require(std::holds_alternative<BoxDomain>(domain), "name",
                    "belongs to a channel; the domain must be a box");
    section.require(fluid->solver.empty(), "name",
                    "needs FreeFEM; fluid.solver must be left out in a case with probes");
    section.require(
        !root.has("membrane"), "name",
        "must be left out, because the case has membranes, beside which nothing is probed");
    Probe probe;
    case_file::read_keys(section, probe_keys, probe, domain);
    for (const auto& other : fluid->probes)
      section.require(other.name != probe.name, "name", "is '{}', the name of another probe",
                      probe.name);
    fluid->probes.push_back(std::move(probe));
  }
}

std::vector<case_file::KeyTable> domain_and_fluid_tables() {
  return {case_file::describe_keys("[domain]", domain_keys, 2),
          case_file::describe_keys("domain.disc", disc_keys),
          case_file::describe_keys("domain.box", box_keys, 2),
          case_file::describe_keys("domain.cylinder", cylinder_keys),
          case_file::describe_keys("[fluid] of particles", fluid_keys, {}),
          case_file::describe_keys("fluid.velocity", velocity_keys),
          case_file::describe_keys("fluid.velocity, a table of a side", side_keys),
          case_file::describe_keys("fluid.pressure_gradient", gradient_keys),
          case_file::describe_keys("[[probe]]", probe_keys, Domain{})};
}

std::vector<std::string> with_absolute_files(std::vector<std::string> command,
                                             const std::filesystem::path& folder) {
  for (auto& word : command) {
    const bool is_name_of_program =
        &word == &command.front() && word.find('/') == std::string::npos;
    const auto file = std::filesystem::absolute(folder) / word;
    std::error_code ignored;
    if (!is_name_of_program && std::filesystem::is_regular_file(file, ignored))
      word = file.lexically_normal().string();
  }
  return command;
}

}  // namespace viscontact::particles
