// Checks particles in a fluid before the fluid solver starts (fluid_start.hpp). Lengths are in the
// unit of the case.
#include "viscontact/case_file/fluid/fluid_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <variant>

#include "viscontact/common/error.hpp"

namespace viscontact::case_file {
namespace {

using particles::WallVelocity;
using particles::operator-;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators

/// Smallest gap that the fitted mesh resolves, divided by the radius of the smaller particle.
constexpr double kLeastGapOfMesh = 1e-3;

/// Gap at which the solids of rough particles touch [L]; 0 for smooth ones.
double gap_of_solids(const ParticlesCase& c) {
  return 2 * c.setting.laws.film.roughness.value_or(0);
}

/// True if each side of the domain is open or periodic, and at least one is open.
bool has_only_open_sides(const ParticlesCase& c) {
  const auto* box = std::get_if<particles::BoxDomain>(&c.setting.domain);
  const auto* sides = std::get_if<particles::SideVelocities>(&c.setting.fluid->boundary);
  if (box == nullptr || sides == nullptr) return false;
  bool any_open = false;
  for (std::size_t side = 0; side < sides->size(); ++side) {
    if (box->periodic[side / 2]) continue;
    if ((*sides)[side].kind != WallVelocity::Kind::kOpen) return false;
    any_open = true;
  }
  return any_open;
}

/// True if the body is an obstacle or a particle whose motion is given, which no impulse moves.
bool is_driven(const ParticlesCase& c, std::int32_t body) {
  return body < 0 || c.setting.given_motions.contains(body);
}

/// Checks rigid bodies and links in a fluid.
void check_bodies(const TomlSection& root, const ParticlesCase& c, const ParticleNames& names) {
  const auto& p = c.particles;
  if (c.setting.fluid->coupling == particles::Coupling::kSplitting &&
      !(p.bodies.empty() && c.setting.links.empty()))
    root.section("fluid").fail(
        "coupling",
        "is 'splitting', which does not know rigid bodies and links; it must "
        "be \"constrained\"");
  for (std::size_t b = 0; b < p.bodies.count(); ++b) {
    const auto& body = p.bodies.bodies[b];
    const auto masses = particles::member_masses(body, p);
    double least = 0;
    for (std::size_t m = 0; m < masses.size(); ++m) {
      least += masses[m] * particles::dot(body.offsets[m], body.offsets[m]);
      const auto k = particles::index_of(body.members[m]);
      for (std::size_t n = 0; n < m; ++n) {
        const auto other = particles::index_of(body.members[n]);
        const double gap =
            particles::norm(p.position(k) - p.position(other)) - p.radii[k] - p.radii[other];
        const double needed = kLeastGapOfMesh * std::min(p.radii[k], p.radii[other]);
        if (gap < needed)
          throw_bad_input(names.at(k),
                          fmt::format("{} and {} have a gap of {:.3g}; in a fluid the particles of "
                                      "a body must keep a gap of at least a thousandth of the "
                                      "smaller radius, {:.3g}, because the mesh has fluid between "
                                      "them",
                                      names(other), names(k), gap, needed));
      }
    }
    if (body.inertia[8] < least)
      root.sections("body")[b].fail(
          "moment_of_inertia",
          fmt::format("is {}; in a fluid it must be at least that of the masses of the body's "
                      "particles at their centres, {:.6g}",
                      body.inertia[8], least));
  }
  for (std::size_t a = 0; a < c.setting.links.arms.size(); ++a) {
    const auto& arm = c.setting.links.arms[a];
    const double r1 = p.radii[particles::index_of(arm.first)],
                 r2 = p.radii[particles::index_of(arm.second)];
    const double least = r1 + r2 + kLeastGapOfMesh * std::min(r1, r2);
    if (const double shortest = particles::least_length(arm.length, c.end_time); shortest < least)
      root.sections("arm")[a].fail(
          "length", fmt::format("becomes {:.9g}; in a fluid it must leave a gap of at least a "
                                "thousandth of the smaller radius and be at least {:.9g}",
                                shortest, least));
  }
}

void check_masses(const TomlSection& root, const ParticlesCase& c, const ParticleNames& names) {
  if (c.setting.fluid->coupling != particles::Coupling::kSplitting) return;
  for (std::size_t k = 0; k < c.particles.count(); ++k)
    if (c.particles.masses[k] == 0 && !is_driven(c, static_cast<std::int32_t>(k)))
      root.section("fluid").fail(
          "coupling",
          fmt::format("is 'splitting', which needs masses > 0, because the velocities are "
                      "projected in the norm of the masses, but the mass of {} is 0; it must be "
                      "\"constrained\", or the particle must have a mass",
                      names(k)));
}

/// Throws an error if the fitted mesh cannot resolve the gap between a sphere on the axis and the
/// side of its cylinder.
void check_side_of_cylinder(const ParticlesCase& c, const ParticleNames& names) {
  const auto* cylinder = std::get_if<particles::CylinderDomain>(&c.setting.domain);
  if (cylinder == nullptr || c.setting.fluid->mesh != particles::FluidMesh::kFitted) return;
  for (std::size_t k = 0; k < c.particles.count(); ++k) {
    const double radius = c.particles.radii[k], gap = cylinder->radius - radius;
    if (gap < kLeastGapOfMesh * radius)
      throw_bad_input(names.at(k),
                      fmt::format("{} has a gap of {:.3g} to the side of the cylinder, which the "
                                  "mesh does not resolve; it must be at least a thousandth of the "
                                  "radius, {:.3g}",
                                  names(k), gap, kLeastGapOfMesh * radius));
  }
}

/// A mean flow deforms the lattice of images, but the cell of this version keeps its shape.
void check_mean_flow(const TomlSection& root, const ParticlesCase& c) {
  const auto* box = std::get_if<particles::BoxDomain>(&c.setting.domain);
  const auto* flow = std::get_if<particles::LinearFlow>(&c.setting.fluid->boundary);
  if (box == nullptr || !box->periodic[0] || !box->periodic[1] || flow == nullptr ||
      flow->gradient == decltype(flow->gradient){})
    return;
  if (c.setting.fluid->mesh == particles::FluidMesh::kFixed)
    root.section("fluid").fail("mesh",
                               "is 'fixed'; it must be \"fitted\" in a box that is periodic both "
                               "ways and sheared or strained, because a particle that the fixed "
                               "mesh cuts has a different velocity on the other side");
  constexpr double kRounding = 1e-9;
  if (c.end_time > (1 + kRounding) * c.setting.time_step)
    root.section("viscous_contact")
        .fail("end_time",
              fmt::format("is {}; it must be at most time_step, {}, in a box that is periodic both "
                          "ways and sheared or strained, because the cell of this version keeps "
                          "its shape and gives instantaneous velocities only",
                          c.end_time, c.setting.time_step));
}

/// An arrangement must be accepted or refused whatever its seed.
void check_arrangement(const TomlSection& root, const ParticlesCase& c) {
  if (!c.arrangement) return;
  const auto& fluid = *c.setting.fluid;
  const double gap = c.arrangement->smallest_gap;
  const double least = kLeastGapOfMesh * c.arrangement->radius;
  if (root.section("fluid").has("threshold_gap") && gap < fluid.threshold_gap)
    root.section("arrangement")
        .fail("smallest_gap",
              fmt::format("is {}; it must be at least fluid.threshold_gap, {}, at which contact is "
                          "made",
                          gap, fluid.threshold_gap));
  if (const double solid = gap_of_solids(c); gap < solid)
    root.section("arrangement")
        .fail("smallest_gap",
              fmt::format("is {}; it must be at least twice "
                          "viscous_contact.roughness, {}, at which the solids touch",
                          gap, solid));
  if (fluid.mesh == particles::FluidMesh::kFitted && gap < least)
    root.section("arrangement")
        .fail("smallest_gap", fmt::format("is {}; it must be at least a thousandth of the radius, "
                                          "{:.3g}, which the mesh resolves",
                                          gap, least));
}

void check_gap(const ParticlesCase& c, const ParticleNames& names, const StartGap& at) {
  const auto& fluid = *c.setting.fluid;
  const auto& p = c.particles;
  const auto j = particles::index_of(at.second);
  const bool is_pair = at.first >= 0;
  const double radius =
      is_pair ? std::min(p.radii[particles::index_of(at.first)], p.radii[j]) : p.radii[j];
  const auto other = is_pair ? names(particles::index_of(at.first))
                             : obstacle_name(c, static_cast<std::size_t>(-1 - at.first));
  const bool is_plane = !is_pair && other.starts_with("plane");
  if (fluid.mesh == particles::FluidMesh::kFitted && !is_plane && at.gap < kLeastGapOfMesh * radius)
    throw_bad_input(
        names.at(j),
        fmt::format("{} and {} have a gap of {:.3g} at the start, which the mesh does not resolve; "
                    "it must be at least a thousandth of the smaller radius, {:.3g}",
                    other, names(j), at.gap, kLeastGapOfMesh * radius));
  const double allowed = c.setting.solver.tolerance * particles::mean_radius(p);
  if (at.gap < fluid.threshold_gap - allowed &&
      !(is_driven(c, at.first) && is_driven(c, at.second)))
    throw_bad_input(
        names.at(j),
        fmt::format("{} and {} have a gap of {:.3g} at the start, less than fluid.threshold_gap, "
                    "{:.3g}, at which contact is made; the gap must be larger or {} smaller",
                    other, names(j), at.gap, fluid.threshold_gap,
                    fluid.threshold_gap > gap_of_solids(c) ? "fluid.threshold_gap"
                                                           : "viscous_contact.roughness"));
}

/// Largest limit up to `asked` [L] for which gaps_at_start() can find all gaps.
double limit_within_periods(const ParticlesCase& c, double asked) {
  const double diameter = 2 * std::ranges::max(c.particles.radii);
  // A little less, because close_pairs_in_period() needs sums of extents below the period.
  constexpr double kLess = 0.999;
  for (const double period : particles::periods_of(c.setting.domain))
    if (period > 0) asked = std::min(asked, kLess * (period - diameter));
  return asked;
}

/// Bodies and links are held by forces that are found from velocities of the fluid, and these have
/// rounding errors of about 1e-15/penalty (particles/fluid/fluid_motion.hpp). Seven touching discs
/// of a body were held with penalties down to 3e-11; with 1e-11 the errors were taken for
/// constraints that contradict each other.
void check_penalty(const TomlSection& root, const ParticlesCase& c) {
  constexpr double kLeast = 1e-10;
  const auto& fluid = *c.setting.fluid;
  const auto has_members = [](const auto& body) { return body.members.size() > 1; };
  if (fluid.constraint != particles::RigidConstraint::kPenalty || fluid.penalty >= kLeast ||
      (c.setting.links.empty() && std::ranges::none_of(c.particles.bodies.bodies, has_members)))
    return;
  root.section("fluid").fail(
      "penalty",
      fmt::format("is {}; in a case with bodies or links it must be at least {}, because "
                  "the forces that hold them follow from velocities with rounding errors "
                  "of 1e-15/penalty. constraint = \"rigid\" has no penalty",
                  fluid.penalty, kLeast));
}

}  // namespace

void set_default_threshold_gap(ParticlesCase& c) {
  constexpr double kOfRadius = 0.05;
  const double longest = kOfRadius * std::ranges::min(c.particles.radii);
  double threshold = longest;
  for (const double period : particles::periods_of(c.setting.domain))
    if (period > 0)
      threshold = std::min(threshold, (period - 2 * std::ranges::max(c.particles.radii)) / 2);
  for (const auto& at : gaps_at_start(c, limit_within_periods(c, 2 * longest)))
    threshold = std::min(threshold, std::max(0.0, at.gap) / 2);
  c.setting.fluid->threshold_gap = std::max(threshold, gap_of_solids(c));
}

void check_fluid_start(const TomlSection& root, const ParticlesCase& c,
                       const ParticleLines& lines) {
  const ParticleNames names(c, lines);
  if (has_only_open_sides(c) && c.setting.given_motions.empty())
    root.section("fluid").fail(
        "velocity",
        "makes each side open that is not periodic, so that nothing balances the forces on the "
        "particles; at least one side must be a wall, or the motion of a particle must be given");
  check_mean_flow(root, c);
  if (const double solid = gap_of_solids(c); c.setting.fluid->threshold_gap < solid)
    root.section("fluid").fail(
        "threshold_gap",
        fmt::format("is {}; it must be at least twice viscous_contact.roughness, {}, because the "
                    "solids touch at that gap",
                    c.setting.fluid->threshold_gap, solid));
  check_arrangement(root, c);
  check_penalty(root, c);
  check_bodies(root, c, names);
  check_masses(root, c, names);
  check_side_of_cylinder(c, names);
  const double limit = std::max(c.setting.fluid->threshold_gap,
                                kLeastGapOfMesh * std::ranges::max(c.particles.radii));
  for (const auto& at : gaps_at_start(c, limit_within_periods(c, limit))) check_gap(c, names, at);
}

}  // namespace viscontact::case_file
