// Reduction of lattices, and units of the fields of the square root of 5 and of cos(2 pi/7).
#include "viscontact/suspensions/cell/strained_lattice.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "viscontact/suspensions/values/affine_motion.hpp"

namespace viscontact::suspensions {
namespace {

using particles::cross;

struct LatticeTuning {
  // A vector is replaced by a shorter one only if it is shorter by this part, so that rounding
  // errors cannot exchange vectors for ever.
  static constexpr double kLeastGain = 1e-12;
  // Gradients, relative: what counts as rounding errors of a flow that is planar or symmetric.
  static constexpr double kRounding = 1e-12;
  static constexpr double kSame = 1e-9;
  // Times at which the heights of a lattice are compared, over this Hencky strain, in which a
  // planar flow repeats 20 times.
  static constexpr int kSamples = 4000;
  static constexpr double kSampledStrain = 20;
  // Hencky strain against the flow beyond which the part of a lattice that fades with the flow has
  // grown to exp(20) of the rest, so that rounding errors have reached 1e-7.
  static constexpr double kMostReversed = 10;
};

double square(const Vector& x) { return dot(x, x); }

/// Replaces the last vector by the shortest one that differs by multiples of the first two, which
/// are reduced. Returns false if it is the shortest one.
bool shorten_last(Lattice& v) {
  const double aa = square(v[0]), bb = square(v[1]), ab = dot(v[0], v[1]);
  const double a = dot(v[0], v[2]), b = dot(v[1], v[2]), determinant = aa * bb - ab * ab;
  const double x = std::floor((a * bb - b * ab) / determinant);
  const double y = std::floor((b * aa - a * ab) / determinant);
  // The nearest of the four corners of a reduced basis is the nearest one of all.
  Vector best = v[2];
  double least = (1 - LatticeTuning::kLeastGain) * square(v[2]);
  bool found = false;
  for (const double i : {0.0, 1.0})
    for (const double j : {0.0, 1.0}) {
      const Vector trial = v[2] - (x + i) * v[0] - (y + j) * v[1];
      if (!(square(trial) < least)) continue;
      least = square(trial);
      best = trial;
      found = true;
    }
  v[2] = best;
  return found;
}

/// Order and signs of the vectors.
void align(Lattice& v) {
  std::array<std::size_t, 3> order{0, 1, 2}, best = order;
  double largest = -1;
  do {
    double along = 0;
    for (std::size_t d = 0; d < 3; ++d) along += std::abs(v[order[d]][d]) / norm(v[order[d]]);
    if (along > largest + LatticeTuning::kSame) {
      largest = along;
      best = order;
    }
  } while (std::ranges::next_permutation(order).found);
  v = {v[best[0]], v[best[1]], v[best[2]]};
  for (std::size_t d = 0; d < 3; ++d)
    if (v[d][d] < 0) v[d] = -1.0 * v[d];
  if (dot(cross(v[0], v[1]), v[2]) < 0) v[2] = -1.0 * v[2];
}

double largest_entry(const Matrix& m) {
  double largest = 0;
  for (const auto& row : m)
    for (const double entry : row) largest = std::max(largest, std::abs(entry));
  return largest;
}

Matrix transposed(const Matrix& m) {
  Matrix result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[i][j] = m[j][i];
  return result;
}

/// The unit vector along which the flow neither has a component nor changes, so that the flow is
/// planar; 0 if there is none, or if the flow in the plane does not draw lines out exponentially.
Vector axis_of_planar_extension(const Matrix& g) {
  const double allowed = LatticeTuning::kRounding * largest_entry(g);
  Vector axis{};
  for (const auto& [i, j] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{2, 0}}) {
    const Vector normal = cross(g[static_cast<std::size_t>(i)], g[static_cast<std::size_t>(j)]);
    if (norm(normal) > norm(axis)) axis = normal;
  }
  const double sum = largest_entry(g);
  if (!(norm(axis) > LatticeTuning::kRounding * sum * sum)) return {};
  axis = (1 / norm(axis)) * axis;
  if (norm(times(g, axis)) > allowed || norm(times(transposed(g), axis)) > allowed) return {};
  double trace_of_square = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) trace_of_square += g[i][j] * g[j][i];
  return trace_of_square > LatticeTuning::kRounding * sum * sum ? axis : Vector{};
}

