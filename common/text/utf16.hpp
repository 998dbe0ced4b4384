// Texts in UTF-16, which some editors and shells of other systems write in place of UTF-8.
#pragma once

#include <string>
#include <string_view>

#include "viscontact/common/error.hpp"

namespace viscontact {

/// True if the first two bytes are a byte order mark of UTF-16 or an ASCII character in UTF-16.
inline bool is_utf16(std::string_view text) {
  return text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") ||
         (text.size() > 1 && (text[0] == '\0') != (text[1] == '\0'));
}

/// Throws Error(kBadInput) if the content of `file` is UTF-16.
inline void refuse_utf16(std::string_view text, const std::string& file) {
  if (is_utf16(text))
    throw_bad_input({file}, "is encoded in UTF-16; save it in UTF-8, in which files are read");
}

}  // namespace viscontact
