#include "reduced_model/contact_step.hpp"

#include <algorithm>

namespace viscontact {

ContactState contact_step(const ContactState& state, double free_velocity, double mass,
                          double gamma_min, double step) {
  const bool glued = state.gamma < 0;
  const bool touches = glued || state.gap + step * free_velocity < 0;
  if (!touches) return {state.gap + step * free_velocity, free_velocity, 0};

  const double velocity = -state.gap / step;  // to the contact, where D + h v = 0
  const double gamma = state.gamma - mass * (velocity - free_velocity);
  if (gamma > 0) {
    const double released = gamma / mass;
    return {step * released, released, 0};
  }
  return {0, velocity, std::max(gamma, gamma_min)};
}

}  // namespace viscontact
