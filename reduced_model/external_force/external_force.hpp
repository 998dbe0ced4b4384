// The external force f_ext(t): every force on the sphere except those of the fluid and of contact,
// such as gravity, a push or a measured signal.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <limits>
#include <vector>

namespace viscontact::reduced_model {

/// True if two times > 0 [T] differ by a rounding error, as 0.1 + 0.2 and 0.3 do. CVODE cannot
/// integrate over so short an interval.
inline bool are_one_time(double a, double b) {
  return std::abs(a - b) <=
         4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(a), std::abs(b));
}

/// f_ext(t) for t >= 0: a sum of piecewise polynomials and sinusoids. Means and impulses are closed
/// forms that lose no digits for short intervals, because budgets are balanced to round-off.
class ExternalForce {
 public:
  /// A polynomial from the end of the piece before it, or from 0: f_ext = value + higher[0] tau +
  /// higher[1] tau^2 + ... with the time tau since the beginning of the piece.
  struct Piece {
    double until = 0;  ///< end of the piece [T], > its beginning; the last piece never ends
    /// Force at tau = 0 along the outward normal [M L/T^2]; < 0 towards the wall.
    double value = 0;
    /// Coefficients of tau, tau^2, ... [M L/T^3], [M L/T^4], ...; empty if the force is constant.
    std::vector<double> higher{};
  };

  /// The force amplitude * sin(angular_frequency t + phase).
  struct Sinusoid {
    double amplitude = 0;          ///< [M L/T^2], of any sign
    double angular_frequency = 0;  ///< [1/T], > 0
    double phase = 0;              ///< [radians]
  };

  /// Throws Error(kBadInput) if there is no piece, or unless Piece::until is > 0 and increases from
  /// piece to piece. The `until` of the last piece has no other effect.
  explicit ExternalForce(const std::vector<Piece>& pieces);

  /// The force of one sinusoid. Throws Error(kBadInput) if its angular frequency is not > 0.
  static ExternalForce sinusoidal(const Sinusoid& sinusoid);

  /// Adds another force. Pieces that are as short as rounding errors of time are left out.
  ExternalForce& operator+=(const ExternalForce& other);

  /// The same force stretched in time: f_ext(t/factor), factor > 0.
  ExternalForce stretched(double factor) const;

  /// f_ext(t) [M L/T^2], t >= 0; at a jump, the value after it.
  double value(double time) const;

  /// d f_ext/dt [M L/T^3], t >= 0; at a jump or kink, the slope after it.
  double slope(double time) const;

  /// int_0^t f_ext, for t >= 0 [M L/T].
  double impulse(double time) const;

  /// int_0^t of impulse(), for t >= 0 [M L].
  double impulse_integral(double time) const;

  /// Mean of f_ext over [from, to] [M L/T^2], 0 <= from < to.
  double mean(double from, double to) const;

  /// The times [T] > 0 at which f_ext or its slope jumps, increasing; no two are_one_time().
  std::vector<double> jumps() const;

  /// The times [T] in (0, end) at which f_ext changes its sign, by a jump or through 0, increasing.
  /// With sinusoids two changes can be missed if they are closer to each other than 1/32 of the
  /// shortest period. Throws Error(kNotConverged) if the times from 0 to `end` contain more than
  /// about 3e4 of the shortest periods.
  std::vector<double> sign_changes(double end) const;

 private:
  friend class ForceWalk;
  struct Polynomial {
    double from = 0;  // time at which the piece begins [T]
    // Coefficients of the powers of the time since `from`, at least one.
    std::vector<double> coefficients;
    double impulse = 0;           // int_0^from f [M L/T]
    double impulse_integral = 0;  // int_0^from of the impulse [M L]
  };
  // At a jump, the later piece.
  const Polynomial& piece_at(double time) const;
  // Leaves out pieces as short as rounding errors, and computes the members `impulse` and
  // `impulse_integral` of the others.
  void sum_up();

  std::vector<Polynomial> pieces_;  // the first begins at 0
  std::vector<Sinusoid> sinusoids_;
};

/// Values and means of a force at times that do not decrease from call to call. The functions are
/// faster than those of ExternalForce, because they search no piece while the force is constant.
class ForceWalk {
 public:
  /// The walk begins at time 0. `force` must outlive the object.
  explicit ForceWalk(const ExternalForce& force) : force_(force) { enter(0); }

  /// The force at `time` [T].
  double value(double time) {
    go_to(time);
    return constant_ ? level_ : force_.value(time);
  }
  /// The mean of the force from time `from` to time `to` > `from`.
  double mean(double from, double to) {
    go_to(from);
    return constant_ && to <= end_ ? level_ : force_.mean(from, to);
  }

 private:
  void go_to(double time) {
    while (time >= end_) enter(piece_ + 1);
    assert(!(time < force_.pieces_[piece_].from));
  }
  void enter(std::size_t piece);

  const ExternalForce& force_;
  std::size_t piece_ = 0;
  double end_ = 0, level_ = 0;
  bool constant_ = false;
};

/// Reads a sampled force from a CSV file with the columns time [T] and force [M L/T^2]. The force
/// is linear between the rows; two rows of the same time make a jump. Throws Error(kBadInput), with
/// file and line, if a value is no finite number, the first time is not 0, times decrease, or a
/// time is in more than two rows, and with the file, if it cannot be read or ends before `end` [T].
ExternalForce read_external_force(const std::filesystem::path& path, double end);

}  // namespace viscontact::reduced_model
