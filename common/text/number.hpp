// Converts numbers to text and back without loss. The locale has no effect. All parts use these
// functions for the numbers in text files other than JSON and TOML. A change must keep the texts,
// because hashes in files are computed from them. Nothing is thrown.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viscontact {

/// The shortest decimal text that reads back to the same double. `value` must be finite (asserted).
std::string format_number(double value);

/// The double nearest to a decimal text, which blanks may surround. Returns nothing if the text is
/// not one finite number in the range of a double, such as "nan", "inf", "1e400" or "1.5x".
std::optional<double> parse_number(std::string_view text);

}  // namespace viscontact
