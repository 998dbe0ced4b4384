// Numbers to text and back, without loss and without regard to the locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viscontact {

/// The shortest decimal text that reads back to the same double; value must be finite.
std::string format_number(double value);

/// The double nearest to the decimal text (surrounding blanks allowed); nothing if the text is not
/// one finite number that a double can hold (so not "nan", "inf", "1e400", "1e-400" or "1.5x").
std::optional<double> parse_number(std::string_view text);

}  // namespace viscontact
