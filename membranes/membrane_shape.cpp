// Measures, initial shapes and checks of membranes.
#include "viscontact/membranes/membrane_shape.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "viscontact/common/error.hpp"
#include "viscontact/membranes/membrane_curve.hpp"
#include "viscontact/membranes/membrane_motion.hpp"
#include "viscontact/membranes/necklace.hpp"
#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

const std::vector<Membrane>& membranes_of(const Setting& setting) {
  return setting.fluid ? setting.fluid->membranes : setting.links.membranes;
}

namespace {

/// Free choices of shapes.
struct MembraneShapeTuning {
  // Coordinates over the size of a membrane from which on it is moved to the origin, as in
  // distant_corner().
  static constexpr double kDistant = 100;
  // Relative difference of perimeter, area and distances in a restart file from those of the case,
  // far above the errors with which a run keeps these numbers, and far below a change of the case.
  static constexpr double kKept = 1e-6;
  // Points of an ellipse for integrals along it. The midpoint rule converges exponentially; for an
  // ellipse of axes 1:20 this number leaves errors near rounding errors.
  static constexpr int kPoints = 4096;
  // Largest semi-axis of an ellipse over the radius of a disc of its area.
  static constexpr double kLongest = 1e3;
  // Halvings of the interval of that ratio, and of that of a curvature; enough to reach rounding
  // errors.
  static constexpr int kHalvingsOfEllipse = 100, kHalvings = 200;
};

/// Moves the first bead to 0 along each axis on which coordinates are so much larger than the
/// membrane that their rounding errors would change its lengths and its area. Returns how far, [L].
std::array<double, 2> move_to_origin(Eigen::VectorXd& positions) {
  const auto n = positions.size() / 2;
  std::array<double, 2> from{};
  for (Eigen::Index d = 0; d < 2; ++d) {
    auto along = positions.segment(d * n, n);
    const double first = along(0);
    if (!(std::abs(first) > MembraneShapeTuning::kDistant * (along.maxCoeff() - along.minCoeff())))
      continue;
    along.array() -= first;
    from[static_cast<std::size_t>(d)] = first;
  }
  return from;
}

}  // namespace

MembraneMeasures measure(const Membrane& membrane, const Particles& particles) {
  if (!membrane.lengths.empty()) return measure_necklace(membrane, particles);
  const std::array one = {membrane};
  const Membranes membranes(one);
  auto positions = membranes.places(particles.positions, particles.cell);
  const auto from = move_to_origin(positions);
  auto measures = measure(MembraneCurve(membrane.count()), positions,
                          membranes.from_particles(particles.velocities, 2));
  if (from[0] != 0) measures.x += from[0];
  if (from[1] != 0) measures.y += from[1];
  return measures;
}

namespace {

/// True if the distances of neighbouring beads differ from Membrane::lengths by at most `kept`
/// times the mean distance, or if there are no such lengths.
bool keeps_distances(const Membrane& membrane, const Particles& particles, double kept) {
  if (membrane.lengths.empty()) return true;
  const Eigen::VectorXd distances = distances_of(necklace_of(membrane, particles));
  const double allowed = kept * membrane.perimeter / static_cast<double>(membrane.lengths.size());
  for (std::size_t k = 0; k < membrane.lengths.size(); ++k)
    if (!(std::abs(distances[static_cast<Eigen::Index>(k)] - membrane.lengths[k]) <= allowed))
      return false;
  return true;
}

}  // namespace

void check_shapes(std::span<const Membrane> membranes, const Particles& particles) {
  for (std::size_t m = 0; m < membranes.size(); ++m) {
    const auto& asked = membranes[m];
    const auto found = measure(asked, particles);
    const bool has_area = !asked.keeps_area || std::abs(found.area - asked.area) <=
                                                   MembraneShapeTuning::kKept * asked.area;
    if (has_area &&
        std::abs(found.perimeter - asked.perimeter) <=
            MembraneShapeTuning::kKept * asked.perimeter &&
        keeps_distances(asked, particles, MembraneShapeTuning::kKept))
      continue;
    throw Error(
        ErrorKind::kBadInput,
        "membrane {} of the restart file has the perimeter {:.7g} and the area {:.7g}, that of the "
        "case {:.7g} and {:.7g}; both must be the same, but for an area that is not kept, and "
        "without a fluid the distances of neighbours must be the same, too",
        m, found.perimeter, found.area, asked.perimeter, asked.area);
  }
}

