// One line on a terminal that says how far a long computation is; nothing elsewhere.
#pragma once

#include <string>

namespace viscontact {

/// Replaces the progress line by `text` if standard error is a terminal.
void show_progress(const std::string& text);

/// Removes it.
void clear_progress();

/// A line on standard error: what is being done, or a warning.
void say(const std::string& text);

}  // namespace viscontact
