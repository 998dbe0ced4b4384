// One time step of viscous contact: the projection and the memory that the three contact models
// share.
#pragma once

namespace viscontact {

/// A sphere at distance `gap` >= 0 from where contact is, and what the film remembers.
struct ContactState {
  double gap = 0;       ///< D [L]; 0 in contact
  double velocity = 0;  ///< u [L/T]
  double gamma = 0;     ///< adhesion potential [M L/T], gamma_min <= gamma <= 0; D gamma = 0
};

/// The scheme of viscous contact (Maury 2007, "A gluey particle model"; Lefebvre 2009, "Numerical
/// simulation of gluey particles") for one contact. `free_velocity` is what the velocity would be
/// at the end of the step without contact; with step h,
///
///     u^{n+1}     = argmin { |v - free_velocity|^2_m : D + h v >= 0 if gamma^n = 0,
///                                                      D + h v  = 0 if gamma^n < 0 },
///     lambda      = m (u^{n+1} - free_velocity) / h,
///     gamma^{n+1} = gamma^n - h lambda,
///     D^{n+1}     = D^n + h u^{n+1}.
///
/// A step that would bring gamma above 0 releases the sphere with what is left: gamma = 0, m
/// u^{n+1} = the excess. A step that would bring it below `gamma_min` (<= 0; -infinity for a smooth
/// contact) leaves it there: the solid carries the rest.
ContactState contact_step(const ContactState& state, double free_velocity, double mass,
                          double gamma_min, double step);

}  // namespace viscontact