void join_neighbours(std::span<const Membrane> membranes, Particles& particles) {
  particles.neighbours.clear();
  if (membranes.empty()) return;
  particles.neighbours.assign(particles.count(), {-1, -1});
  for (const auto& membrane : membranes)
    for (std::int32_t k = 0; k < membrane.count(); ++k)
      particles.neighbours[index_of(membrane.bead(k))] = {membrane.bead(k - 1),
                                                          membrane.bead(k + 1)};
}

namespace {

constexpr int kPoints = MembraneShapeTuning::kPoints;

/// Entry i: length of an ellipse of semi-axes a and b from the angle 0 to 2 pi i/kPoints [L].
std::vector<double> lengths_along(double a, double b) {
  std::vector<double> lengths = {0};
  for (int i = 0; i < kPoints; ++i) {
    const double t = kTwoPi * (i + 0.5) / kPoints;
    lengths.push_back(lengths.back() +
                      kTwoPi / kPoints * std::hypot(a * std::sin(t), b * std::cos(t)));
  }
  return lengths;
}

using Corner = std::array<double, 2>;

Corner corner(std::span<const double> polygon, std::size_t i) {
  assert(polygon.size() >= 6 && polygon.size() % 2 == 0);
  const auto k = 2 * (i % (polygon.size() / 2));
  return {polygon[k], polygon[k + 1]};
}

/// The result [L^2] is > 0 if c is on the left of the line from a to b, < 0 if it is on the right.
double side(const Corner& a, const Corner& b, const Corner& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// True if the sides that begin at corners i and j cross.
bool sides_cross(std::span<const double> first, std::size_t i, std::span<const double> second,
                 std::size_t j) {
  const auto a = corner(first, i), b = corner(first, i + 1), c = corner(second, j),
             d = corner(second, j + 1);
  return (side(a, b, c) > 0) != (side(a, b, d) > 0) && (side(c, d, a) > 0) != (side(c, d, b) > 0);
}

}  // namespace

std::optional<std::vector<double>> ellipse_of(const Membrane& membrane, const Vector& centre,
                                              double angle) {
  assert(membrane.count() >= 3 && membrane.area > 0);
  // The semi-axes a and b have a b = area/pi = mean^2, and the perimeter grows with a/mean, which
  // is found by bisection.
  const double mean = std::sqrt(membrane.area / std::numbers::pi);
  double low = 1, high = MembraneShapeTuning::kLongest;  // bounds of a/mean
  for (int i = 0; i < MembraneShapeTuning::kHalvingsOfEllipse; ++i) {
    const double middle = std::sqrt(low * high);
    (lengths_along(mean * middle, mean / middle).back() < membrane.perimeter ? low : high) = middle;
  }
  const double a = mean * low, b = mean / low, c = std::cos(angle), s = std::sin(angle);
  const auto lengths = lengths_along(a, b);
  const auto n = static_cast<Eigen::Index>(membrane.count());
  Eigen::VectorXd positions(2 * n);
  std::size_t i = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double wanted = lengths.back() * static_cast<double>(k) / static_cast<double>(n);
    while (lengths[i + 1] < wanted) ++i;
    const double t =
        kTwoPi / kPoints *
        (static_cast<double>(i) + (wanted - lengths[i]) / (lengths[i + 1] - lengths[i]));
    positions(k) = a * c * std::cos(t) - b * s * std::sin(t);
    positions(n + k) = a * s * std::cos(t) + b * c * std::sin(t);
  }
  const bool is_found = membrane.lengths.empty()
                            ? restore_lengths_and_area(MembraneCurve(membrane.count()),
                                                       membrane.perimeter, membrane.area, positions)
                            : restore_necklace(Eigen::Map<const Eigen::VectorXd>(
                                                   membrane.lengths.data(), membrane.count()),
                                               membrane.area, positions);
  if (!is_found) return {};
  std::vector<double> places;
  for (Eigen::Index k = 0; k < n; ++k) {
    places.push_back(centre[0] + positions(k));
    places.push_back(centre[1] + positions(n + k));
  }
  return places;
}

namespace {

/// Positions of the beads, x of all and then y [L]; their order is reversed if it is clockwise.
Eigen::VectorXd ordered_necklace(Membrane& membrane, const Particles& particles) {
  const auto necklace = necklace_of(membrane, particles);
  if (area_of(necklace) >= 0) return necklace;
  std::ranges::reverse(membrane.beads);
  return necklace_of(membrane, particles);
}

}  // namespace

