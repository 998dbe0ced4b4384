// Checks of the membranes of a case.

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/membranes/membrane_shape.hpp"
#include "viscontact/particle_runs/case/particles_sections.hpp"

namespace viscontact::particles {
namespace {

/// Free choices of the checks.
struct MembraneCheckTuning {
  // The least and the largest viscosity ratio. At smaller ones the solution is lost in rounding
  // errors (1e-6 ends in errors of FreeFEM). At larger ones the error of the elements grows: the
  // inclination of a membrane of reduced area 0.9 after half a time unit should hardly depend on
  // such large ratios, but it differs by 0.002 rad between 1e2 and 1e3, and by 0.015 rad between
  // 1e3 and 1e4.
  static constexpr double kLeastRatio = 1e-4, kMostRatio = 1e3;
  // The bending rigidity, over `scale` in check_in_fluid(), up to which a membrane may have few
  // beads, and the least number of beads of a stiffer one. The lengths are kept, and stiff bending
  // keeps the curve smooth; a curve of few beads can then hardly move along itself around the area
  // inside, as it should in a shear flow. With 12 beads and 1000 times `scale` as the bending
  // rigidity, the inclination is 0.43 rad, and 0.58 rad would be right. Both numbers are choices
  // between such tests.
  static constexpr double kStiff = 100;
  static constexpr std::int32_t kBeadsOfStiff = 32;
  // With three beads the distances, which are kept, would determine the shape.
  static constexpr std::int32_t kLeastWithoutFluid = 4;
  // If the membrane is flat, its sides lie on each other, and no motion changes its area, so that
  // the equation of the area is singular.
  static constexpr double kLeastReducedArea = 1e-3;
  // The distances of given particles have the rounding errors of their positions.
  static constexpr double kRounding = 1 + 1e-9;
  // A membrane with the largest area that its distances allow can only move rigidly: the gradient
  // of the area is then a linear combination of those of the distances, and the equations are
  // singular. In a test, a membrane with 0.993 of the largest area still kept area and distances
  // when a disc hit it.
  static constexpr double kOfLargestArea = 0.993;
};

void check_case_without_fluid(const case_file::TomlSection& root, const ParticlesCase& c) {
  root.section("viscous_contact")
      .require(
          !c.setting.laws.restitution.is_on(), "restitution",
          "must be left out, because the case has membranes, through which an impact would pass");
}

/// Throws Error(kBadInput) if a case with a fluid has something that cannot be combined with
/// membranes.
void check_case_in_fluid(const case_file::TomlSection& root, const case_file::TomlSection& first,
                         const ParticlesCase& c) {
  const FilePosition at{c.path.string(), first.line(), "membrane"};
  for (const auto* key : {"body", "hinge", "spring", "arm", "plane"})
    if (root.has(key))
      throw_bad_input(at,
                      "section [[membrane]] stands beside {}; a case with membranes in a fluid "
                      "must have no planes, bodies and links",
                      key);
  const auto& fluid = *c.setting.fluid;
  const auto section = root.section("fluid");
  section.require(
      !fluid.has_inertia(), "density",
      "is {}; it must be 0 or left out in a case with membranes, which move in Stokes flow",
      fluid.density);
  section.require(fluid.solver.empty(), "solver",
                  "is a program of your own, which does not know membranes; it must be left out");
  section.require(
      fluid.mesh == FluidMesh::kFitted, "mesh",
      "is 'fixed'; it must be \"fitted\" in a case with membranes, which the mesh follows");
  section.require(fluid.coupling == Coupling::kConstrained, "coupling",
                  "is 'splitting'; it must be \"constrained\" in a case with membranes");
  section.require(fluid.constraint == RigidConstraint::kPenalty, "constraint",
                  "is 'rigid'; it must be left out in a case with membranes, beside which rigid "
                  "motions are always unknowns");
  root.section("space").require(
      c.setting.gravity == Vector{}, "gravity",
      "has no effect on membranes, which have no mass; it must be 0 or left out");
  root.section("viscous_contact")
      .require(!c.setting.laws.restitution.is_on(), "restitution",
               "has no effect on membranes, which have no mass; it must be 0 or left out");
  const auto* box = std::get_if<BoxDomain>(&c.setting.domain);
  if (box != nullptr && box->periodic[1])
    throw_bad_input(at,
                    "section [[membrane]] stands in a box that is periodic along y; the box must "
                    "have walls below and above");
}

/// Throws Error(kBadInput) if the membrane with these corners (corners_of()) is wider than the
/// domain. The width of a membrane that is made is proportional to its perimeter.
void check_width(const case_file::TomlSection& section, const Membrane& membrane,
                 std::span<const double> corners, const Domain& domain) {
  double fits = std::numeric_limits<double>::infinity();  // the least of domain over membrane [1]
  std::string size;
  for (std::size_t d = 0; d < 2; ++d) {
    double from = corners[d], to = corners[d];
    for (std::size_t i = d; i < corners.size(); i += 2) {
      from = std::min(from, corners[i]);
      to = std::max(to, corners[i]);
    }
    double most = std::numeric_limits<double>::infinity();  // [L]
    if (const auto* disc = std::get_if<DiscDomain>(&domain)) most = 2 * disc->radius;
    if (const auto* box = std::get_if<BoxDomain>(&domain)) most = box->to[d] - box->from[d];
    if (!(most < fits * (to - from))) continue;
    fits = most / (to - from);
    size = fmt::format("measures {:.6g} along {}, and the domain {:.6g}", to - from,
                       d == 0 ? "x" : "y", most);
  }
  if (section.has("particles"))
    section.require(fits > 1, "particles", "makes a membrane that {}; the membrane must be smaller",
                    size);
  else
    section.require(fits > 1, "perimeter",
                    "is {}, which makes a membrane that {}; it must be less than {:.6g}",
                    membrane.perimeter, size, fits * membrane.perimeter);
}

/// An estimate of the rate at which the boundary deforms the fluid [1/T]: the largest entry of the
/// velocity gradient, or the largest speed of a side over the smallest extent of the box.
double rate_of_deformation(const ParticlesCase& c) {
  const auto& boundary = c.setting.fluid->boundary;
  double largest = 0;
  if (const auto* flow = std::get_if<LinearFlow>(&boundary)) {
    for (const double entry : flow->gradient) largest = std::max(largest, std::abs(entry));
    return largest;
  }
  const auto& box = std::get<BoxDomain>(c.setting.domain);
  for (const auto& wall : std::get<SideVelocities>(boundary))
    largest = std::max(largest, std::hypot(wall.value[0], wall.value[1]));
  return largest / std::min(box.to[0] - box.from[0], box.to[1] - box.from[1]);
}

}  // namespace

void check_in_fluid(const case_file::TomlSection& section, const ParticlesCase& c) {
  assert(c.setting.fluid && !c.setting.fluid->membranes.empty());
  const auto& membrane = c.setting.fluid->membranes.back();
  section.require(membrane.viscosity_ratio >= MembraneCheckTuning::kLeastRatio &&
                      membrane.viscosity_ratio <= MembraneCheckTuning::kMostRatio,
                  "inner_viscosity",
                  "is {:.6g} times the viscosity of the fluid outside; it must be from 1e-4 to 1e3 "
                  "times as large",
                  membrane.viscosity_ratio);
  const double scale = c.setting.fluid->viscosity * rate_of_deformation(c) *
                       std::pow(membrane.area / std::numbers::pi, 1.5);
  section.require(
      membrane.count() >= MembraneCheckTuning::kBeadsOfStiff ||
          membrane.bending_rigidity <= MembraneCheckTuning::kStiff * scale || scale == 0,
      section.has("particles") ? "particles" : "beads",
      "makes {} beads, too few for so stiff a membrane: the bending rigidity is {:.3g} "
      "times viscosity, rate of deformation and R0^3, R0^2 = area/pi; from 100 on a "
      "membrane must have at least {} beads",
      membrane.count(), membrane.bending_rigidity / scale, MembraneCheckTuning::kBeadsOfStiff);
}

void check_case_of_membranes(const case_file::TomlSection& root,
                             const case_file::TomlSection& first, const ParticlesCase& c) {
  if (c.particles.dimension != 2)
    throw_bad_input({c.path.string(), first.line(), "membrane"},
                    "section [[membrane]] belongs to the plane; space.dimension must be 2");
  if (c.setting.fluid)
    check_case_in_fluid(root, first, c);
  else
    check_case_without_fluid(root, c);
}

void check_given_beads(const case_file::TomlSection& section, const ParticlesCase& c,
                       const Membrane& membrane) {
  const bool in_fluid = c.setting.fluid.has_value();
  const auto& p = c.particles;
  const auto least = in_fluid ? kLeastBeads : MembraneCheckTuning::kLeastWithoutFluid;
  section.require(membrane.count() >= least, "particles",
                  "has {} beads; a membrane {} must have at least {}", membrane.count(),
                  in_fluid ? "in a fluid" : "without a fluid", least);
  const auto& earlier = membranes_of(c.setting);
  for (auto bead = membrane.beads.begin(); bead != membrane.beads.end(); ++bead) {
    const auto id = p.id(index_of(*bead));
    section.require(std::find(membrane.beads.begin(), bead, *bead) == bead, "particles",
                    "contains particle {} a second time", id);
    for (std::size_t m = 0; m < earlier.size(); ++m)
      section.require(!earlier[m].has(*bead), "particles",
                      "contains particle {}, which is a bead of membrane {}", id, m);
    section.require(!in_fluid || p.masses[index_of(*bead)] == 0, "particles",
                    "contains particle {} with the mass {}; in a fluid beads must have no mass", id,
                    p.masses[index_of(*bead)]);
    section.require(!c.setting.given_motions.contains(*bead), "particles",
                    "contains particle {}, whose motion is given; beads must be free", id);
    section.require(p.is_round(index_of(*bead)), "particles",
                    "contains particle {}, which is no disc but of the shape '{}'; beads must be "
                    "discs",
                    id, p.shape(index_of(*bead)).name());
  }
}

void check_place(const case_file::TomlSection& section, const ParticlesCase& c) {
  const auto& p = c.particles;
  const auto& membranes = membranes_of(c.setting);
  const auto& membrane = membranes.back();
  const std::string_view shape = section.has("particles") ? "particles" : "reduced_area";
  const auto own = corners_of(membrane, p);
  const auto count = membrane.beads.size();
  check_width(section, membrane, own, c.setting.domain);
  section.require(!crosses_itself(own), shape, "makes a membrane that crosses itself");
  const double reduced_area =
      4 * std::numbers::pi * membrane.area / (membrane.perimeter * membrane.perimeter);
  section.require(reduced_area >= MembraneCheckTuning::kLeastReducedArea, shape,
                  "makes a flat membrane, with the reduced area {:.3g}; it must be at least {}",
                  reduced_area, MembraneCheckTuning::kLeastReducedArea);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 2; j < count; ++j) {
      const auto a = index_of(membrane.beads[i]), b = index_of(membrane.beads[j]);
      const double distance = std::hypot(own[2 * i] - own[2 * j], own[2 * i + 1] - own[2 * j + 1]);
      section.require((i == 0 && j + 1 == count) ||
                          distance * MembraneCheckTuning::kRounding >= p.radii[a] + p.radii[b],
                      shape,
                      "makes particles {} and {} overlap across the membrane; its area must be "
                      "larger, or its beads smaller",
                      p.id(a), p.id(b));
    }
  // The bounds are those of the key reduced_area (membrane_keys.cpp) with room for rounding errors.
  section.require(
      !c.setting.fluid || (reduced_area > 0.2999 && reduced_area < 0.99901), shape,
      "makes a membrane of the reduced area {:.6g}; in a fluid it must be from 0.3 to 0.999",
      reduced_area);
  if (!c.setting.fluid && membrane.keeps_area) {
    const double largest = largest_area(membrane.lengths);
    section.require(membrane.area <= MembraneCheckTuning::kOfLargestArea * largest, shape,
                    "makes a membrane of the area {:.6g}, and the largest one that its beads can "
                    "enclose is {:.6g}; it must be at most {} of this one, with which it can "
                    "change its shape, or inner_area must be \"free\"",
                    membrane.area, largest, MembraneCheckTuning::kOfLargestArea);
  }
  const auto periods = periods_of(c.setting.domain);
  for (std::size_t m = 0; m + 1 < membranes.size(); ++m) {
    const auto other = corners_of(membranes[m], p);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) {
        auto image = other;
        for (std::size_t k = 0; k < image.size(); k += 2) {
          image[k] += i * periods[0];
          image[k + 1] += j * periods[1];
        }
        const std::string_view place = section.has("particles") ? "particles" : "centre";
        section.require(!do_cross(own, image) && (!c.setting.fluid || !do_contain(own, image)),
                        place, "makes the membrane cross {}membrane {}; membranes must be apart",
                        c.setting.fluid ? "or contain " : "", m);
      }
  }
}

