// Pieces of HTML: escaped text, sections, links and rows of tables.
#pragma once

#include <string>
#include <string_view>

#include "viscontact/results/run_folder.hpp"

namespace viscontact::report {

/// The text with the special characters of HTML escaped.
std::string escaped(std::string_view text);

/// A section with a heading; empty if `body` is empty.
std::string section(std::string_view heading, const std::string& body);

/// A link from the report to a file of the run. `file` is relative to the run's folder; `words` is
/// the text of the link, by default the file's name. If there is no such file, returns the text
/// without a link.
std::string link_to(const results::RunFolder& run, const std::string& file,
                    std::string_view words = {});

/// A row "<tr><td>a</td><td>b</td></tr>"; the cells must be HTML already.
template <class... Cells>
std::string table_row(const Cells&... cells) {
  std::string row = "<tr>";
  ((row.append("<td>").append(cells).append("</td>")), ...);
  return row + "</tr>\n";
}

}  // namespace viscontact::report
