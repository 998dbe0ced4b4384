// Numbers as text and back without loss, in any locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viscontact {

/// The shortest decimal text that reads back to the same double, which must be finite. Hashes in
/// files are computed from such texts.
std::string format_number(double value);
/// Appends the text of format_number().
void append_number(std::string& text, double value);

/// The double nearest to a decimal text, which blanks and tabs may surround and a "+" may begin.
/// Nothing if the text is empty or not one finite number in the range of a double, such as "nan",
/// "inf", "1e400", "1e-400" or "1.5x".
std::optional<double> parse_number(std::string_view text);

}  // namespace viscontact
