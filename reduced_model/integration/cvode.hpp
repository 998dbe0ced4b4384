// The integrator of stiff equations CVODE of SUNDIALS (Hindmarsh et al. 2005). No header of
// SUNDIALS is included here: those of Debian 13 need MPI, which users would have to find.
#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace viscontact::reduced_model {

/// A stiff system y' = f(t, y) with its Jacobian; y, f and the tolerances have `dimension`
/// components. Each function may throw an Error, and nothing else, where it is not defined.
struct StiffSystem {
  int dimension = 0;  ///< > 0
  /// The right side f(t, y).
  std::function<void(double time, std::span<const double> y, std::span<double> derivative)>
      derivative;
  /// The Jacobian, dimension x dimension, stored by columns: entry (i, j) = d f_i/d y_j.
  std::function<void(double time, std::span<const double> y, std::span<double> jacobian)> jacobian;
  /// The error > 0 that is allowed in a step, which begins at `time`, for each component of y.
  std::function<void(double time, std::span<const double> y, std::span<double> allowed)> tolerance;
  /// The key of the case file that sets the tolerance, for messages.
  std::string tolerance_key = "inertial.relative_tolerance";
};

/// Backward differences (BDF) of variable order and step, with Newton's method and dense linear
/// algebra. If the system throws an Error, CVODE tries a smaller step; if the Error persists,
/// step() throws it. All functions that call SUNDIALS throw Error(kNotConverged) if it reports an
/// error.
class Cvode {
 public:
  /// Starts at time 0 from `state`, which has system.dimension components. restart() must be called
  /// before step(). Throws std::bad_alloc if the memory does not suffice.
  Cvode(StiffSystem system, std::span<const double> state);
  Cvode(const Cvode&) = delete;
  Cvode& operator=(const Cvode&) = delete;
  ~Cvode();

  /// Replaces the state; restart() must follow.
  void set_state(std::span<const double> state);

  /// Starts again at `time` [T] from the present state. The system is not evaluated beyond
  /// `stop_time` > `time`, so that it may change there. `first_step` > 0 is the step to try first,
  /// where CVODE's own choice is much too short; 0 leaves the choice to CVODE.
  void restart(double time, double stop_time, double first_step = 0);

  /// Makes one step of a length that CVODE chooses, at most to the stop time. Throws
  /// Error(kNotConverged) if CVODE gives up or needs more than 1e6 steps since the restart, or the
  /// Error of the system.
  void step();

  /// Component `i` of the state at a time within the last step, from the polynomial by which CVODE
  /// interpolates. Throws Error(kNotConverged) at another time.
  double at(double time, std::size_t i = 0) const;

  /// The 2 to 6 coefficients of this polynomial in powers of (t - time()), the constant first. It
  /// is cheaper than many calls of at().
  std::vector<double> expansion(std::size_t i = 0) const;

  /// Time that the integration has reached [T].
  double time() const { return time_; }
  /// The state y at time(); step() and set_state() change its numbers.
  std::span<const double> state() const;
  long steps() const;  ///< number of steps since construction

 private:
  struct Sundials;  // the objects of SUNDIALS, and the functions that it calls

  // Stores the Error that the system has just thrown, and returns the code that makes CVODE try a
  // smaller step.
  int keep_error(double time);
  // Throws Error(kNotConverged), which names `call`, if `code` of SUNDIALS is an error.
  void check(int code, const char* call) const;

  StiffSystem system_;
  std::unique_ptr<Sundials> sundials_;
  double time_ = 0;
  double stop_time_ = 0;
  long steps_before_restart_ = 0;
  long steps_since_restart_ = 0;
  std::exception_ptr system_error_;  // the last Error that the system threw
  double system_error_time_ = 0;     // the time at which the system threw it
};

}  // namespace viscontact::reduced_model
