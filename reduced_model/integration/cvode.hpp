// SUNDIALS CVODE as a value with RAII: every return code is checked here and nowhere else.
// No header of SUNDIALS is included here, because those of Debian 13 need MPI's, which users of an
// installed Viscontact and the tests would have to find.
#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace viscontact {

/// A stiff system y' = f(t, y) with its Jacobian.
struct StiffSystem {
  int dimension = 0;
  std::function<void(double time, std::span<const double> y, std::span<double> derivative)>
      derivative;
  /// Column-major, entry (i, j) = d f_i / d y_j.
  std::function<void(double time, std::span<const double> y, std::span<double> jacobian)> jacobian;
  /// For each component, by how much it may be off in a step, > 0.
  std::function<void(double time, std::span<const double> y, std::span<double> allowed)> tolerance;
};

/// BDF of variable order and step with Newton's method and dense linear algebra.
/// An Error thrown by the system (a state that it cannot judge) makes CVODE try a
/// smaller step; if it persists, it is thrown on from step().
class Cvode {
 public:
  Cvode(StiffSystem system, std::span<const double> state);
  Cvode(const Cvode&) = delete;
  Cvode& operator=(const Cvode&) = delete;
  ~Cvode();

  /// Replaces the state; restart() must follow.
  void set_state(std::span<const double> state);

  /// Starts afresh at `time` from the present state, never to look past `stop_time`: the system may
  /// change there. `first_step` > 0 is where CVODE's own guess would be too careful; 0 leaves it to CVODE.
  void restart(double time, double stop_time, double first_step = 0);

  /// One step of CVODE's own choice, no further than the stop time. Throws Error(kNotConverged) if CVODE gives up.
  void step();

  /// The state at a time within the last step, by CVODE's own polynomial. Component `i`.
  double at(double time, std::size_t i = 0) const;

  /// The same polynomial's coefficients in powers of (time - time()), 2 to 6 of them: cheaper where many times are wanted.
  std::vector<double> expansion(std::size_t i = 0) const;

  double time() const { return time_; }
  std::span<const double> state() const;
  long steps() const;  ///< since construction

 private:
  struct Sundials;  // the objects of SUNDIALS, and the functions that it calls

  /// Called where the system has thrown: keeps that for whoever asks why, and lets CVODE try again.
  int keep_error(double time);
  void check(int code, const char* call) const;

  StiffSystem system_;
  std::unique_ptr<Sundials> sundials_;
  double time_ = 0;
  double stop_time_ = 0;
  long steps_before_restart_ = 0;
  long steps_since_restart_ = 0;
  std::exception_ptr system_error_;  // the last one that the system threw
  double system_error_time_ = 0;     // and when
};

}  // namespace viscontact
