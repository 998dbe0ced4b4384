// Converts numbers to text and back without loss. The locale has no effect. Every file of
// Viscontact is written and read by these functions. A change must keep the texts, because hashes
// in files are computed from them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viscontact {

/// The shortest decimal text that reads back to the same double. `value` must be finite.
std::string format_number(double value);

/// The double nearest to a decimal text, which blanks may surround. Returns nothing if the text is
/// not one finite number in the range of a double; so for "nan", "inf", "1e400" and "1.5x".
std::optional<double> parse_number(std::string_view text);

}  // namespace viscontact
