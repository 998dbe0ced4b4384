// Turns a text of several lines into one line, for journals and messages that have one line each.
// Only line ends may change.
#pragma once

#include <algorithm>
#include <string>

namespace viscontact {

/// The text with a space in place of each line end.
inline std::string on_one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

}  // namespace viscontact
