// Many spheres with lubrication between close pairs, docs/physics.md (9.1) to (9.26).
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/state/state.hpp"
#include "viscontact/particles/steps/particle_simulation.hpp"
#include "viscontact/particles/steps/step_report.hpp"
#include "viscontact/suspensions/values/rheology.hpp"

namespace viscontact::particles {

/// Computes the motion of spheres in space. Their velocities in the state are those in the fluid,
/// not relative to the flow.
class SuspensionSimulation : public ParticleSimulation {
 public:
  /// `setting` has PairLubrication and no fluid. `state` is that of a restart file, or a state of
  /// which only the particles, which turn, are set. Throws Error(kBadInput) if a period is too
  /// short for the range of a pair, at the start or while the flow strains the box, if the flow
  /// does not carry the images of spheres or does not stick to a wall or plane, if a piece of it is
  /// shorter than StepGrid::least_piece(), if a stress is given beside inertia, walls or planes, if
  /// spheres with inertia would move otherwise than their images, also because the run before had
  /// another shear, if motions are given, if spheres overlap, or if one has no mass with inertia.
  /// Throws Error(kNotConverged) if the run before has brought images of spheres too near. The
  /// results have the same bits for any number of `threads`.
  SuspensionSimulation(Setting setting, State state, int threads);
  ~SuspensionSimulation() override;
  SuspensionSimulation(SuspensionSimulation&&) noexcept;

  /// A step that is not solved is taken in half of its length, and so on; its report and rheology()
  /// are those of the part. Throws Error(kNotConverged) if the spheres jam, and Error(kBadInput) if
  /// a plane does not move with the flow.
  StepReport step(double end) override;
  const State& state() const override;
  std::span<double> added_forces() override;
  std::span<double> added_torques() override;

  /// Of the last step; before the first step that of the instant.
  const Rheology& rheology() const;
  /// Computes velocities, which with inertia are given, and stress at the present places, without
  /// moving anything.
  const Rheology& solve_instant();

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace viscontact::particles