void check_others(const case_file::TomlSection& first, const ParticlesCase& c) {
  if (!c.setting.fluid) return;
  const auto& p = c.particles;
  const FilePosition at{c.path.string(), first.line(), "membrane"};
  std::vector<char> is_bead(p.count(), 0);
  for (const auto& membrane : c.setting.fluid->membranes)
    for (const auto bead : membrane.beads) is_bead[index_of(bead)] = 1;
  for (std::size_t k = 0; k < p.count(); ++k) {
    if (is_bead[k] != 0) continue;
    const auto refuse = [&](std::string_view what) {
      throw_bad_input(at,
                      "section [[membrane]] stands beside particle {}, which {}; beside membranes "
                      "particles must be discs without mass and torque",
                      p.id(k), what);
    };
    if (p.masses[k] > 0) refuse("has a mass");
    if (!p.is_round(k)) refuse(fmt::format("has the shape '{}'", p.shape(k).name()));
    if (c.setting.torques.contains(static_cast<std::int32_t>(k))) refuse("has a torque");
  }
  for (const auto& membrane : c.setting.fluid->membranes) {
    const auto corners = corners_of(membrane, p);
    for (std::size_t k = 0; k < p.count(); ++k) {
      if (is_bead[k] != 0) continue;
      const auto x = p.position(k);
      for (std::size_t i = 0; i < corners.size(); i += 2) {
        const auto j = (i + 2) % corners.size();
        const Vector a = {corners[i], corners[i + 1], 0}, b = {corners[j], corners[j + 1], 0};
        const Vector side = b - a;
        const double along = std::clamp(dot(x - a, side) / dot(side, side), 0.0, 1.0);
        if (!(norm(nearest_image(p.cell, x - a - along * side)) > p.radii[k]))
          throw_bad_input(at,
                          "section [[membrane]] stands beside particle {}, which crosses a "
                          "membrane; it must be inside or outside",
                          p.id(k));
      }
    }
  }
}

}  // namespace viscontact::particles
