// The files of report/particles/page, as they are built into the executable
// (cmake/embed_texts.cmake).
#pragma once

#include <string_view>

namespace viscontact {

std::string_view particles_script();
std::string_view particles_style();

}  // namespace viscontact
