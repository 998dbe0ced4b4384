// Opens a page of particles in a browser.
#pragma once

#include "tests/program/browser.hpp"

namespace viscontact::particles {

/// What the script, appended to a page of particles, gives to tell() (browser.hpp).
inline nlohmann::json read_page(std::string page, std::string_view script, int width) {
  constexpr std::string_view kHead = "<head>";
  // A browser with virtual time draws no frames of its own accord.
  constexpr std::string_view kFrames =
      "<script>window.requestAnimationFrame = draw => setTimeout(() => draw(performance.now()), "
      "16);</script>";
  page.insert(page.find(kHead) + kHead.size(), kFrames);
  return read_in_browser(page, script, width);
}

}  // namespace viscontact::particles
