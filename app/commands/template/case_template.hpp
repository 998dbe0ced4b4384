// The commented case that `viscontact init` writes. CMake makes its source from case_template.toml;
// a change must keep all values of that file valid, because users run it as it is.
#pragma once

#include <string_view>

namespace viscontact::app {

/// The text of case_template.toml.
std::string_view case_template();

}  // namespace viscontact::app
