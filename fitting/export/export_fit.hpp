// Writes a fit as code or data, so that other programs can use it without Viscontact. Lengths,
// masses and times are in the units of the fit. A fit, target or formula that cannot be written
// throws Error(kBadInput); a formula outside the interval for the target csv throws
// Error(kWrongUsage). Used by the command `export` (app/commands/) and by
// motions/fit/export_pair.cpp. Comments in the exported text may be changed. A change must keep the
// names of functions, keys and columns, which programs of users contain, and the order of the sums,
// so that the values agree with LubricationForce.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "viscontact/common/text/text_kind.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"

namespace viscontact::fitting {

/// A language or format of exported fits.
struct ExportTarget {
  std::string_view name;         ///< as users type it after `--to`, such as "c-header"
  std::string_view description;  ///< what it is, in a line for --help
  TextKind kind;                 ///< syntax of the text, which decides how comments are written
  /// The function that export_fit() calls; it has the arguments and errors of export_fit().
  std::string (*write)(const lubrication::Fit& fit, std::string_view source,
                       const lubrication::OutsideInterval& outside);
};

/// All targets: c-header, fortran, python, matlab, json, csv. Each contains the resistance R(q)
/// [M/T] at the gap q [L], the force -R(q) u [M L/T^2] at the velocity u [L/T], the integral
/// Gamma(q) of R from the sphere's radius to q [M L/T], and the interval, error and source of the
/// fit. json has the weights of the terms and 201 samples; csv has 201 samples in the columns gap,
/// resistance, impulse (Gamma) and force (at the fit's reference velocity). At a gap outside the
/// interval for which the user chose no formula, the code returns NaN (C, Fortran, MATLAB) or
/// raises ValueError (Python).
std::span<const ExportTarget> export_targets();

/// The text of `fit` for the target with the name `target`. `source` is the name of the fit's file,
/// which the text states; it may be empty. `outside` says which formulas give the drag outside the
/// interval. Throws Error(kWrongUsage) for the target csv if `outside` has a formula, because csv
/// has samples within the interval only; Error(kBadInput) for an unknown target, if the resistance
/// of the fit is not positive and finite in the interval, or if `outside` asks for a formula k/q +
/// constant below the interval, and the fit has no k > 0 [M L/T].
std::string export_fit(const lubrication::Fit& fit, std::string_view target,
                       std::string_view source = "",
                       const lubrication::OutsideInterval& outside = {});

}  // namespace viscontact::fitting
