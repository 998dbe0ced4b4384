// The files of report/page and report/particles/page, as they are built into the executable
// (report/embed_texts.cmake).
#pragma once

#include <string_view>

namespace viscontact::report {

std::string_view uplot_script();
std::string_view uplot_style();
std::string_view uplot_licence();
std::string_view report_script();
std::string_view report_style();
std::string_view particles_script();
std::string_view particles_style();

}  // namespace viscontact::report