bool is_symmetric(const Matrix& g) {
  const double allowed = LatticeTuning::kRounding * largest_entry(g);
  return std::abs(g[0][1] - g[1][0]) <= allowed && std::abs(g[1][2] - g[2][1]) <= allowed &&
         std::abs(g[2][0] - g[0][2]) <= allowed;
}

/// The axes of a symmetric gradient, near x, y and z, right-handed.
Lattice axes_of(const Matrix& g) {
  const bool is_diagonal = g[0][1] == 0 && g[1][2] == 0 && g[2][0] == 0;
  if (is_diagonal) return {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};
  Eigen::Matrix3d symmetric;
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      symmetric(i, j) = (g[a][b] + g[b][a]) / 2;
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(symmetric);
  Lattice axes;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = solver.eigenvectors().col(k);
    axes[static_cast<std::size_t>(k)] = {axis[0], axis[1], axis[2]};
  }
  align(axes);
  return axes;
}

/// The plane of a planar extension, and how its components grow there.
struct PlaneOfFlow {
  std::size_t i = 0, j = 0, k = 0;   // the axes near the plane, and the one across it
  Vector axis{}, first{}, second{};  // across the plane, and in it near the axes i and j
  double rate = 0;
  std::array<double, 2> grows{}, shrinks{};  // left eigenvectors of the rates +-rate

  explicit PlaneOfFlow(const Matrix& gradient) : axis(axis_of_planar_extension(gradient)) {
    for (std::size_t d = 1; d < 3; ++d)
      if (std::abs(axis[d]) > std::abs(axis[k]) + LatticeTuning::kSame) k = d;
    if (axis[k] < 0) axis = -1.0 * axis;
    i = (k + 1) % 3;
    j = (k + 2) % 3;
    first[i] = 1;
    first = first - axis[i] * axis;
    first = (1 / norm(first)) * first;
    second = cross(axis, first);
    const double a = dot(first, times(gradient, first)), b = dot(first, times(gradient, second));
    const double c = dot(second, times(gradient, first));
    rate = std::sqrt(a * a + b * c);
    const auto left = [&](double r) {
      const std::array<double, 2> one{c, r - a}, other{r + a, b};
      const auto size = [](const auto& x) { return std::hypot(x[0], x[1]); };
      auto chosen = size(one) > size(other) ? one : other;
      const double length = size(chosen);
      for (auto& x : chosen) x /= length;
      return chosen;
    };
    grows = left(rate);
    shrinks = left(-rate);
  }
};

/// Components of the period vectors that grow in the golden ratio, (9.25): a unit of the field of
/// the square root of 5, which is near no rational number, repeats them.
struct GoldenTurn {
  std::array<double, 2> form{};
  double angle = 0;  // of the box; the least that gives its edges p and q these components

  GoldenTurn(const std::array<double, 2>& grows, double p, double q) {
    const double golden = std::numbers::phi;
    double least = std::numeric_limits<double>::infinity();
    for (const std::array<double, 2>& trial : {std::array{golden, -1.0}, std::array{1.0, golden},
                                               std::array{golden, 1.0}, std::array{1.0, -golden}}) {
      double turned = std::atan2(grows[1], grows[0]) - std::atan2(trial[1] / q, trial[0] / p);
      turned -= std::numbers::pi * std::round(turned / std::numbers::pi);
      if (std::abs(turned) > least - LatticeTuning::kSame) continue;
      least = std::abs(turned);
      angle = turned;
      form = trial;
    }
  }
};

}  // namespace

Lattice reduced(Lattice v) {
  for (;;) {
    std::ranges::sort(v, {}, square);
    const Vector shorter = v[1] - std::round(dot(v[0], v[1]) / square(v[0])) * v[0];
    if (square(shorter) < (1 - LatticeTuning::kLeastGain) * square(v[1])) {
      v[1] = shorter;
      continue;
    }
    if (!shorten_last(v)) break;
  }
  align(v);
  return v;
}

