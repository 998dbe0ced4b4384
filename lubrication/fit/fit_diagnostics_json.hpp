// Reads and writes the object "diagnostics" of a fit file (docs/fit.schema.json). Units are those
// of fit_diagnostics.hpp.
#pragma once

#include "viscontact/lubrication/fit/fit_diagnostics.hpp"
#include "viscontact/lubrication/fit/json_object.hpp"

namespace viscontact::lubrication {

/// Throws Error(kBadInput), which names the key, for a missing, unknown or wrong value.
FitDiagnostics read_diagnostics(const JsonObject& json);

/// The JSON object from which read_diagnostics() reads the same diagnostics.
Json write_diagnostics(const FitDiagnostics& diagnostics);

}  // namespace viscontact::lubrication
