// Makes case files with one change, for tests of the reader of cases: the lecture's case or another
// one. The line numbers that the functions return are those that messages must have.
#pragma once

#include <string>
#include <string_view>

#include "tests/common/temporary_folder.hpp"
#include "viscontact/case_file/case_file.hpp"

namespace viscontact::case_file {

/// A key of data/cases/lecture.toml as it stands there.
struct LectureKey {
  const char* path;   ///< as errors name it: "tabulation.gaps.from", below the header [tabulation]
  const char* value;  ///< "1e-3"
};

/// A changed text, and the line where an error is to be reported.
struct EditedCase {
  std::string text;
  int line = 0;
};

/// The text of data/cases/lecture.toml.
std::string lecture_text();

/// The lecture's case with another value (TOML) of the key, and the line of the key.
EditedCase with_value(const LectureKey& key, std::string_view value);

/// The lecture's case without the key, and the line of its table: that of the header, or of the key
/// whose value is an inline table.
EditedCase without_key(const LectureKey& key);

/// The lecture's case with `from`, which occurs once, replaced by `to`, and the line in which `to`
/// begins.
EditedCase with_text(std::string_view from, std::string_view to);

/// The text of a case file with the first `from` replaced by `to`.
std::string text_with(const std::string& path, std::string_view from, std::string_view to);

/// Reads a case from a file with this text in a temporary folder. Throws the errors of read_case().
Case read_text(const std::string& text);

/// Expects that the case is refused as bad input at the line and the key `path`. `words` are a part
/// of the message that matters to the user.
void expect_refused(const EditedCase& edited, const std::string& path,
                    const std::string& words = "");

}  // namespace viscontact::case_file
