// The case with comments that `viscontact init` writes; CMake makes the source from
// case_template.toml.
#pragma once

#include <string_view>

namespace viscontact::app {

/// The text of case_template.toml.
std::string_view case_template();

}  // namespace viscontact::app
