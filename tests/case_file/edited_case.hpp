// The lecture's case file, or another one, with one thing changed.
#pragma once

#include <string>
#include <string_view>

#include "tests/common/temporary_folder.hpp"
#include "viscontact/case_file/case_file.hpp"

namespace viscontact::case_file {

/// A key of data/cases/lecture.toml as it stands there.
struct LectureKey {
  const char* path;    ///< as errors name it: "tabulation.gaps.from"
  const char* header;  ///< the last header line before it, with its brackets; empty: none
  const char* name;    ///< "from"
  const char* value;   ///< "1e-3"
};

/// A changed text, and the line where an error is to be reported.
struct EditedCase {
  std::string text;
  int line = 0;
};

/// The text of data/cases/lecture.toml.
std::string lecture_text();

/// With another value (TOML); the line is the key's.
EditedCase with_value(const LectureKey& key, std::string_view value);

/// Without the key; the line is that of its table: where the header or the inline table's key
/// stands.
EditedCase without_key(const LectureKey& key);

/// With `from` (there once) replaced by `to`; the line is where that begins.
EditedCase with_text(std::string_view from, std::string_view to);

/// The text of a case file with the first `from` replaced by `to`.
std::string text_with(const std::string& path, std::string_view from, std::string_view to);

/// Reads a case from a file of that text in a folder of its own.
Case read_text(const std::string& text);

/// Expects that the case is refused as bad input with a message "FILE:LINE: path ..." that also has
/// `words`.
void expect_refused(const EditedCase& edited, const std::string& path, const std::string& words);

}  // namespace viscontact::case_file
