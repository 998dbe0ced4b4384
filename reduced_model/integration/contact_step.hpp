// One time step of viscous contact: the projection and the memory that the contact models share.
#pragma once

#include <algorithm>

namespace viscontact {

/// A sphere at distance `gap` >= 0 from where contact is, and what the film remembers.
struct ContactState {
  double gap = 0;       ///< D [L]; 0 in contact
  double velocity = 0;  ///< u [L/T]
  double gamma = 0;     ///< adhesion potential [M L/T], gamma_min <= gamma <= 0; D gamma = 0
};

/// What is the same in every step of one length.
struct ContactSetting {
  ContactSetting(double mass_, double gamma_min_, double step_)
      : mass(mass_), gamma_min(gamma_min_), step(step_), per_mass(1 / mass_), per_step(1 / step_) {}
  double mass;       ///< m [M], > 0
  double gamma_min;  ///< solid contact [M L/T], <= 0; -infinity: none
  double step;       ///< h [T], > 0
  double per_mass, per_step;
};

/// A step's end, and the impulses [M L/T] that the sphere took in it.
struct ContactStep {
  ContactState state;
  double film =
      0;  ///< of the film that gamma stands for, gamma^n - gamma^{n+1}; < 0 when it holds a pulled sphere
  double drag = 0;   ///< of the drag that is resolved
  double solid = 0;  ///< of the solids, >= 0
};

/// Drag that acts at a distance, as contact_step wants it: none.
struct NoDrag {
  static constexpr bool kResolved = false;
  /// The velocity v with m v + G(D + h v) - G(D) = momentum, G the drag's impulse (dG/dD = its resistance), where D + h v >= 0.
  double velocity(const ContactSetting& setting, double, double momentum) const {
    return momentum * setting.per_mass;
  }
  /// G(to) - G(from) [M L/T].
  double impulse(double, double) const { return 0; }
};

/// The scheme of viscous contact (Maury 2007, "A gluey particle model"; Lefebvre 2009, "Numerical simulation of gluey particles") for one
/// contact, `push` = h f^n the impulse of the external force in the step. With a drag of impulse G(D) (none in problem (P)) it is
///
///     m (u^{n+1} - u^n) = h f^n - (G(D^{n+1}) - G(D^n)) + h lambda,     D^{n+1} = D^n + h u^{n+1},     gamma^{n+1} = gamma^n - h lambda,
///     D^{n+1} >= 0 and lambda >= 0, one of them 0, if gamma^n = 0;      D^{n+1} = 0 if gamma^n < 0:
///
/// without drag, the projection u^{n+1} = argmin { |v - u^n - h f^n/m|^2_m : D + h v >= 0 if gamma^n = 0, = 0 if gamma^n < 0 }. As the drag
/// enters by its impulse, what the film takes in the step of impact and gives in that of release is exact, whatever the step:
/// m u + G(D) + gamma = int f holds to round-off as long as no solid carries.
/// A step that would bring gamma above 0 releases the sphere with what is left of the momentum. One that would bring it below `gamma_min` leaves it
/// there: the solid carries the rest.
template <class Drag>
ContactStep contact_step(const ContactState& state, double push, const ContactSetting& setting,
                         const Drag& drag) {
  const double momentum = setting.mass * state.velocity + push;
  // What the drag has taken; not the difference of two impulses G, which rounds to that of a gap.
  const auto drag_impulse_of_step = [&](double velocity, double before) {
    return Drag::kResolved ? setting.mass * velocity - before : 0.0;
  };
  if (!(state.gamma < 0)) {
    const double to_contact = -state.gap * setting.per_step;
    const double of_drag = -drag.impulse(state.gap, 0);
    // h lambda, if the step ended in contact.
    const double needed = setting.mass * to_contact - of_drag - momentum;
    if (!(needed > 0)) {
      const double velocity = drag.velocity(setting, state.gap, momentum);
      const double gap = std::max(0.0, state.gap + setting.step * velocity);
      return {{gap, velocity, 0}, 0, drag_impulse_of_step(velocity, momentum), 0};
    }
    const double gamma = std::max(-needed, setting.gamma_min);
    return {{0, to_contact, gamma}, -gamma, of_drag, needed + gamma};
  }
  const double gamma = state.gamma + momentum;
  if (gamma > 0) {
    const double velocity = drag.velocity(setting, 0, gamma);
    const double gap = setting.step * velocity;
    return {{gap, velocity, 0}, state.gamma, drag_impulse_of_step(velocity, gamma), 0};
  }
  const double kept = std::max(gamma, setting.gamma_min);
  return {{0, 0, kept}, state.gamma - kept, 0, kept - gamma};
}

}  // namespace viscontact
