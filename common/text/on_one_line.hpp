// Turns a text of several lines into one line. freefem_axi/, particles/, pipeline/ and report/ use
// it for journals and messages that have one line each. Only "\n" counts as a line end: a "\r"
// stays. Nothing is refused or thrown. A change may alter only line ends, because journals are read
// again.
#pragma once

#include <algorithm>
#include <string>

namespace viscontact {

/// The text with a space in place of each "\n"; its length stays. Nothing is thrown.
inline std::string on_one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

}  // namespace viscontact
