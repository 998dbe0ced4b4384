// The scripts (JavaScript) and styles (CSS) in report/page and report/particles/page, which are
// built into the executable (report/embed_texts.cmake), so that pages load nothing from elsewhere.
// report/CMakeLists.txt lists the same names with the files; a change must change both.
#pragma once

#include <string_view>

namespace viscontact::report {

std::string_view uplot_script();
std::string_view uplot_style();
std::string_view uplot_licence();
std::string_view report_script();
std::string_view report_style();

}  // namespace viscontact::report
