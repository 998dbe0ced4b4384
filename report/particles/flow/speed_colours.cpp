// The scale of speeds [L/T] (speed_colours.hpp). The picture and the page must have the same
// colours.
#include "viscontact/report/particles/flow/speed_colours.hpp"

#include <fmt/format.h>

#include <cmath>

#include "viscontact/report/pictures/colours.hpp"

namespace viscontact::report {

std::string speed_colour(double share) {
  // Lightness falls evenly from 0.985 to 0.6 in OKLab (Ottosson 2020), whose differences are about
  // those that the eye sees; the hue goes from 205 to 254 degrees.
  static const std::vector<ColourNode> kBlues = {{0, {243, 252, 253}},   {0.2, {182, 235, 248}},
                                                 {0.4, {128, 212, 245}}, {0.6, {88, 186, 238}},
                                                 {0.8, {67, 157, 226}},  {1, {64, 128, 206}}};
  return colour_between(kBlues, share);
}

std::vector<std::pair<double, std::string>> speed_ticks(double top) {
  constexpr double kAbout = 4;  // approximate number of intervals between ticks
  const double rough = top / kAbout, decade = std::pow(10, std::floor(std::log10(rough)));
  const double step = decade * (rough < 1.5 * decade ? 1
                                : rough < 3 * decade ? 2
                                : rough < 7 * decade ? 5
                                                     : 10);
  std::vector<std::pair<double, std::string>> ticks;
  for (int i = 0; i * step <= top * (1 + 1e-9); ++i)
    ticks.emplace_back(i * step, fmt::format("{:.3g}", i * step));
  return ticks;
}

}  // namespace viscontact::report
