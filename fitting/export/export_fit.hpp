// Writes a fit as code or data for other programs, which can use it without Viscontact. Lengths,
// masses and times are in the units of the fit. A change must keep the names of functions and keys,
// and the order of the sums, so that the values agree with LubricationForce.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "viscontact/common/text/text_kind.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"

namespace viscontact::fitting {

/// A language or format.
struct ExportTarget {
  std::string_view name;         ///< as users type it
  std::string_view description;  ///< a line for --help
  TextKind kind;                 ///< kind of the written text
  /// Makes the text for a fit. `source`, which may be empty, is the name of the fit's file.
  /// Outside the interval the drag is that of `outside`.
  std::string (*write)(const lubrication::Fit& fit, std::string_view source,
                       const lubrication::OutsideInterval& outside);
};

/// All targets: c-header, fortran, python, matlab, json, csv. Each contains, with the gap q, the
/// velocity u and the radius r, the resistance R(q) [M/T], the force -R(q) u [M L/T^2] and Gamma(q)
/// = int_r^q R [M L/T], and the interval, error and source of the fit. The sums have the order of
/// LubricationForce, so that the values agree to the last digits. Outside the interval, as far as
/// the user has chosen no limit of the drag, the code returns NaN (C, Fortran, MATLAB) or raises
/// ValueError (Python).
std::span<const ExportTarget> export_targets();

/// The text for one target. `source` is the name of the fit's file, which the text states; it may
/// be empty. `outside` is the drag outside the interval; csv, which has none, refuses it with
/// Error(kWrongUsage). Throws Error(kBadInput) for an unknown target, and the Error of
/// LubricationForce for a fit with an impossible drag.
std::string export_fit(const lubrication::Fit& fit, std::string_view target,
                       std::string_view source = "",
                       const lubrication::OutsideInterval& outside = {});

}  // namespace viscontact::fitting
