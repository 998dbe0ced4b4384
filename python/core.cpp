// The library viscontact._core: exceptions of Python for errors, Ctrl-C, and the version.
#include <csignal>
#include <exception>

#include "viscontact/common/error.hpp"
#include "viscontact/python/call.hpp"

namespace viscontact::python {
namespace {

// The handler remember_interrupt() sets it. It is global, because a handler has no other access to
// data.
std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);
// Number of InterruptGuards that exist, one for each long call in any thread, and the handler that
// SIGINT had before the first of them. The interpreter's lock protects both variables.
int guards = 0;
struct sigaction handler_before = {};

void remember_interrupt(int) { interrupted = true; }

/// They live as long as the process.
struct Exceptions {
  PyObject *error, *input, *not_converged, *external_program;
};
Exceptions exceptions;

/// Makes viscontact.NAME with the base class `base` and, unless it is null, `further_base`.
PyObject* make_exception(py::module_& module, const char* name, const char* description,
                         PyObject* base, PyObject* further_base) {
  const auto bases = further_base == nullptr
                         ? py::make_tuple(py::handle(base))
                         : py::make_tuple(py::handle(base), py::handle(further_base));
  const auto whole_name = std::string("viscontact.") + name;
  PyObject* made = PyErr_NewExceptionWithDoc(whole_name.c_str(), description, bases.ptr(), nullptr);
  if (made == nullptr) throw py::error_already_set();
  module.attr(name) = py::handle(made);
  return made;
}

PyObject* exception_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kWrongUsage:
    case ErrorKind::kBadInput:
      return exceptions.input;
    case ErrorKind::kNotConverged:
      return exceptions.not_converged;
    case ErrorKind::kExternalProgram:
      return exceptions.external_program;
    case ErrorKind::kInterrupted:
      return exceptions.error;
  }
  return exceptions.error;
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Error& error) {
    PyErr_SetString(exception_of(error.kind()), error.what());
  }
}

}  // namespace

InterruptGuard::InterruptGuard() {
  if (guards++ > 0) return;
  interrupted = false;
  sigaction(SIGINT, nullptr, &handler_before);
  // If there is no handler, nothing could act on the signal after the call, so nothing is changed.
  if (handler_before.sa_handler == SIG_DFL || handler_before.sa_handler == SIG_IGN) return;
  struct sigaction action = {};
  action.sa_handler = remember_interrupt;  // without SA_RESTART, so that it ends a waiting call
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
}

InterruptGuard::~InterruptGuard() {
  if (--guards > 0) return;
  sigaction(SIGINT, &handler_before, nullptr);
  // If the signal came too late to stop the call, Python's own handler now acts on it.
  if (interrupted.exchange(false)) PyErr_SetInterrupt();
}

StopToken interrupt_token() { return StopToken(interrupted); }

void InterruptGuard::raise_if_interrupted() {
  if (!interrupted.exchange(false)) return;
  PyErr_SetInterrupt();
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace viscontact::python

PYBIND11_MODULE(_core, module) {
  using namespace viscontact::python;
  module.doc() = "The compiled part of viscontact. Import viscontact instead.";
  module.attr("__version__") = VISCONTACT_VERSION;
  exceptions.error = make_exception(
      module, "Error",
      "An error with the message of the program, which says what is wrong and what to do.",
      PyExc_RuntimeError, nullptr);
  exceptions.input =
      make_exception(module, "InputError", "A file, or a value in it, or an argument is wrong.",
                     exceptions.error, PyExc_ValueError);
  exceptions.not_converged =
      make_exception(module, "NotConvergedError",
                     "A computation did not reach its tolerance, or left the range of a double.",
                     exceptions.error, PyExc_ArithmeticError);
  exceptions.external_program = make_exception(
      module, "ExternalProgramError", "FreeFEM failed or is missing.", exceptions.error, nullptr);
  py::register_exception_translator(translate);
  add_fits(module);
  add_particles(module);
  add_spheres(module);
}
