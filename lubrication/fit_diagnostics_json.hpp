// The "diagnostics" of a fit file.
#pragma once

#include "viscontact/lubrication/fit_diagnostics.hpp"
#include "viscontact/lubrication/json_object.hpp"

namespace viscontact {

/// Throws Error(kBadInput) naming the offending key.
FitDiagnostics read_diagnostics(const JsonObject& json);

Json write_diagnostics(const FitDiagnostics& diagnostics);

}  // namespace viscontact
