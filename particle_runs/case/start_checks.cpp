// Checks of the places and radii of the particles at the start.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <variant>

#include "viscontact/common/error.hpp"
#include "viscontact/particle_runs/case/particles_sections.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/neighbours/close_pairs.hpp"
#include "viscontact/particles/shapes/shape_contacts.hpp"

namespace viscontact::particles {

std::string ParticleNames::operator()(std::size_t k) const {
  assert(k < case_.particles.count());
  const auto x = case_.particles.position(k);
  std::string place = fmt::format("{}", x[0]);
  for (std::size_t d = 1; d < static_cast<std::size_t>(case_.particles.dimension); ++d)
    place += fmt::format(", {}", x[d]);
  const auto body = case_.particles.bodies.body_of(static_cast<std::int32_t>(k));
  return fmt::format("particle {} ({}centre {}, radius {}{})", case_.particles.id(k),
                     k < lines_.in_file.size() ? fmt::format("line {}, ", lines_.in_file[k]) : "",
                     place, case_.particles.radii[k],
                     body < 0 ? "" : fmt::format(", of body {}", body));
}

FilePosition ParticleNames::at(std::size_t k) const {
  if (k < lines_.in_file.size()) return {case_.particles_file.string(), lines_.in_file[k]};
  const auto table = k - lines_.in_file.size();
  return {case_.path.string(), table < lines_.in_case.size() ? lines_.in_case[table] : 0};
}

std::string obstacle_name(const ParticlesCase& c, std::size_t k) {
  // The walls have the order in which obstacles_of() returns them.
  std::vector<std::string> walls;
  if (std::holds_alternative<DiscDomain>(c.setting.domain)) walls = {"the wall of the disc"};
  if (std::holds_alternative<CylinderDomain>(c.setting.domain))
    walls = {"the side of the cylinder", "the floor of the cylinder", "the lid of the cylinder"};
  if (const auto* box = std::get_if<BoxDomain>(&c.setting.domain)) {
    if (!box->periodic[0]) walls = {"the left side of the box", "the right side of the box"};
    if (!box->periodic[1] && box->dimension() == 3)
      walls.insert(walls.end(), {"the front of the box", "the back of the box"});
    if (!box->periodic[box->dimension() - 1])
      walls.insert(walls.end(), {"the bottom of the box", "the top of the box"});
  }
  return k < walls.size() ? walls[k] : fmt::format("plane {}", k - walls.size() + 1);
}

namespace {

/// The gaps of overlapping spheres in a cell whose images across y are displaced along x. The
/// period along y is above twice the sum of any two radii.
std::vector<StartGap> overlaps_in_sheared_cell(const ParticlesCase& c, double offset) {
  const auto& p = c.particles;
  auto cell = cell_of(c.setting.domain);
  const double middle = cell.from[1] + cell.lengths[1] / 2, period = cell.lengths[1];
  // Pairs that do not meet across y, and then, with the upper half of the cell below the lower one,
  // those that do.
  cell.lengths[1] = 0;
  auto positions = p.positions;
  ThreadPool pool(1);
  std::vector<StartGap> gaps;
  const auto add_pairs = [&] {
    for (const auto& [first, second, image] :
         close_pairs_in_period(cell, positions, p.radii, pool)) {
      const auto i = index_of(first), j = index_of(second);
      const Vector apart = point_of(positions.data(), j, 3) + shift_of(cell, image) -
                           point_of(positions.data(), i, 3);
      gaps.push_back({first, second, norm(apart) - p.radii[i] - p.radii[j]});
    }
  };
  add_pairs();
  for (std::size_t k = 0; k < p.count(); ++k) {
    if (positions[3 * k + 1] < middle) continue;
    positions[3 * k + 1] -= period;
    auto& x = positions[3 * k];
    x -= offset;
    x -= cell.lengths[0] * std::floor((x - cell.from[0]) / cell.lengths[0]);
  }
  add_pairs();
  std::ranges::sort(gaps, {}, [](const StartGap& at) { return std::pair(at.first, at.second); });
  const auto equal = std::ranges::unique(gaps, [](const StartGap& a, const StartGap& b) {
    return a.first == b.first && a.second == b.second;
  });
  gaps.erase(equal.begin(), equal.end());
  return gaps;
}

}  // namespace

std::vector<StartGap> gaps_at_start(const ParticlesCase& c, double limit) {
  assert(limit >= 0);
  const auto& p = c.particles;
  const auto cell = cell_of(c.setting.domain);
  const bool has_shapes = p.has_other_shapes();
  std::vector<double> extents = p.radii;
  for (auto& extent : extents) extent += limit / 2;
  ThreadPool pool(1);
  std::vector<StartGap> gaps;
  for (const auto& [first, second, image] :
       cell.is_periodic() ? close_pairs_in_period(cell, p.positions, extents, pool)
                          : close_pairs(p.dimension, p.positions, extents, pool)) {
    if (p.are_joined(first, second)) continue;
    if (c.setting.fluid && c.setting.fluid->are_of_one_membrane(first, second)) continue;
    const auto i = index_of(first), j = index_of(second);
    const auto shift = shift_of(cell, image);
    gaps.push_back({first, second,
                    has_shapes
                        ? gap(p.placed_shape(i), p.placed_shape(j, shift))
                        : norm(p.position(j) + shift - p.position(i)) - p.radii[i] - p.radii[j]});
  }
  const auto obstacles = obstacles_of(c.setting);
  const bool on_axis = std::holds_alternative<CylinderDomain>(c.setting.domain);
  for (std::size_t w = on_axis ? 1 : 0; w < obstacles.size(); ++w) {
    const auto place = obstacles[w].at(0);
    for (std::size_t k = 0; k < p.count(); ++k)
      // The circle around a particle contains it: the gap of the circle is not larger.
      if (const double least = gap(place, p.position(k), p.radii[k]); least < limit)
        gaps.push_back({-1 - static_cast<std::int32_t>(w), static_cast<std::int32_t>(k),
                        has_shapes ? gap(place, p.placed_shape(k)) : least});
  }
  return gaps;
}

namespace {

/// Throws Error(kBadInput) if a radius is too small, or a coordinate too large, for
/// solver.tolerance.
void check_radii_and_distances(const ParticlesCase& c, const ParticleNames& names) {
  const auto& p = c.particles;
  const double tolerance = c.setting.solver.tolerance;
  const double allowed = tolerance * mean_radius(p);
  const auto smallest =
      static_cast<std::size_t>(std::ranges::min_element(p.radii) - p.radii.begin());
  if (allowed > kToleranceOfRadius * p.radii[smallest])
    throw_bad_input(names.at(smallest),
                    "{} is too small for solver.tolerance, {}: the tolerance times the mean radius "
                    "is {:.3g}; it must be at most a hundredth of each radius",
                    names(smallest), tolerance, allowed);
  const double farthest = largest_resolved_distance(tolerance, mean_radius(p));
  for (std::size_t k = 0; k < p.count(); ++k)
    for (const double x : p.position(k))
      if (std::abs(x) > farthest)
        throw_bad_input(names.at(k),
                        "{} is too far from the origin for its gaps to be known to "
                        "solver.tolerance; each coordinate must be at most {:.3g} in magnitude",
                        names(k), farthest);
}

/// Says, as a part of a sentence, what is wrong with the place of a particle in a domain; empty if
/// the place is allowed.
struct PlaceInDomain {
  Vector x;
  double radius;

  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(const DiscDomain& disc) const {
    if (norm(x - disc.centre) < disc.radius) return "";
    return fmt::format("its centre must be less than {} from {}, {}", disc.radius, disc.centre[0],
                       disc.centre[1]);
  }
  std::string operator()(const BoxDomain& box) const {
    for (std::size_t d = 0; d < box.dimension(); ++d)
      if (!(x[d] >= box.from[d] && x[d] <= box.to[d]))
        return fmt::format("{} of its centre must be from {} to {}{}", kAxes[d], box.from[d],
                           box.to[d], box.periodic[d] ? ", which is one period" : "");
    return "";
  }
  std::string operator()(const CylinderDomain& cylinder) const {
    if (!(x[0] > 0 && x[0] < cylinder.height))
      return fmt::format("z of its centre must be between 0 and {}", cylinder.height);
    if (!(radius < cylinder.radius))
      return fmt::format("its radius must be less than that of the cylinder, {}", cylinder.radius);
    return "";
  }
};

/// Throws Error(kBadInput) if a centre is outside the domain, or if a particle is so large that it
/// would touch an image of itself.
void check_domain(const ParticlesCase& c, const ParticleNames& names) {
  const auto& p = c.particles;
  const auto periods = periods_of(c.setting.domain);
  // The gap between a particle and its own image never changes. In a fluid it must be at least the
  // threshold gap, because particles have no contact with themselves.
  for (std::size_t k = 0; k < p.count(); ++k) {
    const auto wrong = std::visit(PlaceInDomain{p.position(k), p.radii[k]}, c.setting.domain);
    if (!wrong.empty())
      throw_bad_input(names.at(k), "{} is outside the domain; {}", names(k), wrong);
    const double least = std::max(kLeastGapToImage * p.radii[k],
                                  c.setting.fluid ? c.setting.fluid->threshold_gap : 0.0);
    for (const double period : periods)
      if (period > 0 && !(2 * p.radii[k] + least <= period))
        throw_bad_input(names.at(k),
                        "{} is too large for the period of the domain, {}: it would touch its own "
                        "image; its radius must be at most {:.6g}",
                        names(k), period, (period - least) / 2);
  }
}

}  // namespace

void check_start(const ParticlesCase& c, const ParticleLines& lines) {
  if (c.particles.count() == 0) return;  // all particles come from sources
  const ParticleNames names(c, lines);
  check_radii_and_distances(c, names);
  check_domain(c, names);
  const double allowed = c.setting.solver.tolerance * mean_radius(c.particles);
  // Without a fluid, two bodies whose motions are given make no contact, and may overlap.
  const auto walls = obstacles_of(c.setting).size() - c.setting.planes.size();
  const auto is_given = [&](std::int32_t body) {
    const auto w = static_cast<std::size_t>(-1 - body);
    return body >= 0 ? c.setting.given_motions.contains(body)
                     : w < walls || !c.setting.planes[w - walls].load;
  };
  const double offset = c.setting.lubrication ? c.setting.lubrication->offset : 0;
  for (const auto& [first, second, gap] :
       offset != 0 ? overlaps_in_sheared_cell(c, offset) : gaps_at_start(c, 0)) {
    if (!(gap < -allowed)) continue;
    if (!c.setting.fluid && is_given(first) && is_given(second)) continue;
    const auto j = index_of(second);
    if (first >= 0)
      throw_bad_input(names.at(j),
                      "{} and {} overlap by {:.3g} at the start; at most {:.3g} is allowed",
                      names(index_of(first)), names(j), -gap, allowed);
    const auto obstacle = obstacle_name(c, static_cast<std::size_t>(-1 - first));
    throw_bad_input(names.at(j), "{} is {:.3g} into {} at the start, or behind it; {}", names(j),
                    -gap, obstacle,
                    obstacle.starts_with("plane") ? "a plane's normal must point into the free side"
                                                  : "it must be inside the domain");
  }
}

}  // namespace viscontact::particles
