// Writes a fit as code or data, so that other programs can use it without Viscontact.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "viscontact/common/text/text_kind.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"

namespace viscontact::fitting {

struct ExportTarget {
  std::string_view name;         ///< as users type it after `--to`
  std::string_view description;  ///< what it is, in a line for --help
  TextKind kind;                 ///< syntax of the text, which decides how comments are written
  /// The function that export_fit() calls, with its arguments and errors.
  std::string (*write)(const lubrication::Fit& fit, std::string_view source,
                       const lubrication::OutsideInterval& outside);
};

/// All targets: c-header, fortran, python, matlab, json, csv. Each contains, in the units of the
/// fit, the resistance R(q) [M/T] at the gap q [L], the force -R(q) u [M L/T^2] at the velocity u
/// [L/T], the integral Gamma(q) of R from the sphere's radius to q [M L/T], and the interval, error
/// and source of the fit. Programs of users call the names of functions, keys and columns. json has
/// the weights of the terms and 201 samples; csv has 201 samples in the columns gap, resistance,
/// impulse (Gamma) and force (at the fit's reference velocity). At a gap outside the interval for
/// which the user chose no formula, the code returns NaN (C, Fortran, MATLAB) or raises ValueError
/// (Python).
std::span<const ExportTarget> export_targets();

/// The text of `fit` for the target with the name `target`. `source` is the name of the fit's file,
/// which the text states; it may be empty. `outside` says which formulas give the drag outside the
/// interval. Throws Error(kWrongUsage) for the target csv if `outside` has a formula;
/// Error(kBadInput) for an unknown target, if the resistance of the fit is not positive and finite
/// in the interval, or if `outside` asks for a formula k/q + constant below the interval, and the
/// fit has no k > 0 [M L/T].
std::string export_fit(const lubrication::Fit& fit, std::string_view target,
                       std::string_view source = "",
                       const lubrication::OutsideInterval& outside = {});

}  // namespace viscontact::fitting
