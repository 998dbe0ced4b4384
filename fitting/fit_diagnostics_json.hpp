// The "diagnostics" of a fit file.
#pragma once

#include "fitting/fit_diagnostics.hpp"
#include "fitting/json_object.hpp"

namespace viscontact {

/// Throws Error(kBadInput) naming the offending key.
FitDiagnostics read_diagnostics(const JsonObject& json);

Json write_diagnostics(const FitDiagnostics& diagnostics);

}  // namespace viscontact
