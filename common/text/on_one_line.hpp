// Turns a text of several lines into one line. freefem_axi/, particles/, pipeline/ and report/ use
// it for journals and messages that have one line each. Only "\n" counts as a line end: a "\r" is
// not changed. Any text is accepted, and nothing is thrown. Another character may take the place of
// the space. A change must keep all other characters, because the program reads lines of journals
// again.
#pragma once

#include <algorithm>
#include <string>

namespace viscontact {

/// The text with a space in place of each "\n"; it may be empty, and its length does not change.
/// Nothing is thrown.
inline std::string on_one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

}  // namespace viscontact
