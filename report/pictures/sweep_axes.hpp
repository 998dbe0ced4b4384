// What an axis of a sweep's picture shows, in words, with its unit.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "viscontact/common/text/units.hpp"

namespace viscontact::report {

/// The name of a key or column of a sweep, or of a quotient "COLUMN/KEY", with its unit, such as
/// "sphere.radius [m]". Without the unit if `units` is empty, or if the dimension depends on the
/// kind of the case.
std::string axis_label(std::string_view name, const Units& units);

/// The label of the axis of several columns: what their names have in common after the last dot,
/// and their unit, as far as all agree; it may be empty.
std::string common_axis_label(const std::vector<std::string>& columns, const Units& units);

}  // namespace viscontact::report
