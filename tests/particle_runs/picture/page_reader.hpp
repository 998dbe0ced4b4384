// Opens a page of particles in a browser.
#pragma once

#include "tests/program/browser.hpp"

namespace viscontact::particles {

/// The value with which `script`, appended to the page of particles, calls tell() (browser.hpp).
inline nlohmann::json read_page(std::string page, std::string_view script, int width) {
  constexpr std::string_view kHead = "<head>";
  // With virtual time the browser calls no requestAnimationFrame, which the page needs to draw.
  constexpr std::string_view kFrames =
      "<script>window.requestAnimationFrame = draw => setTimeout(() => draw(performance.now()), "
      "16);</script>";
  page.insert(page.find(kHead) + kHead.size(), kFrames);
  return read_in_browser(page, script, width);
}

}  // namespace viscontact::particles
