// Many spheres with lubrication between close pairs, docs/physics.md (8.1) to (8.6).
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/state/state.hpp"
#include "viscontact/particles/steps/particle_simulation.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

/// The stress of a suspension and what it consists of, at one instant or as the mean over a step.
struct Rheology {
  double time = 0;         ///< [T]
  double strain = 0;       ///< since the start of the case [1]
  double shear_rate = 0;   ///< [1/T]: given, or the result of a given stress
  double viscosity = 0;    ///< sigma_xy/(viscosity of the fluid times shear rate) [1]
  double n1 = 0, n2 = 0;   ///< (sigma_xx - sigma_yy), (sigma_yy - sigma_zz) over the same [1]
  double pressure = 0;     ///< minus the mean of the normal stresses of the particles, over the same
  double viscosity_film = 0, viscosity_contact = 0, viscosity_friction = 0;  ///< parts of `viscosity`
  std::size_t pairs = 0, contacts = 0;
  double smallest_gap = 0;  ///< [L], infinite without pairs
};

/// Computes the motion of spheres in space. Their velocities in the state are those in the fluid,
/// not relative to the flow.
class SuspensionSimulation : public ParticleSimulation {
 public:
  /// `setting` has PairLubrication and no fluid. `state` is that of a restart file, or a state of
  /// which only the particles, which turn, are set. Throws Error(kBadInput) if a period is too short
  /// for the range of a pair.
  SuspensionSimulation(Setting setting, State state, int threads);
  ~SuspensionSimulation() override;

  StepReport step(double end) override;
  const State& state() const override;
  std::span<double> added_forces() override;
  std::span<double> added_torques() override;

  /// Of the last step; before the first step that of the instant.
  const Rheology& rheology() const;
  /// Computes velocities and stress at the present places, without moving anything.
  const Rheology& solve_instant();

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace viscontact::particles
