// One time step of viscous contact of a sphere, physics.md (4.5) to (4.7), in any consistent units.
// D is the gap less the gap at which contact begins, m the mass, u the velocity.
#pragma once

#include <algorithm>
#include <cassert>

namespace viscontact::reduced_model {

/// The state of the sphere, with the memory gamma of the film, which absorbs the impulse -gamma
/// when the sphere lands, and gives it back before the sphere is released.
struct ContactState {
  double gap = 0;       ///< D [L]; 0 in contact
  double velocity = 0;  ///< u [L/T]
  double gamma = 0;     ///< minus the impulse in the film [M L/T], gamma_min to 0; 0 if D > 0
};

/// The constants of all steps of one length.
struct ContactSetting {
  /// The arguments are the members.
  ContactSetting(double mass_, double gamma_min_, double step_)
      : mass(mass_), gamma_min(gamma_min_), step(step_), per_mass(1 / mass_), per_step(1 / step_) {
    assert(mass_ > 0 && gamma_min_ <= 0 && step_ > 0);
  }
  double mass;  ///< m [M], > 0
  /// Value of gamma at which the solids touch [M L/T], <= 0; -infinity without solid contact.
  double gamma_min;
  double step;      ///< h [T], > 0
  double per_mass,  ///< 1/m [1/M], stored because a division is slow
      per_step;     ///< 1/h [1/T]
};

/// The state at the end of a step, and the impulses [M L/T] that the sphere received in it.
struct ContactStep {
  /// At the end of the step.
  ContactState state;
  /// Impulse of the film, gamma^n - gamma^{n+1}; < 0 while the film pulls the sphere to the wall.
  double film = 0;
  double drag = 0;   ///< impulse of the resolved drag
  double solid = 0;  ///< impulse of the solid contact, >= 0
};

/// Each type `Drag` for contact_step() must have the members of this one.
struct NoDrag {
  /// Whether the model resolves a drag.
  static constexpr bool kResolved = false;
  /// The velocity v [L/T] with m v + Gamma_res(D + h v) - Gamma_res(D) = momentum [M L/T], where D
  /// + h v >= 0. Gamma_res is the primitive of the resolved resistance; the second argument is D.
  static double velocity(const ContactSetting& setting, double, double momentum) {
    return momentum * setting.per_mass;
  }
  /// Gamma_res(to) - Gamma_res(from) [M L/T], for two values of D.
  static double impulse(double, double) { return 0; }
};

/// One step of viscous contact (Maury 2007, "A gluey particle model"; Lefebvre 2009, "Numerical
/// simulation of gluey particles"). `push` = h f^n is the impulse of the external force in the step
/// [M L/T], lambda the force of the contact on the sphere, and Gamma_res is 0 if the model resolves
/// no drag:
///
///     m (u^{n+1} - u^n) = h f^n - (Gamma_res(D^{n+1}) - Gamma_res(D^n)) + h lambda,
///     D^{n+1} = D^n + h u^{n+1},   gamma^{n+1} = gamma^n - h lambda,
///     D^{n+1} >= 0, lambda >= 0, D^{n+1} lambda = 0   if gamma^n = 0,
///     D^{n+1} = 0                                     if gamma^n < 0.
///
/// Without drag this is the projection
///
///     u^{n+1} = argmin { m |v - u^n - h f^n/m|^2 : D^n + h v >= 0 if gamma^n = 0,
///                                                  D^n + h v  = 0 if gamma^n < 0 }.
///
/// The drag enters by its impulse. Therefore the impulse that the film absorbs in an impact and
/// gives back before the release is exact for every step length. A step that would raise gamma
/// above 0 sets it to 0 and releases the sphere with the rest of the impulse. A step that would
/// lower gamma below `gamma_min` sets it to `gamma_min`, and the solid carries the rest.
template <class Drag>
ContactStep contact_step(const ContactState& state, double push, const ContactSetting& setting,
                         const Drag& drag) {
  assert(!(state.gap < 0) && !(state.gamma > 0));
  const double momentum = setting.mass * state.velocity + push;
  // The impulse of the drag in the step is the change of the momentum, because a difference of two
  // values of Gamma_res would contain the rounding errors of both gaps.
  const auto drag_impulse_of_step = [&](double velocity, double before) {
    return Drag::kResolved ? setting.mass * velocity - before : 0.0;
  };
  if (!(state.gamma < 0)) {
    const double to_contact = -state.gap * setting.per_step;
    const double of_drag = -drag.impulse(state.gap, 0);
    // The impulse h lambda of the contact if the step ends at D = 0.
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

}  // namespace viscontact::reduced_model
