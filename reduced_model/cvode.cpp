#include "reduced_model/cvode.hpp"

#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/error.hpp"

namespace viscontact {
namespace {

std::span<double> values(N_Vector vector) {
  return {N_VGetArrayPointer(vector), static_cast<std::size_t>(N_VGetLength(vector))};
}

/// Keeps SUNDIALS from printing its errors, because check() throws each of them as an Error.
/// SUNDIALS 6 (Debian 12) has a file for the errors of each solver, SUNDIALS 7 (Debian 13) a list of
/// error handlers in the context instead. Returns a code of SUNDIALS, < 0 if it fails.
int print_no_errors([[maybe_unused]] SUNContext context, [[maybe_unused]] void* memory) {
#if SUNDIALS_VERSION_MAJOR >= 7
  return SUNContext_ClearErrHandlers(context);
#else
  return CVodeSetErrFile(memory, nullptr);
#endif
}

constexpr int kTryAgain = 1;  // a positive return value: CVODE may come back with a smaller step

}  // namespace

Cvode::Cvode(StiffSystem system, std::span<const double> state)
    : system_(std::move(system)),
      state_(N_VNew_Serial(system_.dimension, context_)),
      interpolated_(N_VClone(state_.get())),
      matrix_(SUNDenseMatrix(system_.dimension, system_.dimension, context_)),
      solver_(SUNLinSol_Dense(state_.get(), matrix_.get(), context_)),
      memory_(CVodeCreate(CV_BDF, context_)) {
  if (!state_ || !interpolated_ || !matrix_ || !solver_ || memory_ == nullptr)
    throw std::bad_alloc();
  std::ranges::copy(state, values(state_.get()).begin());
  check(CVodeInit(memory_, evaluate_derivative, 0, state_.get()), "CVodeInit");
  check(CVodeWFtolerances(memory_, evaluate_weights), "CVodeWFtolerances");
  check(CVodeSetUserData(memory_, this), "CVodeSetUserData");
  check(print_no_errors(context_, memory_), "print_no_errors");
  // A negative number: CVODE never warns of steps below the rounding of the time. SUNDIALS 7 would
  // print these warnings on standard output.
  check(CVodeSetMaxHnilWarns(memory_, -1), "CVodeSetMaxHnilWarns");
  check(CVodeSetLinearSolver(memory_, solver_.get(), matrix_.get()), "CVodeSetLinearSolver");
  check(CVodeSetJacFn(memory_, evaluate_jacobian), "CVodeSetJacFn");
  // By default CVODE keeps a Jacobian for up to 51 steps. Where the stiffness falls by decades
  // within a few steps (a film that opens), a Jacobian from before makes Newton's corrections
  // vanish, and a wrong state passes for a solution. It costs nothing to have it fresh.
  check(CVodeSetLSetupFrequency(memory_, 1), "CVodeSetLSetupFrequency");
  check(CVodeSetJacEvalFrequency(memory_, 1), "CVodeSetJacEvalFrequency");
}

Cvode::~Cvode() { CVodeFree(&memory_); }

std::span<const double> Cvode::state() const { return values(state_.get()); }

void Cvode::set_state(std::span<const double> state) {
  std::ranges::copy(state, values(state_.get()).begin());
}

long Cvode::steps() const {
  long steps = 0;
  check(CVodeGetNumSteps(memory_, &steps), "CVodeGetNumSteps");
  return steps_before_restart_ + steps;
}

void Cvode::restart(double time, double stop_time, double first_step) {
  steps_before_restart_ = steps();
  time_ = time;
  check(CVodeReInit(memory_, time, state_.get()), "CVodeReInit");
  // A stop time outlives CVodeReInit, so a new one is set each time.
  check(CVodeSetStopTime(memory_, stop_time), "CVodeSetStopTime");
  check(CVodeSetInitStep(memory_, first_step), "CVodeSetInitStep");
  stop_time_ = stop_time;
  steps_since_restart_ = 0;
}

void Cvode::step() {
  const double before = time_;
  int code = CVode(memory_, stop_time_, state_.get(), &time_, CV_ONE_STEP);
  // A solution that runs away makes it creep for ever.
  constexpr long kMostSteps = 1'000'000;
  if (code >= 0 && (!(time_ > before) || ++steps_since_restart_ > kMostSteps))
    code = CV_TOO_MUCH_WORK;
  if (code < 0 && system_error_) {
    // Whatever CVODE gave up at in the end: it made no way beyond the time at which the system was asked where it is not defined.
    constexpr double kNoWay = 1e-9;
    double reached = 0;
    check(CVodeGetCurrentTime(memory_, &reached), "CVodeGetCurrentTime");
    if (reached <= system_error_time_ * (1 + kNoWay)) std::rethrow_exception(system_error_);
  }
  check(code, "CVode");
}

double Cvode::at(double time, std::size_t i) const {
  check(CVodeGetDky(memory_, time, 0, interpolated_.get()), "CVodeGetDky");
  return values(interpolated_.get())[i];
}

std::vector<double> Cvode::expansion(std::size_t i) const {
  int order = 0;
  check(CVodeGetLastOrder(memory_, &order), "CVodeGetLastOrder");
  std::vector<double> coefficients;
  double factorial = 1;
  for (int k = 0; k <= order; ++k) {
    factorial *= std::max(1, k);
    check(CVodeGetDky(memory_, time_, k, interpolated_.get()), "CVodeGetDky");
    coefficients.push_back(values(interpolated_.get())[i] / factorial);
  }
  return coefficients;
}

void Cvode::check(int code, const char* call) const {
  if (code >= 0) return;
  const std::unique_ptr<char, decltype(&std::free)> name(CVodeGetReturnFlagName(code), std::free);
  throw Error(ExitCode::kNotConverged,
              fmt::format("CVODE gave up at time {:.6g} ({} returned {}); take another "
                          "inertial.relative_tolerance, or less extreme mass, velocity or force",
                          time_, call, name.get()));
}

int Cvode::keep_error(double time) {
  system_error_ = std::current_exception();
  system_error_time_ = time;
  return kTryAgain;
}

int Cvode::evaluate_derivative(double time, N_Vector y, N_Vector derivative, void* self) {
  auto& cvode = *static_cast<Cvode*>(self);
  try {
    cvode.system_.derivative(time, values(y), values(derivative));
  } catch (const Error&) {
    return cvode.keep_error(time);
  }
  return 0;
}

int Cvode::evaluate_weights(N_Vector y, N_Vector weights, void* self) {
  auto& cvode = *static_cast<Cvode*>(self);
  const auto weight = values(weights);
  try {
    cvode.system_.tolerance(cvode.time_, values(y), weight);
  } catch (const Error&) {
    return cvode.keep_error(cvode.time_);
  }
  for (double& w : weight) w = 1 / w;
  return 0;
}

int Cvode::evaluate_jacobian(double time, N_Vector y, N_Vector, SUNMatrix jacobian, void* self,
                             N_Vector, N_Vector, N_Vector) {
  auto& cvode = *static_cast<Cvode*>(self);
  const auto size = static_cast<std::size_t>(cvode.system_.dimension) *
                    static_cast<std::size_t>(cvode.system_.dimension);
  try {
    cvode.system_.jacobian(time, values(y), {SUNDenseMatrix_Data(jacobian), size});
  } catch (const Error&) {
    return cvode.keep_error(time);
  }
  return 0;
}

}  // namespace viscontact
