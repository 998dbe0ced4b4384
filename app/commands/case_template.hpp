// The commented case that `viscontact init` writes.
#pragma once

#include <string_view>

namespace viscontact {

/// The text of case_template.toml.
std::string_view case_template();

}  // namespace viscontact
