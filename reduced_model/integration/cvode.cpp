// Calls of CVODE of SUNDIALS 6 or 7, and their return codes.
#include "viscontact/reduced_model/integration/cvode.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <new>
#include <sundials/sundials_context.hpp>

#include "viscontact/common/error.hpp"

namespace viscontact::reduced_model {
namespace {

/// The components of a vector of SUNDIALS, as long as the vector exists.
std::span<double> values(N_Vector vector) {
  return {N_VGetArrayPointer(vector), static_cast<std::size_t>(N_VGetLength(vector))};
}

/// SUNDIALS 6 (Debian 12) has a file for the errors of each solver, and SUNDIALS 7 (Debian 13) has
/// a list of error handlers in the context.
int print_no_errors([[maybe_unused]] SUNContext context, [[maybe_unused]] void* memory) {
#if SUNDIALS_VERSION_MAJOR >= 7
  return SUNContext_ClearErrHandlers(context);
#else
  return CVodeSetErrFile(memory, nullptr);
#endif
}

// A positive return value tells CVODE to try again with a smaller step.
constexpr int kTryAgain = 1;

/// Free choices of the integration.
struct CvodeTuning {
  // By default CVODE keeps a Jacobian for up to 51 steps. When the stiffness falls by several
  // powers of ten within a few steps, as in a film that opens, an old Jacobian makes Newton's
  // corrections vanish, and a wrong state is accepted as a solution. A new Jacobian at each step
  // costs almost nothing here.
  static constexpr int kStepsOfAJacobian = 1;
  // Without this limit, CVODE would make tiny steps for ever if the solution diverges.
  static constexpr long kMostSteps = 1'000'000;
  // CVODE has got no further since an Error of the system if the time that it reached exceeds the
  // time of the Error by at most this fraction, far above the rounding error of a time.
  static constexpr double kNoWay = 1e-9;
};

}  // namespace

// The objects of SUNDIALS, each after the objects that it depends on, and the functions that CVODE
// calls. The argument `self` of these functions is the object of class Cvode. They return 0, or
// kTryAgain after an Error of the system. weights() sets each weight to 1/(allowed error).
struct Cvode::Sundials {
  struct Deleters {
    void operator()(N_Vector object) const { N_VDestroy(object); }
    void operator()(SUNMatrix object) const { SUNMatDestroy(object); }
    void operator()(SUNLinearSolver object) const { SUNLinSolFree(object); }
  };
  template <class T>
  using Owned = std::unique_ptr<std::remove_pointer_t<T>, Deleters>;

  explicit Sundials(int dimension)
      : state(N_VNew_Serial(dimension, context)),
        interpolated(N_VClone(state.get())),
        matrix(SUNDenseMatrix(dimension, dimension, context)),
        solver(SUNLinSol_Dense(state.get(), matrix.get(), context)),
        memory(CVodeCreate(CV_BDF, context)) {}
  Sundials(const Sundials&) = delete;
  Sundials& operator=(const Sundials&) = delete;
  ~Sundials() { CVodeFree(&memory); }

  static int derivative(double time, N_Vector y, N_Vector derivative, void* self);
  static int jacobian(double time, N_Vector y, N_Vector, SUNMatrix jacobian, void* self, N_Vector,
                      N_Vector, N_Vector);
  static int weights(N_Vector y, N_Vector weights, void* self);

