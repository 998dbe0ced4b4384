// What a person at the terminal sees: a progress line, words in colour; plain text anywhere else.
#pragma once

#include <string>
#include <string_view>

namespace viscontact {

/// Replaces the progress line by `text` if standard error is a terminal that can do that.
void show_progress(const std::string& text);

/// Removes it.
void clear_progress();

/// A line on standard error: what is being done.
void say(const std::string& text);

/// The same with its word "warning:" in yellow.
void warn(const std::string& text);

/// The same with its first word in red: an error.
void complain(const std::string& text);

enum class Colour { kRed = 31, kGreen = 32, kYellow = 33 };

/// The word for that stream (a file descriptor): in colour if it is a terminal, and NO_COLOR (no-color.org) is not set.
std::string coloured(std::string_view word, Colour colour, int descriptor);

}  // namespace viscontact
