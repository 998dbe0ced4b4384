// Opens a page in a browser (chromium without a window) and runs a script in it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace viscontact {

/// Appends `script` to a copy of the page, opens the copy, and returns the value with which the
/// script calls tell(), which it must do once. The page is in a frame of `width` pixels, because a
/// window of chromium is at least 500 pixels wide. The browser has no network. Fails the test and
/// returns null if there is no browser, if it writes anything to its console, or if the script does
/// not end.
nlohmann::json read_in_browser(const std::string& page, std::string_view script, int width);

}  // namespace viscontact
