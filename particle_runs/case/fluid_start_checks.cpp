// Checks whether the flow around the particles at the start can be computed, and the default of
// fluid.threshold_gap.
#include <algorithm>
#include <cassert>
#include <numbers>
#include <numeric>
#include <variant>

#include "viscontact/common/error.hpp"
#include "viscontact/particle_runs/case/particles_sections.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/setting/chords.hpp"
#include "viscontact/particles/shapes/shape_contacts.hpp"

namespace viscontact::particles {
namespace {

/// Free choices of the checks and of the default of the threshold gap.
struct FluidStartTuning {
  // Smallest gap that the fitted mesh (FluidMesh::kFitted) resolves, divided by the radius of the
  // smaller particle; docs/fluid.md repeats it. The narrower a gap, the more edges the mesh needs.
  static constexpr double kLeastGapOfMesh = 1e-3;
  static constexpr double kDegree = std::numbers::pi / 180;
  // The least angle of an arc between two overlaps, and the least angle of fluid between two
  // circles. docs/fluid.md and the messages repeat both.
  static constexpr double kLeastArc = 1 * kDegree, kLeastWedge = 20 * kDegree;
  // Relative difference of numbers that count as equal, far above rounding errors.
  static constexpr double kRounding = 1e-9;
  // The limit of gaps_at_start() over the period minus the diameter, which must be less than 1.
  static constexpr double kLess = 0.999;
  // The least penalty that holds bodies and links. The forces that hold them are computed from
  // velocities of the fluid, which have rounding errors of about 1e-15/penalty. The limit is
  // measured: a body of seven touching discs was held with penalties down to 3e-11; with 1e-11 the
  // step failed with constraints that seemed to contradict each other.
  static constexpr double kLeastPenalty = 1e-10;
  // The default of the threshold gap over the smallest radius, unless particles are closer to each
  // other. A change alters results of cases without the key.
  static constexpr double kOfRadius = 0.05;
};

/// The gap [L] at which the solids of rough particles touch, which is twice their roughness; 0 for
/// smooth particles.
double gap_of_solids(const ParticlesCase& c) {
  return 2 * c.setting.laws.film.roughness.value_or(0);
}

/// True if each side of the domain is open or periodic, and at least one is open.
bool has_only_open_sides(const ParticlesCase& c) {
  const auto* box = std::get_if<BoxDomain>(&c.setting.domain);
  const auto* sides = std::get_if<SideVelocities>(&c.setting.fluid->boundary);
  if (box == nullptr || sides == nullptr) return false;
  bool any_open = false;
  for (std::size_t side = 0; side < sides->size(); ++side) {
    if (box->periodic[side / 2]) continue;
    if ((*sides)[side].kind != WallVelocity::Kind::kOpen) return false;
    any_open = true;
  }
  return any_open;
}

/// True for an obstacle (`body` < 0) and for a particle whose motion is given.
bool is_driven(const ParticlesCase& c, std::int32_t body) {
  return body < 0 || c.setting.given_motions.contains(body);
}

bool may_overlap(const ParticlesCase& c, std::size_t k, std::size_t other) {
  return c.setting.fluid->constraint == RigidConstraint::kRigid && c.particles.is_round(k) &&
         c.particles.is_round(other);
}

/// Throws Error(kBadInput) if the mesh cannot follow disc k of a body where disc `other` of the
/// body overlaps it. Returns true if the circles of both discs meet on the outline of the body.
bool check_overlap(const ParticlesCase& c, const ParticleNames& names, std::size_t k,
                   std::size_t other) {
  const auto fail = [&](std::string_view why) {
    throw_bad_input(names.at(k), "{} and {} of one body overlap so that {}", names(other), names(k),
                    why);
  };
  if (!chord_of(c.particles, k, other))
    fail("one of them is inside the other one, where it must be left out");
  const auto chords = chords_of(*c.setting.fluid, c.particles, k);
  for (std::size_t i = 0; i < chords.size(); ++i) {
    const auto &before = chords[i], &after = chords[(i + 1) % chords.size()];
    const double turn = i + 1 < chords.size() ? 0 : 2 * std::numbers::pi;
    const double arc = after.middle - after.half + turn - before.middle - before.half;
    if (arc < 0)
      fail(fmt::format(
          "{} has a part in common with both {} and {}, and each two of the three circles meet "
          "outside the third one, which the mesh does not join; move one of them or leave it out",
          names(k), names(before.other), names(after.other)));
    if (arc < FluidStartTuning::kLeastArc)
      fail(
          fmt::format("less than one degree of the circle of {} is between two of the others; the "
                      "mesh needs more",
                      names(k)));
  }
  const auto chord = std::ranges::find(chords, other, &Chord::other);
  if (chord == chords.end()) return false;
  if (chord->wedge < FluidStartTuning::kLeastWedge)
    fail(
        fmt::format("the fluid where their circles meet is a wedge of {:.3g} degrees; the mesh "
                    "needs at least {:.0f}, for which the overlap must be deeper",
                    chord->wedge / FluidStartTuning::kDegree,
                    FluidStartTuning::kLeastWedge / FluidStartTuning::kDegree));
  return true;
}

/// Throws Error(kBadInput) if members of a rigid body have too narrow a gap or overlap in a way
/// that the mesh cannot follow, if a moment of inertia is smaller than that of the masses at the
/// centres of the members, or if an arm becomes too short to leave a gap between its particles.
void check_bodies(const case_file::TomlSection& root, const ParticlesCase& c,
                  const ParticleNames& names) {
  const auto& p = c.particles;
  if (c.setting.fluid->coupling == Coupling::kSplitting &&
      !(p.bodies.empty() && c.setting.links.empty()))
    root.section("fluid").fail(
        "coupling",
        "is 'splitting', which does not know rigid bodies and links; it must be \"constrained\"");
  for (std::size_t b = 0; b < p.bodies.count(); ++b) {
    const auto& body = p.bodies.bodies[b];
    const auto masses = member_masses(body, p);
    double least = 0;
    // For each member a number, which is the same for members that overlap, also by way of others.
    std::vector<std::size_t> union_of(masses.size());
    std::iota(union_of.begin(), union_of.end(), 0U);
    for (std::size_t m = 0; m < masses.size(); ++m) {
      least += masses[m] * dot(body.offsets[m], body.offsets[m]);
      const auto k = index_of(body.members[m]);
      for (std::size_t n = 0; n < m; ++n) {
        const auto other = index_of(body.members[n]);
        const Vector apart = p.position(other) - p.position(k);
        const Vector shift = nearest_image(cell_of(c.setting.domain), apart) - apart;
        const double gap = particles::gap(p.placed_shape(k), p.placed_shape(other, shift));
        if (gap < 0 && norm(shift) > 0)
          throw_bad_input(names.at(k),
                          "{} and {} of one body overlap across a side of the period, where the "
                          "mesh does not join them; another origin of the period avoids this",
                          names(other), names(k));
        const double needed =
            FluidStartTuning::kLeastGapOfMesh * std::min(p.radii[k], p.radii[other]);
        if (gap < 0 && may_overlap(c, k, other)) {
          check_overlap(c, names, other, k);
          if (!check_overlap(c, names, k, other)) continue;
          if (union_of[m] == union_of[n])
            throw_bad_input(
                names.at(k),
                "{} closes a ring of particles that overlap, in which fluid would be enclosed",
                names(k));
          std::ranges::replace(union_of, std::size_t(union_of[m]), std::size_t(union_of[n]));
          continue;
        }
        if (gap < needed)
          throw_bad_input(names.at(k),
                          "{} and {} have a gap of {:.3g}; in a fluid the particles of a body must "
                          "keep a gap of at least a thousandth of the smaller radius, {:.3g}, "
                          "because the mesh has fluid between them; with fluid.constraint = "
                          "\"rigid\" and the fitted mesh discs may also overlap",
                          names(other), names(k), gap, needed);
      }
    }
    root.sections("body")[b].require(body.inertia[8] >= least, "moment_of_inertia",
                                     "is {}; in a fluid it must be at least that of the masses of "
                                     "the body's particles at their centres, {:.6g}",
                                     body.inertia[8], least);
  }
  for (std::size_t a = 0; a < c.setting.links.arms.size(); ++a) {
    const auto& arm = c.setting.links.arms[a];
    const double r1 = p.radii[index_of(arm.first)], r2 = p.radii[index_of(arm.second)];
    const double least = r1 + r2 + FluidStartTuning::kLeastGapOfMesh * std::min(r1, r2);
    const double shortest = least_length(arm.length, c.end_time);
    root.sections("arm")[a].require(shortest >= least, "length",
                                    "becomes {:.9g}; in a fluid it must leave a gap of at least a "
                                    "thousandth of the smaller radius and be at least {:.9g}",
                                    shortest, least);
  }
}

/// Restitution and splitting need masses.
void check_masses(const case_file::TomlSection& root, const ParticlesCase& c,
                  const ParticleNames& names) {
  for (std::size_t k = 0; k < c.particles.count(); ++k)
    if (c.setting.laws.restitution.is_on() && c.particles.masses[k] == 0 &&
        !is_driven(c, static_cast<std::int32_t>(k)))
      throw_bad_input(
          names.at(k),
          "{} has no mass, and the case has viscous_contact.restitution: without a mass nothing "
          "rebounds; it must have a density (or mass) > 0, or the restitution must be left out",
          names(k));
  if (c.setting.fluid->coupling != Coupling::kSplitting) return;
  for (std::size_t k = 0; k < c.particles.count(); ++k)
    if (c.particles.masses[k] == 0 && !is_driven(c, static_cast<std::int32_t>(k)))
      root.section("fluid").fail("coupling",
                                 "is 'splitting', which needs masses > 0, because the velocities "
                                 "are projected in the norm of the masses, but the mass of {} is "
                                 "0; it must be \"constrained\", or the particle must have a mass",
                                 names(k));
  // With Coupling::kSplitting the turn of a particle by friction is computed from its moment of
  // inertia, without the fluid.
  for (std::size_t k = 0; k < c.particles.count() && c.setting.laws.friction; ++k)
    if (c.particles.inertias[k] == 0 && !is_driven(c, static_cast<std::int32_t>(k)))
      root.section("fluid").fail(
          "coupling",
          "is 'splitting', with which friction turns particles by their moments of inertia alone, "
          "but that of {} is 0; it must be \"constrained\", or the moment of inertia must be > 0",
          names(k));
}

/// A program of the user's own knows discs only.
void check_solver(const case_file::TomlSection& root, const ParticlesCase& c,
                  const ParticleNames& names) {
  const auto& fluid = *c.setting.fluid;
  if (fluid.solver.empty()) return;
  const auto section = root.section("fluid");
  section.require(fluid.cut_areas.empty(), "solver",
                  "is a program of the user's own, which knows discs only; it must be left out, "
                  "because discs of a body overlap");
  for (std::size_t k = 0; k < c.particles.count(); ++k)
    section.require(c.particles.is_round(k), "solver",
                    "is a program of the user's own, which knows discs only; it must be left out, "
                    "because {} has the shape '{}'",
                    names(k), c.particles.shape(k).name());
}

/// Throws Error(kBadInput) if a particle in a fluid with inertia has no mass, a velocity at the
/// start that has no effect, or a moment of inertia that cannot be computed. With
/// RigidConstraint::kPenalty a particle is computed as a fluid of uniform density, and its moment
/// of inertia must be that of a uniform particle.
void check_inertia(const case_file::TomlSection& root, const ParticlesCase& c,
                   const ParticleNames& names) {
  const auto& fluid = *c.setting.fluid;
  if (!fluid.has_inertia()) return;
  const auto& p = c.particles;
  for (std::size_t k = 0; k < p.count(); ++k) {
    if (is_driven(c, static_cast<std::int32_t>(k))) continue;
    if (!(p.masses[k] > 0))
      throw_bad_input(
          names.at(k),
          "{} has no mass; in a fluid with a density it must have a density (or mass) > 0",
          names(k));
    const bool turns = !p.angular_velocities.empty() && p.angular_velocities[k] != 0;
    if (fluid.start == FlowStart::kStokes && (norm(p.velocity(k)) > 0 || turns))
      throw_bad_input(names.at(k),
                      "{} has a velocity at time 0, which has no effect with fluid.start = "
                      "\"stokes\": the Stokes flow of the first instant gives the particle its "
                      "velocity; the velocity must be left out, or fluid.start be \"rest\"",
                      names(k));
    if (fluid.constraint == RigidConstraint::kRigid || p.inertias.empty()) continue;
    const double uniform = p.shape(k).inertia(p.masses[k]);
    if (std::abs(p.inertias[k] - uniform) > FluidStartTuning::kRounding * uniform)
      throw_bad_input(
          names.at(k),
          "{} has the moment of inertia {}; in a fluid with a density and constraint = \"penalty\" "
          "it must be that of a uniform particle, {}, or the constraint \"rigid\"",
          names(k), p.inertias[k], uniform);
  }
  if (fluid.constraint == RigidConstraint::kRigid) return;
  for (std::size_t b = 0; b < p.bodies.count(); ++b) {
    const auto& body = p.bodies.bodies[b];
    const auto masses = member_masses(body, p);
    double uniform = 0;
    for (std::size_t m = 0; m < masses.size(); ++m) {
      const auto k = index_of(body.members[m]);
      uniform += masses[m] * dot(body.offsets[m], body.offsets[m]) + p.shape(k).inertia(masses[m]);
    }
    root.sections("body")[b].require(
        std::abs(body.inertia[8] - uniform) <= FluidStartTuning::kRounding * uniform,
        "moment_of_inertia",
        "is {}; in a fluid with a density and constraint = \"penalty\" it must be that of uniform "
        "particles, {}, or the constraint \"rigid\"",
        body.inertia[8], uniform);
  }
}

void check_side_of_cylinder(const ParticlesCase& c, const ParticleNames& names) {
  const auto* cylinder = std::get_if<CylinderDomain>(&c.setting.domain);
  if (cylinder == nullptr || c.setting.fluid->mesh != FluidMesh::kFitted) return;
  for (std::size_t k = 0; k < c.particles.count(); ++k) {
    const double radius = c.particles.radii[k], gap = cylinder->radius - radius;
    if (gap < FluidStartTuning::kLeastGapOfMesh * radius)
      throw_bad_input(names.at(k),
                      "{} has a gap of {:.3g} to the side of the cylinder, which the mesh does not "
                      "resolve; it must be at least a thousandth of the radius, {:.3g}",
                      names(k), gap, FluidStartTuning::kLeastGapOfMesh * radius);
  }
}

/// A mean velocity gradient in a box that is periodic along x and y would deform the lattice of
/// periodic images, but the mesh is that of a box that keeps its shape. Therefore the run must have
/// one step only, on a fitted mesh.
void check_mean_flow(const case_file::TomlSection& root, const ParticlesCase& c) {
  const auto* box = std::get_if<BoxDomain>(&c.setting.domain);
  const auto* flow = std::get_if<LinearFlow>(&c.setting.fluid->boundary);
  if (box == nullptr || !box->periodic[0] || !box->periodic[1] || flow == nullptr ||
      flow->gradient == decltype(flow->gradient){})
    return;
  if (c.setting.fluid->mesh == FluidMesh::kFixed)
    root.section("fluid").fail("mesh",
                               "is 'fixed'; it must be \"fitted\" in a box that is periodic both "
                               "ways and sheared or strained, because a particle that the fixed "
                               "mesh cuts has a different velocity on the other side");
  root.section("viscous_contact")
      .require(c.end_time <= (1 + FluidStartTuning::kRounding) * c.setting.time_step, "end_time",
               "is {}; it must be at most time_step, {}, in a box that is periodic both ways and "
               "sheared or strained, because the cell of this version keeps its shape and gives "
               "instantaneous velocities only",
               c.end_time, c.setting.time_step);
}

/// The actual gaps of the discs of [arrangement] are not used, so that an arrangement is accepted
/// or refused whatever its seed is.
void check_arrangement(const case_file::TomlSection& root, const ParticlesCase& c) {
  if (!c.arrangement) return;
  const auto& fluid = *c.setting.fluid;
  const double gap = c.arrangement->smallest_gap;
  const double least = FluidStartTuning::kLeastGapOfMesh * std::ranges::min(c.arrangement->radii);
  const auto section = root.section("arrangement");
  section.require(!root.section("fluid").has("threshold_gap") || gap >= fluid.threshold_gap,
                  "smallest_gap",
                  "is {}; it must be at least fluid.threshold_gap, {}, at which contact is made",
                  gap, fluid.threshold_gap);
  section.require(
      gap >= gap_of_solids(c), "smallest_gap",
      "is {}; it must be at least twice viscous_contact.roughness, {}, at which the solids touch",
      gap, gap_of_solids(c));
  section.require(
      fluid.mesh != FluidMesh::kFitted || gap >= least, "smallest_gap",
      "is {}; it must be at least a thousandth of the radius, {:.3g}, which the mesh resolves", gap,
      least);
}

void check_gap(const ParticlesCase& c, const ParticleNames& names, const StartGap& at) {
  const auto& fluid = *c.setting.fluid;
  const auto& p = c.particles;
  const auto j = index_of(at.second);
  const bool is_pair = at.first >= 0;
  const double radius = is_pair ? std::min(p.radii[index_of(at.first)], p.radii[j]) : p.radii[j];
  const auto other = is_pair ? names(index_of(at.first))
                             : obstacle_name(c, static_cast<std::size_t>(-1 - at.first));
  const bool is_plane = !is_pair && other.starts_with("plane");
  if (fluid.mesh == FluidMesh::kFitted && !is_plane &&
      at.gap < FluidStartTuning::kLeastGapOfMesh * radius)
    throw_bad_input(names.at(j),
                    "{} and {} have a gap of {:.3g} at the start, which the mesh does not resolve; "
                    "it must be at least a thousandth of the smaller radius, {:.3g}",
                    other, names(j), at.gap, FluidStartTuning::kLeastGapOfMesh * radius);
  const double allowed = c.setting.solver.tolerance * mean_radius(p);
  if (at.gap < fluid.threshold_gap - allowed &&
      !(is_driven(c, at.first) && is_driven(c, at.second)))
    throw_bad_input(names.at(j),
                    "{} and {} have a gap of {:.3g} at the start, less than fluid.threshold_gap, "
                    "{:.3g}, at which contact is made; the gap must be larger or {} smaller",
                    other, names(j), at.gap, fluid.threshold_gap,
                    fluid.threshold_gap > gap_of_solids(c) ? "fluid.threshold_gap"
                                                           : "viscous_contact.roughness");
}

/// The largest limit of gaps that gaps_at_start() accepts, but at most `asked` [L].
double limit_within_periods(const ParticlesCase& c, double asked) {
  const double diameter = 2 * std::ranges::max(c.particles.radii);
  for (const double period : periods_of(c.setting.domain))
    if (period > 0) asked = std::min(asked, FluidStartTuning::kLess * (period - diameter));
  return asked;
}

void check_penalty(const case_file::TomlSection& root, const ParticlesCase& c) {
  const auto& fluid = *c.setting.fluid;
  const auto has_members = [](const auto& body) { return body.members.size() > 1; };
  if (fluid.constraint != RigidConstraint::kPenalty ||
      fluid.penalty >= FluidStartTuning::kLeastPenalty ||
      (c.setting.links.empty() && std::ranges::none_of(c.particles.bodies.bodies, has_members)))
    return;
  root.section("fluid").fail(
      "penalty",
      "is {}; in a case with bodies or links it must be at least {}, because the forces that hold "
      "them follow from velocities with rounding errors of 1e-15/penalty. constraint = \"rigid\" "
      "has no penalty",
      fluid.penalty, FluidStartTuning::kLeastPenalty);
}

}  // namespace

void set_default_threshold_gap(ParticlesCase& c) {
  assert(c.setting.fluid && c.particles.count() > 0);
  double smallest = std::ranges::min(c.particles.radii);
  for (const auto& shape : c.particles.shapes) smallest = std::min(smallest, shape.inner_radius());
  const double longest = FluidStartTuning::kOfRadius * smallest;
  double threshold = longest;
  for (const double period : periods_of(c.setting.domain))
    if (period > 0)
      threshold = std::min(threshold, (period - 2 * std::ranges::max(c.particles.radii)) / 2);
  for (const auto& at : gaps_at_start(c, limit_within_periods(c, 2 * longest)))
    threshold = std::min(threshold, std::max(0.0, at.gap) / 2);
  c.setting.fluid->threshold_gap = std::max(threshold, gap_of_solids(c));
}

void check_fluid_start(const case_file::TomlSection& root, const ParticlesCase& c,
                       const ParticleLines& lines) {
  assert(c.setting.fluid);
  const ParticleNames names(c, lines);
  if (has_only_open_sides(c) && c.setting.given_motions.empty())
    root.section("fluid").fail(
        "velocity",
        "makes each side open that is not periodic, so that nothing balances the forces on the "
        "particles; at least one side must be a wall, or the motion of a particle must be given");
  check_mean_flow(root, c);
  root.section("fluid").require(c.setting.fluid->threshold_gap >= gap_of_solids(c), "threshold_gap",
                                "is {}; it must be at least twice viscous_contact.roughness, {}, "
                                "because the solids touch at that gap",
                                c.setting.fluid->threshold_gap, gap_of_solids(c));
  check_arrangement(root, c);
  check_penalty(root, c);
  check_bodies(root, c, names);
  check_masses(root, c, names);
  check_solver(root, c, names);
  check_inertia(root, c, names);
  check_side_of_cylinder(c, names);
  const double limit =
      std::max(c.setting.fluid->threshold_gap,
               FluidStartTuning::kLeastGapOfMesh * std::ranges::max(c.particles.radii));
  for (const auto& at : gaps_at_start(c, limit_within_periods(c, limit))) check_gap(c, names, at);
}

}  // namespace viscontact::particles
