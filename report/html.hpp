// Small pieces of HTML.
#pragma once

#include <string>
#include <string_view>

#include "viscontact/results/run_folder.hpp"

namespace viscontact {

/// Text with the characters that mean something in HTML replaced.
std::string escaped(std::string_view text);

/// A heading with what it heads; empty if there is nothing.
std::string section(std::string_view heading, const std::string& body);

/// A link from a run's report to a file of the run, by its name relative to the folder; the words alone if there is no such file.
std::string link_to(const RunFolder& run, const std::string& file, std::string_view words = {});

/// "<tr><td>a</td><td>b</td></tr>" of cells that are HTML already.
template <class... Cells>
std::string table_row(const Cells&... cells) {
  std::string row = "<tr>";
  ((row.append("<td>").append(cells).append("</td>")), ...);
  return row + "</tr>\n";
}

}  // namespace viscontact
