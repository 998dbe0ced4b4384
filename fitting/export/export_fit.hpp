// A fit as code or numbers that stand alone, for other programs.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "viscontact/common/text_kind.hpp"
#include "viscontact/lubrication/fit.hpp"

namespace viscontact {

struct ExportTarget {
  std::string_view name;         ///< what users type
  std::string_view description;  ///< a line for --help
  TextKind kind;                 ///< of the text
  std::string (*write)(const Fit& fit, std::string_view source);
};

/// Every target there is: c-header, fortran, python, json, csv. Each holds the resistance R(q), the force -R(q) u and Gamma(q) = int_r^q R, summed in the
/// order of LubricationForce so that the values agree to the last digits, with interval, error and source of the fit.
/// Code outside the interval answers NaN (C, Fortran) or raises ValueError (Python).
std::span<const ExportTarget> export_targets();

/// The text for that target. `source` is the name of the fit's file, which is named in the text, or
/// empty. Throws Error(kBadInput) for an unknown name, and as LubricationForce for a fit that is of no use.
std::string export_fit(const Fit& fit, std::string_view target, std::string_view source = "");

}  // namespace viscontact
