#include "reduced_model/cvode.hpp"

#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
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

constexpr int kTryAgain = 1;  // a positive return value: CVODE may come back with a smaller step

}  // namespace

Cvode::Cvode(StiffSystem system, std::span<const double> state, double relative_tolerance,
             std::span<const double> absolute_tolerances)
    : system_(std::move(system)),
      state_(N_VNew_Serial(system_.dimension, context_)),
      weights_(N_VClone(state_.get())),
      matrix_(SUNDenseMatrix(system_.dimension, system_.dimension, context_)),
      solver_(SUNLinSol_Dense(state_.get(), matrix_.get(), context_)),
      memory_(CVodeCreate(CV_BDF, context_)) {
  if (!state_ || !weights_ || !matrix_ || !solver_ || memory_ == nullptr) throw std::bad_alloc();
  std::ranges::copy(state, values(state_.get()).begin());
  check(CVodeInit(memory_, evaluate_derivative, 0, state_.get()), "CVodeInit");
  const Owned<N_Vector> tolerances(N_VClone(state_.get()));
  std::ranges::copy(absolute_tolerances, values(tolerances.get()).begin());
  check(CVodeSVtolerances(memory_, relative_tolerance, tolerances.get()), "CVodeSVtolerances");
  check(CVodeSetUserData(memory_, this), "CVodeSetUserData");
  check(CVodeSetErrFile(memory_, nullptr),
        "CVodeSetErrFile");  // failures come as Error, not as text on stderr
  check(CVodeSetLinearSolver(memory_, solver_.get(), matrix_.get()), "CVodeSetLinearSolver");
  check(CVodeSetJacFn(memory_, evaluate_jacobian), "CVodeSetJacFn");
  // By default CVODE keeps a Jacobian for up to 51 steps. Where the stiffness falls by decades
  // within a few steps (a film that opens), a Jacobian from before makes Newton's corrections
  // vanish, and a wrong state passes for a solution. It costs nothing to have it fresh.
  check(CVodeSetLSetupFrequency(memory_, 1), "CVodeSetLSetupFrequency");
  check(CVodeSetJacEvalFrequency(memory_, 1), "CVodeSetJacEvalFrequency");
  check(CVodeSetProjFn(memory_, project), "CVodeSetProjFn");
  check(CVodeSetProjErrEst(memory_, SUNFALSE), "CVodeSetProjErrEst");
  check(CVodeRootInit(memory_, 1, evaluate_event), "CVodeRootInit");
  check(CVodeSetNoInactiveRootWarn(memory_), "CVodeSetNoInactiveRootWarn");
  check(CVodeSetMaxNumSteps(memory_, 1000000), "CVodeSetMaxNumSteps");
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

void Cvode::restart(double time, double stop_time) {
  steps_before_restart_ = steps();
  time_ = time;
  check(CVodeReInit(memory_, time, state_.get()), "CVodeReInit");
  // A stop time outlives CVodeReInit, so a new one is set each time.
  check(CVodeSetStopTime(memory_, stop_time), "CVodeSetStopTime");
}

Cvode::Stop Cvode::advance(double until) {
  const int code = CVode(memory_, until, state_.get(), &time_, CV_NORMAL);
  if (code < 0 && system_error_) {
    // Whatever CVODE gave up at in the end: it made no way beyond the time at which the system was asked where it is not defined.
    constexpr double kNoWay = 1e-9;
    double reached = 0;
    check(CVodeGetCurrentTime(memory_, &reached), "CVodeGetCurrentTime");
    if (reached <= system_error_time_ * (1 + kNoWay)) std::rethrow_exception(system_error_);
  }
  check(code, "CVode");
  return code == CV_ROOT_RETURN ? Stop::kAtEvent : Stop::kAtTime;
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

int Cvode::project(double time, N_Vector y, N_Vector correction, double tolerance, N_Vector,
                   void* self) {
  auto& cvode = *static_cast<Cvode*>(self);
  const auto size = static_cast<std::size_t>(cvode.system_.dimension);
  if (CVodeGetErrWeights(cvode.memory_, cvode.weights_.get()) != CV_SUCCESS) return kTryAgain;
  const auto weight = values(cvode.weights_.get());
  const auto total = values(correction);
  const auto from = values(y);
  std::vector<double> moved(from.begin(), from.end());
  std::vector<double> gradient(size);
  std::ranges::fill(total, 0);
  // The smallest correction in the norm in which CVODE measures errors, by Newton's method on the
  // linearised invariant.
  constexpr int kMaxIterations = 10;
  try {
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
      const double residual = cvode.system_.invariant(time, moved, gradient);
      double scale = 0;
      for (std::size_t i = 0; i < size; ++i)
        scale += gradient[i] * gradient[i] / (weight[i] * weight[i]);
      double length = 0;
      for (std::size_t i = 0; i < size; ++i) {
        const double change = -residual / scale * gradient[i] / (weight[i] * weight[i]);
        length = std::max(length, std::abs(change * weight[i]));
        total[i] += change;
        moved[i] += change;
      }
      if (length <= tolerance) return 0;
    }
  } catch (const Error&) {
    return cvode.keep_error(time);
  }
  return kTryAgain;
}

int Cvode::evaluate_event(double, N_Vector y, double* value, void* self) {
  *value = static_cast<Cvode*>(self)->system_.event(values(y));
  return 0;
}

}  // namespace viscontact
