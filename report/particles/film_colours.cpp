// Computes colours by the scale viridis, and the ticks of the scale of gamma (film_colours.hpp).
// The picture and the page must have the same colours.
#include "viscontact/report/particles/film_colours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viscontact/report/pictures/colours.hpp"

namespace viscontact::report {

double lowest_gamma(const particles::Playback& playback) {
  double lowest = 0;
  for (const auto& frame : playback.frames)
    for (const auto& contact : frame.contacts)
      if (std::isfinite(contact.gamma)) lowest = std::min(lowest, contact.gamma);
  return lowest;
}

const char* film_words(const particles::Playback& playback) {
  const bool are_discs_in_fluid =
      playback.dimension == 2 &&
      std::ranges::any_of(playback.frames, [](const auto& frame) { return !frame.flow.empty(); });
  return are_discs_in_fluid
             ? "gamma: minus the impulse per length that the film has absorbed [mass/time]"
             : "gamma: minus the impulse that the film has absorbed [mass × length/time]";
}

bool has_contact_without_film(const particles::Frame& frame) {
  return std::ranges::any_of(frame.contacts, [](const auto& c) { return !(c.gamma < 0); });
}

bool has_sliding_contact(const particles::Frame& frame) {
  return std::ranges::any_of(frame.contacts, [](const particles::CurrentContact& contact) {
    return contact.friction == particles::ContactFriction::kSlides;
  });
}

std::string film_colour(double share) {
  // Colour-blind readers can tell the colours of the scale viridis apart, and so can readers of a
  // print in grey.
  static const std::vector<ColourNode> kViridis = {
      {0, {253, 231, 37}},     {0.125, {173, 220, 48}}, {0.25, {94, 201, 98}},
      {0.375, {40, 174, 128}}, {0.5, {33, 145, 140}},   {0.625, {44, 114, 142}},
      {0.75, {59, 82, 139}},   {0.875, {71, 45, 123}},  {1, {68, 1, 84}}};
  return colour_between(kViridis, share);
}

std::string film_colour(int level, int levels) {
  return film_colour(static_cast<double>(level) / (levels - 1));
}

std::vector<double> film_ticks(double lowest) {
  constexpr double kAbout = 4;  // approximate number of intervals between ticks
  const double rough = -lowest / kAbout, decade = std::pow(10, std::floor(std::log10(rough)));
  const double step = decade * (rough < 1.5 * decade ? 1
                                : rough < 3 * decade ? 2
                                : rough < 7 * decade ? 5
                                                     : 10);
  std::vector<double> ticks;
  for (int i = 0; i * step <= -lowest * (1 + 1e-9); ++i) ticks.push_back(i == 0 ? 0 : -i * step);
  return ticks;
}

std::string film_tick_text(double tick) {
  return fmt::format("{}{:.3g}", tick < 0 ? "−" : "", std::abs(tick));
}

}  // namespace viscontact::report
