// Polygons through the beads of membranes.
#include "viscontact/membranes/necklace.hpp"

#include <cassert>
#include <cmath>

#include "viscontact/common/matrices/decompositions.hpp"
#include "viscontact/membranes/membrane_curve.hpp"
#include "viscontact/membranes/membrane_shape.hpp"
#include "viscontact/particles/domain/periods.hpp"

namespace viscontact::particles {
namespace {

/// Free choices of restore_necklace().
struct NecklaceTuning {
  // The limit only ends a search that fails.
  static constexpr int kMostRounds = 50;
  // Bounds of the errors of distances and area, divided by the mean distance and its square. kExact
  // is near rounding errors. Newton's method is quadratic: one more step after kNearlyExact also
  // leaves only rounding errors.
  static constexpr double kExact = 1e-13, kNearlyExact = 1e-10;
};

/// Position of bead k, which is counted around the polygon: -1 is the last bead.
Eigen::Vector2d bead(const Eigen::VectorXd& necklace, Eigen::Index k) {
  assert(k >= -necklace.size() / 2);
  const auto n = necklace.size() / 2;
  const auto i = (k + n) % n;
  return {necklace(i), necklace(n + i)};
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

AreaMoments moments_of_polygon(const Eigen::VectorXd& necklace) {
  const auto n = necklace.size() / 2;
  const Eigen::Vector2d mean(necklace.head(n).mean(), necklace.tail(n).mean());
  double area = 0, mx = 0, my = 0;
  AreaMoments moments{mean.x(), mean.y()};
  // Sums over the triangles that each pair of neighbours forms with the mean of the beads.
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Vector2d a = bead(necklace, k) - mean, b = bead(necklace, k + 1) - mean;
    const double twice = cross(a, b);
    area += twice / 2;
    mx += twice * (a.x() + b.x()) / 6;
    my += twice * (a.y() + b.y()) / 6;
    moments.xx += twice * (a.x() * a.x() + a.x() * b.x() + b.x() * b.x()) / 12;
    moments.yy += twice * (a.y() * a.y() + a.y() * b.y() + b.y() * b.y()) / 12;
    moments.xy +=
        twice * (2 * a.x() * a.y() + a.x() * b.y() + b.x() * a.y() + 2 * b.x() * b.y()) / 24;
  }
  moments.move_to_centre(area, mx, my);
  return moments;
}

}  // namespace

Eigen::VectorXd necklace_of(const Membrane& membrane, const Particles& particles) {
  const Eigen::Index n = membrane.count();
  Eigen::VectorXd necklace(2 * n);
  Vector last{};
  for (Eigen::Index k = 0; k < n; ++k) {
    const Vector x = particles.position(index_of(membrane.beads[static_cast<std::size_t>(k)]));
    last = k == 0 ? x : last + nearest_image(particles.cell, x - last);
    necklace(k) = last[0];
    necklace(n + k) = last[1];
  }
  return necklace;
}

Eigen::VectorXd distances_of(const Eigen::VectorXd& necklace) {
  Eigen::VectorXd distances(necklace.size() / 2);
  for (Eigen::Index k = 0; k < distances.size(); ++k)
    distances(k) = (bead(necklace, k + 1) - bead(necklace, k)).norm();
  return distances;
}

double area_of(const Eigen::VectorXd& necklace) {
  // Relative to the first bead, rounding errors do not grow with the distance from the origin.
  const Eigen::Vector2d first = bead(necklace, 0);
  double twice = 0;
  for (Eigen::Index k = 1; k + 1 < necklace.size() / 2; ++k)
    twice += cross(bead(necklace, k) - first, bead(necklace, k + 1) - first);
  return twice / 2;
}

Eigen::VectorXd area_gradient(const Eigen::VectorXd& necklace) {
  const auto n = necklace.size() / 2;
  Eigen::VectorXd gradient(2 * n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Vector2d across = bead(necklace, k + 1) - bead(necklace, k - 1);
    gradient(k) = across.y() / 2;
    gradient(n + k) = -across.x() / 2;
  }
  return gradient;
}

Eigen::VectorXd turns_of(const Eigen::VectorXd& necklace) {
  Eigen::VectorXd turns(necklace.size() / 2);
  for (Eigen::Index k = 0; k < turns.size(); ++k) {
    const Eigen::Vector2d before = bead(necklace, k) - bead(necklace, k - 1),
                          after = bead(necklace, k + 1) - bead(necklace, k);
    turns(k) = std::atan2(cross(before, after), before.dot(after));
  }
  return turns;
}

double bending_energy(const Eigen::VectorXd& necklace, const Eigen::VectorXd& lengths) {
  assert(necklace.size() == 2 * lengths.size());
  const auto turns = turns_of(necklace);
  const auto n = turns.size();
  double energy = 0;
  for (Eigen::Index k = 0; k < n; ++k)
    energy += turns(k) * turns(k) / (lengths((k + n - 1) % n) + lengths(k));
  return energy;
}

bool restore_necklace(const Eigen::VectorXd& lengths, double area, Eigen::VectorXd& necklace) {
  assert(necklace.size() == 2 * lengths.size() && lengths.size() >= 3);
  const auto n = lengths.size();
  const double size = lengths.mean();
  for (int round = 0; round < NecklaceTuning::kMostRounds; ++round) {
    Eigen::VectorXd missing(n + 1);
    missing.head(n) = (lengths - distances_of(necklace)) / size;
    missing(n) = (area - area_of(necklace)) / (size * size);
    if (!missing.allFinite()) return false;
    const double largest = missing.lpNorm<Eigen::Infinity>();
    if (largest < NecklaceTuning::kExact) return true;
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(n + 1, 2 * n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto next = (k + 1) % n;
      const Eigen::Vector2d along = (bead(necklace, k + 1) - bead(necklace, k)).normalized();
      rows(k, k) = -along.x();
      rows(k, n + k) = -along.y();
      rows(k, next) = along.x();
      rows(k, n + next) = along.y();
    }
    rows.row(n) = area_gradient(necklace).transpose() / size;
    const Eigen::MatrixXd products = rows * rows.transpose();
    const Eigen::VectorXd change = rows.transpose() * products.ldlt().solve(missing);
    if (!change.allFinite()) return false;
    necklace += size * change;
    if (largest < NecklaceTuning::kNearlyExact) return true;
  }
  return false;
}

MembraneMeasures measure_necklace(const Membrane& membrane, const Particles& particles) {
  const auto necklace = necklace_of(membrane, particles);
  const auto n = necklace.size() / 2;
  Eigen::VectorXd velocities(2 * n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Vector u = particles.velocity(index_of(membrane.beads[static_cast<std::size_t>(k)]));
    velocities(k) = u[0];
    velocities(n + k) = u[1];
  }
  const auto circulation = [&](const Eigen::VectorXd& moving) {
    double sum = 0;
    for (Eigen::Index k = 0; k < n; ++k)
      sum += (bead(moving, k) + bead(moving, k + 1)).dot(bead(necklace, k + 1) - bead(necklace, k));
    return sum / 2;
  };
  return measure({.area = area_of(necklace),
                  .perimeter = distances_of(necklace).sum(),
                  .moments = moments_of_polygon,
                  .circulation = circulation},
                 necklace, velocities);
}

}  // namespace viscontact::particles
