#include "tests/oracles/inertial_motion.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "tests/oracles/gauss_legendre.hpp"
#include "tests/oracles/sinh_minus_argument.hpp"

namespace viscontact {
namespace {

using Real = long double;

/// Butcher's array of Radau IIA: nodes c in (0, 1], the last 1, and a_ij = int_0^{c_i} of the j-th
/// Lagrange polynomial.
template <int stages>
struct Radau {
  Eigen::Matrix<Real, stages, 1> c;
  Eigen::Matrix<Real, stages, stages> a, inverse;

  Radau() {
    // Zeros of P_s - P_{s-1} on [-1, 1]: 1, and one between each two neighbouring zeros of P_s and
    // of P_{s-1}.
    const auto defect = [](Real x) {
      Legendre legendre(x);
      while (legendre.n < stages) legendre.advance();
      return legendre.p - legendre.p_before;
    };
    // Between 1 and the largest zero of P_s there is none, and the polynomial changes its sign
    // between neighbours of P_s' zeros.
    auto gauss = gauss_legendre(stages);
    std::ranges::sort(gauss, {}, &QuadratureNode::x);
    c(stages - 1) = 1;
    for (int i = 0; i + 1 < stages; ++i) {
      Real low = gauss[i].x, high = gauss[i + 1].x;
      const bool rises = defect(high) > 0;
      for (Real x = (low + high) / 2; low < x && x < high; x = (low + high) / 2)
        ((defect(x) > 0) == rises ? high : low) = x;
      c(i) = (1 + low) / 2;
    }
    for (int i = 0; i < stages; ++i)
      for (int j = 0; j < stages; ++j) {
        a(i, j) = 0;
        for (const auto& node : gauss) {
          const Real x = c(i) * (1 + node.x) / 2;
          Real lagrange = 1;
          for (int k = 0; k < stages; ++k)
            if (k != j) lagrange *= (x - c(k)) / (c(j) - c(k));
          a(i, j) += c(i) * node.weight / 2 * lagrange;
        }
      }
    inverse = a.inverse();
  }
};

}  // namespace

InertialMotion::InertialMotion(InertialProblem problem, Real tolerance)
    : problem_(std::move(problem)),
      tolerance_(tolerance),
      state_{std::log(problem_.initial_gap), problem_.initial_velocity / problem_.initial_gap} {}

Real InertialMotion::gap() const { return std::exp(state_[0]); }

Real InertialMotion::velocity() const { return state_[1] * gap(); }

InertialMotion::State InertialMotion::slope(const State& y, Real elapsed) const {
  const Real q = std::exp(y[0]);
  return {y[1], problem_.pieces[piece_].force(from_ + elapsed) / (problem_.mass * q) -
                    problem_.resistance(q) / problem_.mass * y[1] - y[1] * y[1]};
}

bool InertialMotion::step(const State& y, Real elapsed, Real length, State& after,
                          Real& largest_rate) const {
  static const Radau<kStages> radau;
  using Matrix = Eigen::Matrix<Real, kStages, kStages>;
  using Vector = Eigen::Matrix<Real, kStages, 1>;
  const Real m = problem_.mass;

  // Unknown: what w has changed by at each point; what s has changed by is linear in it. The
  // equation of w is multiplied by the inverse of A and each of its rows is divided by its own
  // stiffness: no row is lost beside another, be R/m 1e100 times 1/length.
  Vector change = Vector::Zero();
  Real last_correction = 1;
  for (int iteration = 0; iteration < 12; ++iteration) {
    const Vector rates = change.array() + y[1];
    const Vector fall = length * (radau.a * rates);
    Vector defect = radau.inverse * change / length;
    Matrix jacobian = radau.inverse / length;
    for (int i = 0; i < kStages; ++i) {
      const Real w = rates(i);
      const Real q = std::exp(y[0] + fall(i));
      const Real r = problem_.resistance(q) / m;
      // Newton's method bears an error of its matrix.
      constexpr Real kDifference = 1e-9L;
      const Real r_slope = (problem_.resistance(q * (1 + kDifference)) / m - r) / kDifference;
      const Real pushed =
          problem_.pieces[piece_].force(from_ + (elapsed + radau.c(i) * length)) / (m * q);
      defect(i) -= pushed - r * w - w * w;
      jacobian.row(i) += (pushed + r_slope * w) * length * radau.a.row(i);
      jacobian(i, i) += r + 2 * w;
      const Real stiffness = 1 / length + r;
      defect(i) /= stiffness;
      jacobian.row(i) /= stiffness;
    }
    const Vector correction = jacobian.partialPivLu().solve(defect);
    change -= correction;
    const Real rate = std::max(std::abs(y[1]), rates.cwiseAbs().maxCoeff());
    const Real largest = correction.cwiseAbs().maxCoeff() / (rate > 0 ? rate : 1);
    if (!std::isfinite(largest)) return false;
    // Quadratic: the next correction would be far below the rounding. Or rounding is all there is.
    const bool rounding = largest < 1e-17L && largest >= last_correction / 2;
    if (iteration > 0 && (largest < 1e-18L || rounding)) {
      after = {y[0] + length * radau.a.row(kStages - 1).dot((change.array() + y[1]).matrix()),
               y[1] + change(kStages - 1)};
      largest_rate = std::max(largest_rate, rate);
      return true;
    }
    if (iteration > 2 && largest > last_correction && largest > 1e-15L) return false;
    last_correction = largest;
  }
  return false;
}

void InertialMotion::advance_in_piece(Real target) {
  if (length_ == 0) {
    // Short beside all there is: the film's damping, the fall, the change of ln q.
    const Real q = gap(), m = problem_.mass;
    const Real pushed = std::abs(slope({state_[0], 0}, elapsed_)[1]);
    length_ = 1e-2L / (problem_.resistance(q) / m + std::sqrt(pushed) + std::abs(state_[1]));
  }
  const Real smallest_rate = 1e-6L / problem_.pieces.back().until;
  while (elapsed_ < target) {
    const Real left = target - elapsed_ - unbooked_;
    // No last step of a hundredth of the one before.
    const bool last = length_ >= left;
    const Real length = last ? left : length_ > left / 2 ? left / 2 : length_;
    State whole, middle, halves;
    Real rate = 0;
    Real factor = 0.25L;
    if (step(state_, elapsed_, length, whole, rate) &&
        step(state_, elapsed_, length / 2, middle, rate) &&
        step(middle, elapsed_ + length / 2, length / 2, halves, rate)) {
      const Real error = std::max(std::abs(whole[0] - halves[0]),
                                  std::abs(whole[1] - halves[1]) / std::max(rate, smallest_rate)) /
                         tolerance_;
      // Its order is 8 where the step is stiff, higher elsewhere.
      factor = std::clamp(0.9L * std::pow(error, -1.0L / (kStages + 1)), 0.2L, 5.0L);
      if (error <= 1) {
        state_ = halves;
        unbooked_ += length;
        const Real before = elapsed_;
        elapsed_ = last ? target : before + unbooked_;
        unbooked_ = last ? 0 : unbooked_ - (elapsed_ - before);
        ++steps_;
      }
    }
    // A step cut short by the target says nothing against longer ones.
    length_ = factor > 1 ? std::max(length_, length * factor) : length * factor;
    if (!(length_ > 1e-4900L)) throw std::runtime_error("the oracle's step became nothing");
  }
}

void InertialMotion::advance(Real time) {
  while (time > problem_.pieces[piece_].until) {
    advance_in_piece(problem_.pieces[piece_].until - from_);
    if (++piece_ == problem_.pieces.size())
      throw std::runtime_error("the oracle has no force at that time");
    from_ = problem_.pieces[piece_ - 1].until;
    elapsed_ = 0;
    length_ = 0;
  }
  advance_in_piece(time - from_);
}

InertialMotion advanced_to_turn(const InertialMotion& motion, Real until) {
  InertialMotion before = motion, after = motion;
  after.advance(until);
  // Bisection to where the velocity is close to linear, then the secant.
  for (int i = 0; i < 200; ++i) {
    const Real span = after.time() - before.time();
    const Real fraction =
        i < 20 ? 0.5L : before.velocity() / (before.velocity() - after.velocity());
    const Real time = before.time() + std::clamp(fraction, 0.0L, 1.0L) * span;
    if (time <= before.time() || time >= after.time()) break;
    InertialMotion middle = before;
    middle.advance(time);
    const bool turned = (middle.velocity() < 0) != (motion.velocity() < 0);
    (turned ? after : before) = middle;
  }
  return std::abs(before.velocity()) < std::abs(after.velocity()) ? before : after;
}

namespace {

/// lambda as brenner.hpp has it; the same sum as in brenner.cpp, kept in long double.
Real brenner_series(Real epsilon) {
  const Real alpha = 2 * std::asinh(std::sqrt(epsilon / 2));
  const Real sinh_alpha = std::sinh(alpha);
  Real sum = 0;
  for (Real n = 1;; ++n) {
    const Real k = 2 * n + 1, x = k * alpha;
    const Real denominator = (2 * sinh_minus_argument(x / 2) - k * sinh_minus_argument(alpha)) *
                             (2 * std::sinh(x / 2) + k * sinh_alpha);
    const Real numerator =
        -2 * std::expm1(-x) + k * std::sinh(2 * alpha) + k * k * sinh_alpha * sinh_alpha;
    const Real term = n * (n + 1) / ((2 * n - 1) * (2 * n + 3)) * numerator / denominator;
    sum += term;
    // Not before x = 4 do the terms fall; what is left is a 1/(2 alpha)-fold of the last.
    if (x > 4 && term < 1e-22L * sum) return 4.0L / 3 * sinh_alpha * sum;
  }
}

/// eps lambda on pieces of length 1/2 of ln eps, by interpolation at 16 of Chebyshev's points: it
/// is analytic for |Im ln eps| < pi, so an error of 25^-16 = 2e-22.
class PlaneDrag {
 public:
  Real operator()(Real epsilon) {
    const Real x = std::log(epsilon);
    if (x < -8) {
      // Cox & Brenner 1967; Cooley & O'Neill 1969. What is left out is 2e-20 of lambda at most.
      return 1 / epsilon + 0.9712799310357215124164L - x / 5 +
             epsilon * (0.1670170048120648130803L - x / 21) +
             epsilon * epsilon * (-0.014874631356397688499L + x * 8 / 1125) +
             epsilon * epsilon * epsilon * (0.0026239942748169499590L - x * 15416 / 9095625);
    }
    const int place = static_cast<int>(std::floor(2 * x));
    auto [piece, is_new] = pieces_.try_emplace(place);
    if (is_new)
      for (int i = 0; i < kNodes; ++i)
        piece->second[i] = scaled_drag(std::exp((place + (1 + node(i)) / 2) / 2));
    // Barycentric, Berrut & Trefethen 2004.
    const Real t = 2 * (2 * x - place) - 1;
    Real above = 0, below = 0;
    for (int i = 0; i < kNodes; ++i) {
      const Real distance = t - nodes_[i];
      if (distance == 0) return piece->second[i] / epsilon;
      const Real weight = weights_[i] / distance;
      above += weight * piece->second[i];
      below += weight;
    }
    return above / below / epsilon;
  }

  PlaneDrag() {
    for (int i = 0; i < kNodes; ++i) {
      nodes_[i] = node(i);
      weights_[i] = (i % 2 == 0 ? 1 : -1) * std::sin(angle(i));
    }
  }

 private:
  static constexpr int kNodes = 16;
  static Real angle(int i) { return (i + 0.5L) / kNodes * std::numbers::pi_v<Real>; }
  static Real node(int i) { return std::cos(angle(i)); }
  static Real scaled_drag(Real epsilon) { return epsilon * brenner_series(epsilon); }

  std::array<Real, kNodes> nodes_, weights_;
  std::map<int, std::array<Real, kNodes>> pieces_;
};

}  // namespace

InertialProblem::Function exact_plane_resistance(Real viscosity, Real radius) {
  const Real stokes = 6 * std::numbers::pi_v<Real> * viscosity * radius;
  return [stokes, radius, drag = std::make_shared<PlaneDrag>()](Real gap) {
    return stokes * (*drag)(gap / radius);
  };
}

}  // namespace viscontact
