// Converts numbers to text and back without loss. The locale has no effect. All parts use these
// functions for the numbers in text files other than JSON and TOML. Numbers have any unit. Nothing
// is thrown. Further formats may be read; a change must keep the text of each number, because
// hashes in files are computed from such texts.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viscontact {

/// The shortest decimal text that reads back to the same double. `value` must be finite (asserted;
/// a build without assertions writes "inf" or "nan").
std::string format_number(double value);

/// The double nearest to a decimal text, which blanks and tabs may surround and a "+" may begin.
/// Returns nothing if the text is empty or not one finite number in the range of a double, such as
/// "nan", "inf", "1e400", "1e-400" or "1.5x".
std::optional<double> parse_number(std::string_view text);

}  // namespace viscontact
