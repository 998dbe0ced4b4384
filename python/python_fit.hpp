// A fit with its force, as the class Fit of Python and the function simulate use it. Numbers are in
// the units of the fit. A change must keep the values bit for bit those of the libraries.
#pragma once

#include <string>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"

namespace viscontact::python {

/// The class Fit of Python.
class PythonFit {
 public:
  /// Throws the errors of LubricationForce with `place` before their message.
  PythonFit(lubrication::Fit fit, const std::string& place,
            const lubrication::OutsideInterval& outside)
      : fit_(std::move(fit)),
        force_(with_place(place, [&] { return lubrication::LubricationForce(fit_, outside); })) {}

  const lubrication::Fit& fit() const { return fit_; }                   ///< the coefficients
  const lubrication::LubricationForce& force() const { return force_; }  ///< the force of the fit

 private:
  lubrication::Fit fit_;
  lubrication::LubricationForce force_;
};

}  // namespace viscontact::python
