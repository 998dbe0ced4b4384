// Writes a fit as code or data, so that other programs can use it without Viscontact. Lengths,
// masses and times are in the units of the fit. A fit, target or formula that cannot be written
// throws Error(kBadInput), or Error(kWrongUsage) if only the target csv has no place for it. Used
// by the command `export` (app/commands/) and by motions/fit/export_pair.cpp. A change must keep
// the names of functions and keys, which programs of users call, and the order of the sums, so that
// the values agree with LubricationForce.
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
  std::string_view description;  ///< a line for --help
  TextKind kind;                 ///< syntax of the text, which decides how comments are written
  /// The function that export_fit() calls; it has the arguments and errors of export_fit().
  std::string (*write)(const lubrication::Fit& fit, std::string_view source,
                       const lubrication::OutsideInterval& outside);
};

/// All targets: c-header, fortran, python, matlab, json, csv. Each contains the resistance R(q)
/// [M/T] at the gap q, the force -R(q) u [M L/T^2] at the velocity u, Gamma(q) = int_r^q R [M L/T]
/// with the sphere's radius r, and the interval, error and source of the fit. json and csv contain
/// 201 samples. If the user chose no formula for gaps outside the interval, the code returns NaN
/// there (C, Fortran, MATLAB) or raises ValueError (Python).
std::span<const ExportTarget> export_targets();

/// The text for one target. `source` is the name of the fit's file, which the text states; it may
/// be empty. `outside` says which formulas give the drag outside the interval. Throws
/// Error(kWrongUsage) for the target csv if `outside` has a formula, because csv has samples within
/// the interval only; Error(kBadInput) for an unknown target, if the resistance of the fit is not
/// positive and finite in the interval, or if `outside` asks for a k that the fit lacks or that is
/// not > 0 (LubricationForce).
std::string export_fit(const lubrication::Fit& fit, std::string_view target,
                       std::string_view source = "",
                       const lubrication::OutsideInterval& outside = {});

}  // namespace viscontact::fitting
