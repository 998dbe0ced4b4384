// The force that is not the fluid's: gravity, a push, a pull, a measured signal.
#pragma once

#include <filesystem>
#include <vector>

namespace viscontact {

/// f_ext(t), a sum of piecewise polynomials and sinusoids on t >= 0. Means and impulses are exact (no quadrature).
class ExternalForce {
 public:
  /// A polynomial on an interval of time that begins where the piece before ends, the first at 0: with tau the time since then,
  /// f = value + higher[0] tau + higher[1] tau^2 + ...
  struct Piece {
    double until = 0;  ///< end of the piece [T]
    double value = 0;  ///< along the outward normal [M L/T^2]; negative: towards the plane
    std::vector<double> higher{};  ///< [M L/T^3], [M L/T^4], ...
  };

  /// amplitude sin(angular_frequency t + phase).
  struct Sinusoid {
    double amplitude = 0;          ///< [M L/T^2]
    double angular_frequency = 0;  ///< [1/T], > 0
    double phase = 0;              ///< [1], radians
  };

  /// Pieces with increasing `until` > 0; the last goes on for ever. Throws Error(kBadInput) otherwise, or if there is none.
  explicit ExternalForce(const std::vector<Piece>& pieces);

  /// Throws Error(kBadInput) unless the angular frequency is > 0.
  static ExternalForce sinusoidal(const Sinusoid& sinusoid);

  ExternalForce& operator+=(const ExternalForce& other);

  /// The same force drawn out in time: f_ext(t/factor), factor > 0.
  ExternalForce stretched(double factor) const;

  /// f_ext(t); at a jump, the value after it.
  double value(double time) const;

  /// d f_ext/dt [M L/T^3]; at a jump or kink, that after it.
  double slope(double time) const;

  /// int_0^t f_ext [M L/T].
  double impulse(double time) const;

  /// int_0^t impulse [M L].
  double impulse_integral(double time) const;

  /// Mean of f_ext over [from, to], 0 <= from < to.
  double mean(double from, double to) const;

  /// The times at which f_ext or its slope jumps, in increasing order.
  std::vector<double> jumps() const;

  /// The times in (0, end) at which f_ext changes its sign, by a jump or through 0, in increasing order. Of a piece without
  /// sinusoids all are found; of others those that are not two within a 32nd of a period (of the fastest). Throws Error(kNotConverged) for more than 3e4 periods.
  std::vector<double> sign_changes(double end) const;

 private:
  friend class ForceWalk;
  struct Polynomial {
    double from = 0;                   // where it begins
    std::vector<double> coefficients;  // of powers of the time since then, at least one
    double impulse = 0;                // int_0^from
    double impulse_integral = 0;       // int_0^from of the impulse
  };
  const Polynomial& piece_at(double time) const;
  void sum_up();

  std::vector<Polynomial> pieces_;  // the first begins at 0
  std::vector<Sinusoid> sinusoids_;
};

/// value() and mean() of a force at times that do not decrease, without a search where it is constant.
class ForceWalk {
 public:
  explicit ForceWalk(const ExternalForce& force) : force_(force) { enter(0); }

  double value(double time) {
    go_to(time);
    return constant_ ? level_ : force_.value(time);
  }
  double mean(double from, double to) {
    go_to(from);
    return constant_ && to <= end_ ? level_ : force_.mean(from, to);
  }

 private:
  void go_to(double time) {
    while (time >= end_) enter(piece_ + 1);
  }
  void enter(std::size_t piece);

  const ExternalForce& force_;
  std::size_t piece_ = 0;
  double end_ = 0, level_ = 0;
  bool constant_ = false;
};

/// A force sampled in a CSV file with the columns time, force: linear between its rows, a jump where two follow each other at one time. Throws
/// Error(kBadInput) with file and line unless the first time is 0, times do not decrease, none is there more than twice, and the last is at least
/// `end` > 0.
ExternalForce read_external_force(const std::filesystem::path& path, double end);

}  // namespace viscontact