Matrix fractions_of(const Lattice& v) {
  const double volume = dot(cross(v[0], v[1]), v[2]);
  return {(1 / volume) * cross(v[1], v[2]), (1 / volume) * cross(v[2], v[0]),
          (1 / volume) * cross(v[0], v[1])};
}

Vector heights_of(const Lattice& lattice) {
  const Matrix rows = fractions_of(lattice);
  return {1 / norm(rows[0]), 1 / norm(rows[1]), 1 / norm(rows[2])};
}

bool are_same(const Lattice& a, const Lattice& b) {
  const Matrix fractions = fractions_of(a);
  for (const auto& period : b)
    for (const double count : times(fractions, period))
      if (!(std::abs(count - std::round(count)) <= LatticeTuning::kSame)) return false;
  return true;
}

Lattice carried_lattice(const Matrix& gradient, double t, const Lattice& lattice) {
  Lattice moved;
  for (std::size_t k = 0; k < 3; ++k) moved[k] = carried(gradient, t, lattice[k]);
  return reduced(moved);
}

StrainedLattice::Kind StrainedLattice::kind_of(const Matrix& gradient) {
  if (norm(axis_of_planar_extension(gradient)) > 0) return Kind::kPlanar;
  return is_symmetric(gradient) && largest_entry(gradient) > 0 ? Kind::kCubic : Kind::kAsTheBox;
}

StrainedLattice::StrainedLattice(const Vector& lengths, const Matrix& gradient, bool may_turn) {
  for (std::size_t d = 0; d < 3; ++d) box_[d][d] = lengths[d];
  if (may_turn) kind_ = kind_of(gradient);
  const auto [shortest, longest] = std::ranges::minmax(lengths);
  if (kind_ == Kind::kCubic && longest - shortest > LatticeTuning::kRounding * longest)
    kind_ = Kind::kAsTheBox;
  if (kind_ == Kind::kPlanar) turn_in_plane(lengths, gradient);
  if (kind_ == Kind::kCubic) turn_cube(lengths[0], gradient);
}

void StrainedLattice::turn_in_plane(const Vector& lengths, const Matrix& gradient) {
  const PlaneOfFlow plane(gradient);
  const auto i = plane.i, j = plane.j, k = plane.k;
  const auto &axis = plane.axis, &first = plane.first, &second = plane.second;
  const auto &grows = plane.grows, &shrinks = plane.shrinks;
  const double p = lengths[i], q = lengths[j];
  const GoldenTurn golden(grows, p, q);
  const auto& form = golden.form;
  const double cosine = std::cos(golden.angle), sine = std::sin(golden.angle);
  const Vector edge = cosine * first + sine * second, across = cosine * second - sine * first;
  for (std::size_t d = 0; d < 3; ++d) {
    turn_[d][i] = edge[d];
    turn_[d][j] = across[d];
    turn_[d][k] = axis[d];
  }

  // Right eigenvectors from the left ones.
  const double determinant = grows[0] * shrinks[1] - grows[1] * shrinks[0];
  directions_ = {(1 / determinant) * (shrinks[1] * first - shrinks[0] * second),
                 (1 / determinant) * (grows[0] * second - grows[1] * first), axis};
  rates_ = {plane.rate, -plane.rate, 0};
  const auto component = [&](const std::array<double, 2>& row, const Vector& x) {
    return row[0] * dot(first, x) + row[1] * dot(second, x);
  };
  const std::array<double, 2> other{-form[1], form[0]};
  const double size = form[0] * form[0] + form[1] * form[1];
  const double growing =
      (p * component(grows, edge) * form[0] + q * component(grows, across) * form[1]) / size;
  const std::array<double, 2> row{p * component(shrinks, edge), q * component(shrinks, across)};
  const double shrinking = (row[0] * other[0] + row[1] * other[1]) / size;
  double fading = (row[0] * form[0] + row[1] * form[1]) / size;
  if (std::abs(fading) <= LatticeTuning::kRounding * std::abs(shrinking)) fading = 0;
  for (const auto& [d, at] : {std::pair{i, 0U}, std::pair{j, 1U}}) {
    forms_[0][d] = growing * form[at];
    forms_[1][d] = shrinking * other[at];
    fading_[d] = fading * form[at];
  }
  forms_[2][k] = lengths[k];
}

