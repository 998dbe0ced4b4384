// Text for a place that holds one line.
#pragma once

#include <algorithm>
#include <string>

namespace viscontact {

/// The text with its line ends as spaces.
inline std::string on_one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

}  // namespace viscontact
