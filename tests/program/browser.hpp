// A page in a browser (chromium, without a window), played by a script.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace viscontact {

/// What a script appended to a copy of the page gives to tell(), once; in a frame of this width in
/// pixels: a window of chromium's is never narrower than 500. No name of a network is resolved. A
/// failure, and null, if there is no browser, if it says anything on its console, or if the script
/// does not come to its end.
nlohmann::json read_in_browser(const std::string& page, std::string_view script, int width);

}  // namespace viscontact