void StrainedLattice::turn_cube(double edge, const Matrix& gradient) {
  directions_ = axes_of(gradient);
  // Unit eigenvectors of the matrices of (9.26), 2/sqrt(7) sin(n pi/7).
  const auto entry = [](int n) { return 2 / std::sqrt(7.0) * std::sin(n * std::numbers::pi / 7); };
  const double a = entry(3), b = entry(1), c = entry(2);
  const Matrix cubic{Vector{a, b, -c}, Vector{-c, a, -b}, Vector{b, c, a}};
  for (std::size_t i = 0; i < 3; ++i) {
    forms_[i] = edge * cubic[i];
    rates_[i] = dot(directions_[i], times(gradient, directions_[i]));
  }
  for (std::size_t d = 0; d < 3; ++d)
    for (std::size_t m = 0; m < 3; ++m) {
      turn_[d][m] = 0;
      for (std::size_t i = 0; i < 3; ++i) turn_[d][m] += directions_[i][d] * cubic[i][m];
    }
}

Lattice StrainedLattice::start() const {
  Lattice lattice;
  for (std::size_t k = 0; k < 3; ++k) lattice[k] = times(turn_, box_[k]);
  return lattice;
}

Lattice StrainedLattice::at(double t) const {
  assert(kind_ != Kind::kAsTheBox);
  Vector strains = t * rates_;
  double repeats = 0;
  if (kind_ == Kind::kPlanar) {
    const double unit = 2 * std::log(std::numbers::phi);
    repeats = std::round(strains[0] / unit);
    strains = {strains[0] - repeats * unit, strains[1] + repeats * unit, 0};
    repeats *= unit;
  } else {
    // Logarithms of the squares of the units 1 + 2 cos(2 n pi/7), (9.26), in two orders.
    const auto log_unit = [](int n) {
      return 2 * std::log(std::abs(1 + 2 * std::cos(2 * n * std::numbers::pi / 7)));
    };
    const Vector one{log_unit(3), log_unit(2), log_unit(1)}, other{one[1], one[2], one[0]};
    const double determinant = one[0] * other[1] - one[1] * other[0];
    const double x = std::round((strains[0] * other[1] - strains[1] * other[0]) / determinant);
    const double y = std::round((strains[1] * one[0] - strains[0] * one[1]) / determinant);
    strains = strains - x * one - y * other;
  }
  Lattice lattice{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector form =
        i == 1 && fading_ != Vector{} ? forms_[i] + std::exp(-2 * repeats) * fading_ : forms_[i];
    for (std::size_t k = 0; k < 3; ++k)
      lattice[k] = lattice[k] + (std::exp(strains[i]) * form[k]) * directions_[i];
  }
  return reduced(lattice);
}

double StrainedLattice::earliest() const {
  return fading_ != Vector{} ? -LatticeTuning::kMostReversed / rates_[0]
                             : -std::numeric_limits<double>::infinity();
}

double StrainedLattice::least_height(double from) const {
  assert(from <= 0);
  if (kind_ == Kind::kAsTheBox || from < earliest()) return 0;
  const double rate = std::max(std::abs(rates_[0]), std::abs(rates_[1]));
  double least = std::numeric_limits<double>::infinity();
  const auto sample = [&](double t) {
    least = std::min(least, std::ranges::min(heights_of(at(t))));
  };
  for (int k = 0; k <= LatticeTuning::kSamples; ++k)
    sample(LatticeTuning::kSampledStrain * k / (LatticeTuning::kSamples * rate));
  // The other lattices repeat against the flow what they do with it.
  if (fading_ == Vector{}) return least;
  const double step = LatticeTuning::kSampledStrain / (LatticeTuning::kSamples * rate);
  for (double t = from; t < 0; t += step) sample(t);
  return least;
}

}  // namespace viscontact::suspensions
