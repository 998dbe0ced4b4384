#include "viscontact/lubrication/regime.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

#include "viscontact/lubrication/stokes_drag.hpp"

namespace viscontact::lubrication {

double stokes_number(double mass, double radius, double speed, double viscosity) {
  assert(viscosity > 0 && radius > 0);
  return mass * speed / (stokes_resistance(viscosity, radius) * radius);
}

double drag_over_stokes(double reynolds) {
  assert(reynolds >= 0);
  return 1 + 0.15 * std::pow(reynolds, 0.687);
}

std::optional<std::string> reynolds_warning(double reynolds) {
  if (!(reynolds > kLargestReynolds)) return {};
  const double ratio = drag_over_stokes(reynolds);
  return fmt::format(
      "the Reynolds number reaches {:.4g}, where the drag of Stokes flow is too small by {} (1 + "
      "0.15 Re^0.687 far from walls, Schiller & Naumann)",
      reynolds,
      ratio < 2 ? fmt::format("{:.2g} %", 100 * (ratio - 1))
                : fmt::format("a factor of {:.3g}", ratio));
}

std::optional<std::string> film_warning(double film_stokes, std::string_view remedy) {
  if (!(film_stokes < kSmallestFilmStokes)) return {};
  return fmt::format(
      "the momentum of the landing is {:.2g} of the impulse of the film: the drag before contact, "
      "which viscous contact neglects, decides when the solids touch and how thin the film gets "
      "(10 to 18 % too early from a gap of one radius); {}",
      film_stokes, remedy);
}

}  // namespace viscontact::lubrication
