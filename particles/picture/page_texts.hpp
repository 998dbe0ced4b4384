// The scripts and styles in particles/picture/page, which are built into the executable
// (report/embed_texts.cmake). CMakeLists.txt lists the same names with the files.
#pragma once

#include <string_view>

namespace viscontact::particles {

std::string_view flow_script();
std::string_view particles_script();
std::string_view particles_style();

}  // namespace viscontact::particles
