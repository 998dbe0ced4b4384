// Texts of several lines on one line, for journals and messages.
#pragma once

#include <algorithm>
#include <string>

namespace viscontact {

/// A space takes the place of each "\n"; a "\r" stays.
inline std::string on_one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

}  // namespace viscontact
