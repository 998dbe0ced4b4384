// Discs in plane Stokes flow by a double layer of density q on discs and walls.
#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "tests/oracles/discs/discs_in_stokes_flow.hpp"

namespace viscontact {
namespace {

// The velocity of the double layer at x is
//     sum over y of (1/pi) r (r.q)(r.n)/|r|^4 ds,   r = x - y, n the normal out of disc or
//     container,
// or in complex numbers, with products of vectors a.b = Re(conj(a) b),
//     (1/(4 pi)) [conj(q n) r/conj(r)^2 + 2 (q.n)/conj(r) + q n/r] ds.
// Its value on a boundary is the principal value, + q/2 outside of the curve and - q/2 inside. In a
// periodic domain 1/r is summed over the images, and conj(q n) r/conj(r)^2 likewise.

using Complex = std::complex<double>;
using std::conj;
using std::numbers::pi;
constexpr Complex kI(0, 1);

double dot(Complex a, Complex b) { return (conj(a) * b).real(); }

struct Node {
  Complex place, normal;
  double weight;     ///< length of the boundary
  double curvature;  ///< of a disc or round container 1/radius, of a wall 0
  int curve;
};

/// Sums over the periodic images of r: of 1/r, of r/conj(r)^2, and of ln |r|^2 and r/conj(r), which
/// belong to a force. Each is known up to a constant.
struct Sums {
  Complex inverse, squared, ratio;
  double log = 0;
};

/// Images beyond this many rows change the sums by less than exp(-2 pi 8) = 1e-22.
constexpr int kRows = 8;

Sums sums_of(const DiscProblem& problem, Complex r) {
  Sums sums;
  if (problem.domain == DiscDomain2d::kRoundContainer) {
    sums.inverse = 1.0 / r;
    sums.squared = r / conj(r * r);
    sums.log = 2 * std::log(std::abs(r));
    sums.ratio = r / conj(r);
    return sums;
  }
  const bool cell = problem.domain == DiscDomain2d::kSquareCell;
  const double period = cell ? problem.size : problem.length;
  const Complex z = pi * r / period;  // the period is pi
  const int rows = cell ? kRows : 0;
  for (int row = -rows; row <= rows; ++row) {
    const Complex place = z + row * pi * kI;
    const Complex sine = std::sin(place), cot = std::cos(place) / sine;
    const double height = place.imag(), far = std::abs(row) * pi;
    sums.inverse += cot;
    sums.squared += conj(cot) + 2.0 * height * kI * conj(1.0 / (sine * sine));
    sums.log += 2 * (std::log(2 * std::abs(sine)) - far);
    sums.ratio += 2.0 * height * kI * conj(cot) + 2 * far;
  }
  if (cell) {
    // The sum by rows is periodic along x; these terms make it so along y, with the mean 0.
    const double y = r.imag() / period;
    sums.inverse += 2.0 * y * kI;
    sums.squared -= 2.0 * y * kI;
    sums.log -= 2 * pi * y * y + pi / 3;
    sums.ratio += 2 * pi * y * y + pi / 3;
  }
  sums.inverse *= pi / period;
  sums.squared *= pi / period;
  return sums;
}

/// Velocity at x by the density q at a node.
Complex layer(const DiscProblem& problem, const Node& at, const Node& from, Complex q, bool same) {
  if (same) {
    const Complex tangent = kI * from.normal;
    return -from.curvature / (2 * pi) * dot(tangent, q) * tangent * from.weight;
  }
  const Sums sums = sums_of(problem, at.place - from.place);
  const Complex qn = q * from.normal;
  return from.weight / (4 * pi) *
         (conj(qn) * sums.squared + 2 * dot(q, from.normal) * conj(sums.inverse) +
          qn * sums.inverse);
}

/// Force and torque of a disc on the fluid, at its centre.
Complex singularities(const DiscProblem& problem, Complex z) {
  Complex velocity = 0;
  for (const auto& disc : problem.discs) {
    const Sums sums = sums_of(problem, z - disc.centre);
    velocity += (-disc.force * sums.log + conj(disc.force) * sums.ratio) / (8 * pi) +
                kI * disc.torque / (4 * pi) * conj(sums.inverse);
  }
  return velocity;
}

/// Nodes are denser towards the nearest other disc, by the conformal map of the disc onto itself
/// that moves its centre by `shift` radii.
void add_disc(const DiscProblem& problem, std::size_t k, int count, std::vector<Node>& nodes) {
  const auto& disc = problem.discs[k];
  double gap = disc.radius;
  Complex towards = 1;
  for (const auto& other : problem.discs) {
    const Complex way = other.centre - disc.centre;
    if (&other == &disc || std::abs(way) - disc.radius - other.radius >= gap) continue;
    gap = std::abs(way) - disc.radius - other.radius;
    towards = way / std::abs(way);
  }
  const double narrow = std::cbrt(gap / disc.radius), shift = (1 - narrow) / (1 + narrow);
  for (int i = 0; i < count; ++i) {
    const Complex e = std::exp(2 * pi * i / count * kI);
    const Complex normal = towards * (e + shift) / (1.0 + shift * e);
    const double density = (1 - shift * shift) / std::norm(1.0 + shift * e);
    nodes.push_back({disc.centre + disc.radius * normal, normal,
                     2 * pi / count * disc.radius * density, 1 / disc.radius, static_cast<int>(k)});
  }
}

std::vector<Node> nodes_of(const DiscProblem& problem, int disc_nodes, int wall_nodes) {
  std::vector<Node> nodes;
  for (std::size_t k = 0; k < problem.discs.size(); ++k) add_disc(problem, k, disc_nodes, nodes);
  const int wall = static_cast<int>(problem.discs.size());
  if (problem.domain == DiscDomain2d::kSquareCell) return nodes;
  for (int i = 0; i < wall_nodes; ++i) {
    if (problem.domain == DiscDomain2d::kRoundContainer) {
      const Complex e = std::exp(2 * pi * i / wall_nodes * kI);
      nodes.push_back(
          {problem.size * e, e, 2 * pi * problem.size / wall_nodes, 1 / problem.size, wall});
      continue;
    }
    for (const double side : {1.0, -1.0})
      nodes.push_back({{problem.length * i / wall_nodes, side * problem.size / 2},
                       side * kI,
                       problem.length / wall_nodes,
                       0,
                       wall});
  }
  return nodes;
}

}  // namespace

DiscAnswer discs_by_boundary_integral(const DiscProblem& problem, int disc_nodes, int wall_nodes) {
  const auto nodes = nodes_of(problem, disc_nodes, wall_nodes);
  const auto count = static_cast<Eigen::Index>(nodes.size());
  const int discs = static_cast<int>(problem.discs.size());
  const bool channel = problem.domain == DiscDomain2d::kChannel;
  const bool cell = problem.domain == DiscDomain2d::kSquareCell;
  const auto linear_flow = [&](Complex z) {
    return problem.strain * conj(z) + kI * problem.rotation * z;
  };

  std::vector<double> perimeter(static_cast<std::size_t>(discs) + 1, 0.0);
  for (const auto& node : nodes) perimeter[static_cast<std::size_t>(node.curve)] += node.weight;

  // A channel has two more unknowns, the coefficients of the flows y and y^2 along x, because a
  // double layer on both walls cannot make a shear or a pressure gradient.
  const Eigen::Index extra = channel ? 2 : 0;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(2 * count + extra, 2 * count + extra);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * count + extra);
  const double half = problem.size / 2;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& at = nodes[static_cast<std::size_t>(i)];
    const bool on_disc = at.curve < discs;
    Complex given = singularities(problem, at.place);
    if (cell)
      given += linear_flow(at.place);
    else if (!on_disc)
      given -= linear_flow(at.place);
    right(2 * i) = -given.real();
    right(2 * i + 1) = -given.imag();
    for (Eigen::Index j = 0; j < count; ++j) {
      const auto& from = nodes[static_cast<std::size_t>(j)];
      for (int part = 0; part < 2; ++part) {
        const Complex q = part == 0 ? Complex(1) : kI;
        Complex value = layer(problem, at, from, q, i == j);
        if (i == j) value += on_disc ? q / 2.0 : -q / 2.0;
        if (at.curve == from.curve) {
          const double share = from.weight / perimeter[static_cast<std::size_t>(at.curve)];
          if (on_disc) {
            // The rigid part of the density is minus the motion of the disc.
            const auto& disc = problem.discs[static_cast<std::size_t>(at.curve)];
            const Complex arm = from.place - disc.centre;
            value += share * (q + dot(kI * arm, q) / (disc.radius * disc.radius) * kI *
                                      (at.place - disc.centre));
          } else {
            value += share * dot(from.normal, q) * at.normal;
          }
        }
        // The layer's own mean velocity in a cell is that of its flux out of the disc.
        if (cell)
          value -= (from.place - problem.discs[0].centre) * dot(q, from.normal) * from.weight /
                   (problem.size * problem.size);
        matrix(2 * i, 2 * j + part) += value.real();
        matrix(2 * i + 1, 2 * j + part) += value.imag();
      }
    }
    if (channel) {
      const double y = at.place.imag() / half;
      matrix(2 * i, 2 * count) = y;
      matrix(2 * i, 2 * count + 1) = y * y;
    }
  }
  if (channel) {
    // No difference of the walls' mean densities along x, and no flux halfway between two images.
    // The flux is the mean over x of all kernels, less the part by which the layer on a disc, which
    // is a source within it, changes it along the channel.
    for (Eigen::Index j = 0; j < count; ++j) {
      const auto& from = nodes[static_cast<std::size_t>(j)];
      if (from.curve == discs)
        matrix(2 * count, 2 * j) = from.normal.imag() * from.weight / problem.length;
      for (int part = 0; part < 2; ++part) {
        const Complex q = part == 0 ? Complex(1) : kI;
        double flux = -from.place.imag() * (q * from.normal).imag();
        if (from.curve < discs) flux += from.place.real() * dot(q, from.normal);
        matrix(2 * count + 1, 2 * j + part) = flux * from.weight / problem.length;
      }
    }
    matrix(2 * count + 1, 2 * count + 1) = 2 * half / 3;
    for (const auto& disc : problem.discs)
      right(2 * count + 1) += disc.force.real() * half * half / (2 * problem.length);
  }
  const Eigen::VectorXd density = matrix.partialPivLu().solve(right);

  DiscAnswer answer;
  answer.velocities.assign(static_cast<std::size_t>(discs), 0);
  answer.spins.assign(static_cast<std::size_t>(discs), 0);
  Complex stresslets = 0;
  for (Eigen::Index j = 0; j < count; ++j) {
    const auto& node = nodes[static_cast<std::size_t>(j)];
    if (node.curve >= discs) continue;
    const auto k = static_cast<std::size_t>(node.curve);
    const auto& disc = problem.discs[k];
    const Complex q(density(2 * j), density(2 * j + 1));
    const double share = node.weight / perimeter[k];
    answer.velocities[k] -= share * q;
    answer.spins[k] -=
        share * dot(kI * (node.place - disc.centre), q) / (disc.radius * disc.radius);
    stresslets += q * node.normal * node.weight;
  }
  // Far away the layer on a disc is a stresslet; reciprocal theorem with the linear flow.
  if (std::abs(problem.strain) > 0) {
    const double area =
        channel ? problem.size * problem.length : problem.size * problem.size * (cell ? 1 : pi);
    answer.added_dissipation =
        -(conj(problem.strain) * stresslets).real() / (2 * std::norm(problem.strain) * area);
  }
  return answer;
}

}  // namespace viscontact