  sundials::Context context;
  Owned<N_Vector> state;
  Owned<N_Vector> interpolated;
  Owned<SUNMatrix> matrix;
  Owned<SUNLinearSolver> solver;
  void* memory = nullptr;
};

Cvode::Cvode(StiffSystem system, std::span<const double> state)
    : system_(std::move(system)), sundials_(std::make_unique<Sundials>(system_.dimension)) {
  assert(system_.dimension > 0);
  const Sundials& s = *sundials_;
  if (!s.state || !s.interpolated || !s.matrix || !s.solver || s.memory == nullptr)
    throw std::bad_alloc();
  set_state(state);
  check(CVodeInit(s.memory, Sundials::derivative, 0, s.state.get()), "CVodeInit");
  check(CVodeWFtolerances(s.memory, Sundials::weights), "CVodeWFtolerances");
  check(CVodeSetUserData(s.memory, this), "CVodeSetUserData");
  check(print_no_errors(s.context, s.memory), "print_no_errors");
  // A negative number turns off all warnings of steps that are shorter than the rounding error of
  // the time. SUNDIALS 7 would print these warnings on standard output.
  check(CVodeSetMaxHnilWarns(s.memory, -1), "CVodeSetMaxHnilWarns");
  check(CVodeSetLinearSolver(s.memory, s.solver.get(), s.matrix.get()), "CVodeSetLinearSolver");
  check(CVodeSetJacFn(s.memory, Sundials::jacobian), "CVodeSetJacFn");
  check(CVodeSetLSetupFrequency(s.memory, CvodeTuning::kStepsOfAJacobian),
        "CVodeSetLSetupFrequency");
  check(CVodeSetJacEvalFrequency(s.memory, CvodeTuning::kStepsOfAJacobian),
        "CVodeSetJacEvalFrequency");
}

Cvode::~Cvode() = default;

std::span<const double> Cvode::state() const { return values(sundials_->state.get()); }

void Cvode::set_state(std::span<const double> state) {
  assert(state.size() == values(sundials_->state.get()).size());
  std::ranges::copy(state, values(sundials_->state.get()).begin());
}

long Cvode::steps() const {
  long steps = 0;
  check(CVodeGetNumSteps(sundials_->memory, &steps), "CVodeGetNumSteps");
  return steps_before_restart_ + steps;
}

void Cvode::restart(double time, double stop_time, double first_step) {
  steps_before_restart_ = steps();
  time_ = time;
  check(CVodeReInit(sundials_->memory, time, sundials_->state.get()), "CVodeReInit");
  // CVodeReInit keeps the old stop time, so the new one is set each time.
  check(CVodeSetStopTime(sundials_->memory, stop_time), "CVodeSetStopTime");
  check(CVodeSetInitStep(sundials_->memory, first_step), "CVodeSetInitStep");
  stop_time_ = stop_time;
  steps_since_restart_ = 0;
}

void Cvode::step() {
  const double before = time_;
  int code = CVode(sundials_->memory, stop_time_, sundials_->state.get(), &time_, CV_ONE_STEP);
  if (code >= 0 && (!(time_ > before) || ++steps_since_restart_ > CvodeTuning::kMostSteps))
    code = CV_TOO_MUCH_WORK;
  if (code < 0 && system_error_) {
    // CVODE reports its own last failure only. The Error that the system threw is the cause if
    // CVODE has got no further since.
    double reached = 0;
    check(CVodeGetCurrentTime(sundials_->memory, &reached), "CVodeGetCurrentTime");
    if (reached <= system_error_time_ * (1 + CvodeTuning::kNoWay))
      std::rethrow_exception(system_error_);
  }
  check(code, "CVode");
}

double Cvode::at(double time, std::size_t i) const {
  assert(i < values(sundials_->state.get()).size());
  check(CVodeGetDky(sundials_->memory, time, 0, sundials_->interpolated.get()), "CVodeGetDky");
  return values(sundials_->interpolated.get())[i];
}

std::vector<double> Cvode::expansion(std::size_t i) const {
  assert(i < values(sundials_->state.get()).size());
  int order = 0;
  check(CVodeGetLastOrder(sundials_->memory, &order), "CVodeGetLastOrder");
  std::vector<double> coefficients;
  double factorial = 1;
  for (int k = 0; k <= order; ++k) {
    factorial *= std::max(1, k);
    check(CVodeGetDky(sundials_->memory, time_, k, sundials_->interpolated.get()), "CVodeGetDky");
    coefficients.push_back(values(sundials_->interpolated.get())[i] / factorial);
  }
  return coefficients;
}

void Cvode::check(int code, const char* call) const {
  if (code >= 0) return;
  const std::unique_ptr<char, decltype(&std::free)> name(CVodeGetReturnFlagName(code), std::free);
  throw Error(ErrorKind::kNotConverged,
              "CVODE gave up at time {:.6g} ({} returned {}); take another {}, or less extreme "
              "mass, velocity or force",
              time_, call, name.get(), system_.tolerance_key);
}

int Cvode::keep_error(double time) {
  system_error_ = std::current_exception();
  system_error_time_ = time;
  return kTryAgain;
}

int Cvode::Sundials::derivative(double time, N_Vector y, N_Vector derivative, void* self) {
  auto& cvode = *static_cast<Cvode*>(self);
  try {
    cvode.system_.derivative(time, values(y), values(derivative));
  } catch (const Error&) {
    return cvode.keep_error(time);
  }
  return 0;
}

int Cvode::Sundials::weights(N_Vector y, N_Vector weights, void* self) {
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

int Cvode::Sundials::jacobian(double time, N_Vector y, N_Vector, SUNMatrix jacobian, void* self,
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

}  // namespace viscontact::reduced_model