void shape_polygon(Membrane& membrane, const Particles& particles) {
  const auto necklace = ordered_necklace(membrane, particles);
  const auto distances = distances_of(necklace);
  membrane.lengths.assign(distances.begin(), distances.end());
  membrane.perimeter = distances.sum();
  membrane.area = area_of(necklace);
}

double shape_curve(Membrane& membrane, Particles& particles) {
  auto given = ordered_necklace(membrane, particles);
  move_to_origin(given);
  const MembraneCurve curve(membrane.count());
  membrane.perimeter = curve.perimeter(given);
  membrane.area = curve.area(given);
  auto kept = given;
  if (!restore_lengths_and_area(curve, membrane.perimeter, membrane.area, kept))
    return std::numeric_limits<double>::infinity();
  const Eigen::Index n = membrane.count();
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto at = 2 * index_of(membrane.beads[static_cast<std::size_t>(k)]);
    particles.positions[at] += kept(k) - given(k);
    particles.positions[at + 1] += kept(n + k) - given(n + k);
  }
  return (kept - given).lpNorm<Eigen::Infinity>();
}

double largest_area(std::span<const double> lengths) {
  assert(lengths.size() >= 3);
  // The sides are chords of the circle through the corners. Seen from its centre, their angles add
  // up to a full turn if the centre is inside the polygon; otherwise it lies beyond the longest
  // side, whose angle is then the sum of the others. The curvature 1/radius is found by bisection.
  const auto longest = std::ranges::max_element(lengths);
  double others = 0;
  for (auto side = lengths.begin(); side != lengths.end(); ++side)
    if (side != longest) others += std::asin(std::min(1.0, *side / *longest));
  const bool is_inside = others >= std::numbers::pi / 2;
  double low = 0, high = 2 / *longest;
  for (int n = 0; n < MembraneShapeTuning::kHalvings; ++n) {
    const double curvature = (low + high) / 2;
    double sum = 0;
    for (auto side = lengths.begin(); side != lengths.end(); ++side)
      sum += (side == longest && !is_inside ? -1 : 1) *
             std::asin(std::min(1.0, *side * curvature / 2));
    // If the centre lies beyond the longest side, whose angle is subtracted, the sum is 0 at the
    // solution and at the curvature 0, and > 0 between them.
    const bool is_below = is_inside ? sum < std::numbers::pi : sum > 0;
    (is_below ? low : high) = curvature;
  }
  const double radius = 2 / (low + high);
  double area = 0;
  for (auto side = lengths.begin(); side != lengths.end(); ++side)
    area += (side == longest && !is_inside ? -1 : 1) * *side / 2 *
            std::sqrt(std::max(0.0, radius * radius - *side * *side / 4));
  return area;
}

std::vector<double> corners_of(const Membrane& membrane, const Particles& particles) {
  const auto necklace = necklace_of(membrane, particles);
  std::vector<double> corners;
  for (Eigen::Index k = 0; k < membrane.count(); ++k) {
    corners.push_back(necklace(k));
    corners.push_back(necklace(membrane.count() + k));
  }
  return corners;
}

bool is_inside(const std::array<double, 2>& x, std::span<const double> polygon) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size() / 2; ++i) {
    const auto a = corner(polygon, i), b = corner(polygon, i + 1);
    if ((a[1] > x[1]) != (b[1] > x[1]) && (side(a, b, x) > 0) == (b[1] > a[1])) inside = !inside;
  }
  return inside;
}

bool do_cross(std::span<const double> first, std::span<const double> second) {
  for (std::size_t i = 0; i < first.size() / 2; ++i)
    for (std::size_t j = 0; j < second.size() / 2; ++j)
      if (sides_cross(first, i, second, j)) return true;
  return false;
}

bool do_contain(std::span<const double> first, std::span<const double> second) {
  return is_inside(corner(first, 0), second) || is_inside(corner(second, 0), first);
}

bool crosses_itself(std::span<const double> polygon) {
  const auto count = polygon.size() / 2;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 2; j < count; ++j)
      if (!(i == 0 && j + 1 == count) && sides_cross(polygon, i, polygon, j)) return true;
  return false;
}

}  // namespace viscontact::particles
