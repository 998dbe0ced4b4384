// Reads [fluid] (fluid_section.hpp). Lengths, masses and times are in the units of the case. A
// change must keep the keys and their defaults, because users have written cases with them.
#include "viscontact/case_file/fluid/fluid_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "viscontact/case_file/vector_values.hpp"
#include "viscontact/common/named.hpp"

namespace viscontact::case_file {

using particles::BoxDomain;
using particles::Fluid;
using particles::WallVelocity;

namespace {

constexpr Allowed kPenalty = {[](double v) { return v >= 1e-12 && v <= 1; }, "from 1e-12 to 1"};
constexpr Allowed kGap = {[](double v) { return v >= 0 && v <= kLargestNumber; },
                          "from 0 to 1e100"};

/// A word that a key may have, and what it means.
template <class Meaning>
struct Word {
  const char* name;
  Meaning meaning;
};
template <class Meaning>
Word(const char*, Meaning) -> Word<Meaning>;  // clang 14 does not find it by itself

constexpr std::array kConstraints = {Word{"penalty", particles::RigidConstraint::kPenalty},
                                     Word{"rigid", particles::RigidConstraint::kRigid}};
constexpr std::array kMeshes = {Word{"fitted", particles::FluidMesh::kFitted},
                                Word{"fixed", particles::FluidMesh::kFixed}};
constexpr std::array kCouplings = {Word{"constrained", particles::Coupling::kConstrained},
                                   Word{"splitting", particles::Coupling::kSplitting}};

/// Reads the meaning of a word if the key exists.
template <class Words, class Meaning>
void read_word(const TomlSection& section, std::string_view key, const Words& words,
               Meaning& meaning) {
  if (!section.has(key)) return;
  const auto text = section.text(key);
  const auto* word = find_named(words, text);
  if (word == nullptr)
    section.fail(key, fmt::format("is '{}'; it must be \"{}\"", text, names_of(words, "\" or \"")));
  meaning = word->meaning;
}

// Sides of a box in the order of SideVelocities.
constexpr std::array kSides = {"left", "right", "bottom", "top"};

/// Axis along which a side is displaced from the opposite side: 0 for left and right, else 1.
std::size_t axis_of(std::size_t side) { return side / 2; }

WallVelocity read_side(const TomlSection& section, const char* side) {
  WallVelocity wall;
  if (section.is_text(side) && section.text(side) == "open") {
    wall.kind = WallVelocity::Kind::kOpen;
  } else if (section.is_table(side)) {
    const auto table = section.section(side);
    wall.kind = WallVelocity::Kind::kParabolic;
    wall.value[0] = table.number("parabolic", kModerate);
    table.finish();
  } else if (section.is_array(side)) {
    const auto velocity = read_vector(section, side, 2);
    wall.value = {velocity[0], velocity[1]};
  } else {
    section.fail(side, fmt::format("is {}; it must be a velocity [u, v], \"open\", or a table {{ "
                                   "parabolic = SPEED }}",
                                   section.shown(side)));
  }
  return wall;
}

/// Flux into the box through a side [L^2/T]; 0 for an open side.
double influx(const BoxDomain& box, std::size_t side, const WallVelocity& wall) {
  const auto axis = axis_of(side);
  const double length = box.to[1 - axis] - box.from[1 - axis];
  // The mean of a parabola that is 0 at both ends is two thirds of its largest value.
  if (wall.kind == WallVelocity::Kind::kParabolic) return 2.0 / 3 * wall.value[0] * length;
  if (wall.kind == WallVelocity::Kind::kOpen) return 0;
  const bool is_first = side % 2 == 0;
  return (is_first ? wall.value[axis] : -wall.value[axis]) * length;
}

/// Reads the entries of single sides, of which at least one exists.
particles::SideVelocities read_sides(const TomlSection& fluid, const TomlSection& section,
                                     const particles::Domain& domain) {
  const auto* box = std::get_if<BoxDomain>(&domain);
  particles::SideVelocities sides;
  bool any_open = false;
  double net = 0, sum = 0;
  for (std::size_t side = 0; side < kSides.size(); ++side) {
    if (!section.has(kSides[side])) continue;
    if (box == nullptr)
      section.fail(kSides[side],
                   "belongs to a box; in a disc the velocity must be { shear_rate = NUMBER } or { "
                   "strain_rate = NUMBER }");
    if (box->periodic[axis_of(side)])
      section.fail(kSides[side],
                   fmt::format("must be left out, because domain.box.periodic makes this side "
                               "periodic along {}, so that it is no wall",
                               axis_of(side) == 0 ? "x" : "y"));
    sides[side] = read_side(section, kSides[side]);
    any_open = any_open || sides[side].kind == WallVelocity::Kind::kOpen;
    net += influx(*box, side, sides[side]);
    sum += std::abs(influx(*box, side, sides[side]));
  }
  // Fluxes that users compute from rounded numbers balance to about as many digits as these have.
  if (constexpr double kRounding = 1e-9; !any_open && std::abs(net) > kRounding * sum)
    fluid.fail("velocity",
               fmt::format("gives a net flux of {:.6g} into the domain; it must be 0, because the "
                           "fluid is incompressible and no side is \"open\"",
                           net));
  return sides;
}

/// Throws an error if the velocity that belongs to `key` is not the same on both sides of a period.
/// A domain that is periodic both ways takes any gradient as its mean, and a shear u = s y has the
/// period of x.
void check_periods(const TomlSection& section, const char* key, bool is_shear,
                   const particles::Domain& domain) {
  const auto* box = std::get_if<BoxDomain>(&domain);
  if (box == nullptr || box->periodic[0] == box->periodic[1]) return;
  if (is_shear && box->periodic[0]) return;
  section.fail(
      key, fmt::format("does not fit a box that is periodic along {} only, because the velocity "
                       "{} of its walls is not the same on both sides of the period; {}",
                       box->periodic[0] ? "x" : "y", is_shear ? "(s y, 0)" : "(s x, -s y)",
                       is_shear ? "the box may be periodic along x, both ways or not at all"
                                : "the box may be periodic both ways or not at all"));
}

void read_velocity(const TomlSection& fluid, const particles::Domain& domain, Fluid& result) {
  if (std::holds_alternative<particles::CylinderDomain>(domain))
    fluid.fail("velocity", "must be left out, because the walls of a cylinder are at rest");
  const auto section = fluid.section("velocity");
  const bool shear = section.has("shear_rate"), strain = section.has("strain_rate");
  // All sides are asked for, because finish() takes the other keys for unknown ones.
  const bool any_side =
      std::ranges::count_if(kSides, [&](const char* side) { return section.has(side); }) > 0;
  if (shear && strain) section.fail("strain_rate", "must be left out, because shear_rate is given");
  if ((shear || strain) && any_side)
    section.fail(shear ? "shear_rate" : "strain_rate",
                 "must be left out, because the velocities of single sides are given");
  section.finish();
  if (any_side) {
    result.boundary = read_sides(fluid, section, domain);
    return;
  }
  particles::LinearFlow flow;
  if (shear) flow.gradient[1] = section.number("shear_rate", kModerate);
  if (strain) {
    const double rate = section.number("strain_rate", kModerate);
    flow.gradient = {rate, 0, 0, -rate};
  }
  if (shear || strain) check_periods(section, shear ? "shear_rate" : "strain_rate", shear, domain);
  result.boundary = flow;
}

}  // namespace

Fluid read_fluid(const TomlSection& section, const particles::Domain& domain) {
  Fluid fluid;
  fluid.viscosity = section.number("viscosity", kModeratelyPositive);
  if (section.has("density")) fluid.density = section.number("density", kNotNegative);
  if (fluid.density > 0)
    section.fail("density",
                 fmt::format("is {}; it must be 0, because this version computes Stokes flow, in "
                             "which the fluid has no inertia. Flow with a density is for a later "
                             "version",
                             fluid.density));
  read_word(section, "constraint", kConstraints, fluid.constraint);
  if (section.has("penalty")) fluid.penalty = section.number("penalty", kPenalty);
  read_word(section, "mesh", kMeshes, fluid.mesh);
  if (fluid.mesh == particles::FluidMesh::kFixed &&
      fluid.constraint == particles::RigidConstraint::kRigid)
    section.fail("mesh",
                 "is 'fixed'; it must be \"fitted\" with constraint = \"rigid\", because "
                 "the velocity of a rigid body can be set only at nodes on its surface");
  if (section.has("edges_per_particle"))
    fluid.edges_per_particle = section.count("edges_per_particle", 6, 400);
  read_word(section, "coupling", kCouplings, fluid.coupling);
  if (section.has("threshold_gap")) fluid.threshold_gap = section.number("threshold_gap", kGap);
  if (section.has("solver")) {
    fluid.solver = section.texts("solver");
    if (fluid.solver.front().empty())
      section.fail("solver",
                   "begins with an empty text; it must be a list with the name of a "
                   "program and its arguments");
  }
  if (section.has("velocity")) read_velocity(section, domain, fluid);
  section.finish();
  return fluid;
}

}  // namespace viscontact::case_file
