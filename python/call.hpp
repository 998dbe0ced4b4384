// What the sources of the Python module share: calls that take long, arrays of NumPy, and Fit.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <string>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/stop_token.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"

namespace viscontact::python {

namespace py = pybind11;

/// While an object of this class exists, SIGINT sets a flag instead of calling the handler of
/// Python, which could not run before the call returns. The handler of Python runs afterwards. If
/// SIGINT is ignored, or ends the process because Python has no handler, nothing changes. The
/// thread must hold the interpreter's lock (GIL) when it makes or destroys an object.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Lets the handler of Python act on a signal that came. Throws what this handler raises, which
  /// is KeyboardInterrupt unless the user has set another one.
  void raise_if_interrupted();
};

/// The token that requests a stop after SIGINT has come while there is an InterruptGuard. All
/// threads share it. It is valid as long as the process.
StopToken interrupt_token();

/// Calls `compute` with a token that requests a stop at Ctrl-C, and returns its result. Other
/// Python threads can run meanwhile, so that `compute` must not touch objects of Python. Throws
/// what `compute` throws, and KeyboardInterrupt in place of Error(kInterrupted) after a Ctrl-C.
template <class Compute>
auto long_call(const Compute& compute) {
  InterruptGuard guard;
  try {
    const py::gil_scoped_release released;
    return compute(interrupt_token());
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInterrupted) guard.raise_if_interrupted();
    throw;
  }
}

/// An argument that is an array of doubles of any shape, row by row, or is converted to one: a
/// number, a list, an array of another type or with gaps in memory. pybind11 raises TypeError or
/// ValueError if it cannot be converted.
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The values of `function` at all elements of an array, in an array of the same shape; a float if
/// `x` is a number (an array without dimensions). `function` must not touch objects of Python.
/// Ctrl-C does not stop it.
template <class Function>
py::object mapped(const Doubles& x, const Function& function) {
  if (x.ndim() == 0) return py::float_(function(*x.data()));
  Doubles y(std::vector<py::ssize_t>(x.shape(), x.shape() + x.ndim()));
  const double* from = x.data();
  double* to = y.mutable_data();
  const auto count = x.size();
  const py::gil_scoped_release released;
  for (py::ssize_t i = 0; i < count; ++i) to[i] = function(from[i]);
  return y;
}

/// A new array of one dimension with the number value(row) for each row of `rows`.
template <class Rows, class Value>
py::array column(const Rows& rows, const Value& value) {
  using Element = std::decay_t<decltype(value(*std::begin(rows)))>;
  py::array_t<Element> array(static_cast<py::ssize_t>(std::size(rows)));
  Element* to = array.mutable_data();
  for (const auto& row : rows) *to++ = value(row);
  return array;
}

/// An object of the Python class viscontact.Columns: a dictionary whose entries are attributes,
/// too, and which has the attribute `about`. Throws py::error_already_set if Python cannot import
/// the class or make the object.
inline py::object as_columns(const py::dict& columns, const py::dict& about = py::dict()) {
  return py::module_::import("viscontact.columns").attr("Columns")(columns, about);
}

// Each of these functions adds the classes and functions that it names to the module.
void add_fits(py::module_& module);       ///< Fit, PairFit, tabulate, fit, fit_pair
void add_particles(py::module_& module);  ///< Particles, StepReport
void add_spheres(py::module_& module);    ///< simulate, rolling, swimmer

/// The class Fit of Python: a fit, and the lubrication force [M L/T^2] that it describes, as a
/// function of gap [L] and velocity [L/T].
class PythonFit {
 public:
  /// `outside` chooses the force outside the fit's interval of gaps. Throws the errors of the
  /// constructor of LubricationForce, such as Error(kBadInput) if the resistance is not positive,
  /// with `place` before their message.
  PythonFit(lubrication::Fit fit, const std::string& place,
            const lubrication::OutsideInterval& outside)
      : fit_(std::move(fit)),
        force_(with_place(place, [&] { return lubrication::LubricationForce(fit_, outside); })) {}

  const lubrication::Fit& fit() const { return fit_; }
  const lubrication::LubricationForce& force() const { return force_; }

 private:
  lubrication::Fit fit_;
  lubrication::LubricationForce force_;
};

}  // namespace viscontact::python
