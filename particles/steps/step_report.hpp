// The report of a time step, for steps.csv and run.json, and the residuals that decide whether the
// step has converged.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

/// Estimates of the errors of velocities or forces in a fluid, each divided by the largest velocity
/// or force [1]. A negative number means that no estimate was made.
struct RelativeErrors {
  double best = -1;         ///< of the results that are extrapolated from two meshes
  double of_one_mesh = -1;  ///< of the results on the first mesh, which move the particles
  /// The part of both errors that is due to the penalty, a finite viscosity inside the particles.
  double of_penalty = -1;
};

/// FluidStepReport::advection_error above which a step is named. Below it drags and velocities of
/// particles are right to about 1 % (docs/fluid.md has figures).
inline constexpr double kNamedAdvectionError = 0.02;

struct FluidStepReport {
  /// True in the first step of a fluid with inertia, whose flow the next step computes again. The
  /// report then has no dissipation, forces and probes, and the kinetic energy of the flow at the
  /// start.
  bool is_computed_again = false;
  double dissipation = 0;  ///< of the flow [M L^2/T^3], in two dimensions per length [M L/T^3]
  /// Dissipation over that of the flow without particles [1], docs/physics.md (6.6); 0 if the
  /// latter is 0 or unknown.
  double apparent_viscosity = 0;
  // In a fluid with inertia:
  double kinetic_energy = 0;  ///< of the fluid [M L^2/T^2], in two dimensions per length [M L/T^2]
  /// Largest 2 r |V| density/viscosity of a particle of velocity V and radius r in the fluid [1].
  double reynolds_number = 0;
  /// Largest path of the fluid relative to the mesh in the step, over the length of an edge [1].
  double courant_number = 0;
  /// With Advection::kCharacteristics the power of the error of the rate of change along the paths
  /// of the fluid, over that of advection and viscosity [1], docs/physics.md after (6.9).
  double advection_error = 0;
  /// Sum of the forces of the fluid on the particles whose motion is given [M L/T^2], in two
  /// dimensions per length [M/T^2]: x and y; on an axis only the first, along z.
  std::array<double, 2> given_force{};
  double flow_time = 0;  ///< time of the flow that the step has computed [T]
  /// Flow [L^2/T] and mean pressure [M/(L T^2)] of each probe of the case at flow_time.
  std::vector<std::array<double, 2>> probes{};
  double seconds = 0;              ///< wall time of the step: mesh, fluid solver and contacts [s]
  RelativeErrors velocity_errors;  ///< of the velocities of the particles
  RelativeErrors force_errors;     ///< of the forces of the fluid on the particles
};

/// What is recorded of one step. For a contact, let d be the gap after the step [L]: the gap
/// linearised in the displacements, or the distance of the surfaces if the contact belongs to a set
/// with rigid bodies or links that turns (ContactSystem::gap()). Let p be the impulse of the
/// contact [M L/T], gamma its lower bound (minus the impulse that the film had absorbed before the
/// step), and w the change of the gap per impulse [T/M].
struct StepReport {
  double time = 0;           ///< time at the end of the step [T]
  std::size_t contacts = 0;  ///< in the problem that the step solves
  std::size_t glued = 0;     ///< contacts with gamma < 0 after the step
  /// Iterations of the solver, summed over the parts of the step. With friction, bodies or links
  /// each set of connected particles is solved by itself, and those of the set that needs most are
  /// counted.
  int iterations = 0;
  /// Parts into which the step was divided because particles move fast or sweeps did not solve
  /// Coulomb's law, 1 to 256; 0 if no time was left for a step.
  int parts = 0;
  /// The methods of the contact solver that ran and their iterations, summed over all sets and
  /// parts, such as "sweeps:60+proximal_steps:12"; empty if there was nothing to solve.
  std::string solver_stages{};
  /// Largest residual |min(d, w (p - gamma))| of a contact, divided by the mean radius [1].
  double residual = 0;
  /// Largest error of an impulse, divided by the impulse at work in the contact or link [1]: the
  /// largest of the impulse of forces, the change of momentum, and the impulses of contacts and
  /// links on a particle in the step (docs/particles.md, "The projection").
  double impulse_residual = 0;
  bool converged = true;  ///< true if the residuals of all contacts and links are allowed
  /// Largest residual over what is allowed for its contact or link [1], >= 0; infinite if the step
  /// did not converge for another reason.
  double excess = 0;
  /// Largest overlap -d, divided by the mean radius [1]. No true gap is smaller than d.
  double largest_overlap = 0;
  /// Contacts whose particles pass each other by more than half the sum of their radii even in the
  /// smallest parts of the step (kLargestTurn in contact.hpp), too far for linearised gaps.
  std::size_t unresolved = 0;
  /// True if in a part of the step the friction was bounded by normal impulses that were fixed
  /// beforehand, because Coulomb's law or its convex relaxation was not solved, docs/physics.md
  /// (5.17).
  bool has_given_loads = false;
  /// The largest kappa, docs/physics.md (5.21), in a fluid the largest z, (6.15), of links that
  /// push [1], >= 0: above 1 the step does not resolve how what they push buckles. In a fluid also
  /// half of the z of films that pull and that no row turns with the motion, those of plates and
  /// ellipses, and with Coupling::kSplitting all films: above 1 what the film pulls may vibrate
  /// across it with a growing amplitude.
  double buckling = 0;
  /// True if films that pull have no springs across them, docs/physics.md (5.21), because the step
  /// has no solution with these.
  bool lacks_springs = false;
  /// The obstacles and particles with given motions that push on others in the step, such as "plane
  /// -3 and particle 7"; empty if there are none, and in a fluid.
  std::string pressing{};
  double given_load = 0;  ///< sum of the normal forces on these bodies [M L/T^2], >= 0
  /// True if these bodies leave the others no room: the step has not converged, and leaves overlaps
  /// far beyond the tolerance.
  bool jams = false;
  FluidStepReport fluid{};  ///< default values if there is no fluid
};

/// The residuals of all contacts and links of a step. A residual [L] is the distance of a gap or a
/// length from the value that its condition demands; docs/particles.md, "The projection", says what
/// is allowed. Particles with masses and particles in a fluid are measured in the same way.
struct StepResiduals {
  double largest = 0;  ///< [L]
  double excess = 0;   ///< largest residual over what is allowed for its contact or link [1], >= 0
  /// Largest error of an impulse over the impulse at work in its contact or link [1].
  double of_impulses = 0;
  double smallest_gap = 0;  ///< smallest gap d (see StepReport) [L], 0 if all are larger than 0
  Pair deepest_overlap;     ///< the pair with the smallest gap, if this is < 0
  bool converged = true;    ///< true if all residuals are allowed
  /// Estimate of the error of the impulse of each contact [M L/T]; where it is unknown, the
  /// residual divided by Contact::w.
  std::vector<double> impulse_errors;

  /// Takes a residual [L] into account; `allowed` > 0 is the largest one that is allowed. Returns
  /// true and sets `converged` to false if the residual is larger or not a number. A residual that
  /// is not a number leaves `largest` as it is and makes `excess` infinite.
  bool take(double residual, double allowed);
  /// The same for the error of an impulse; both are [M L/T].
  bool take_error(double error, double allowed);
  /// Takes the residual of an impulse into account [M L/T], unless the impulse at work is 0.
  void take_impulse(double residual, double at_work);
  /// A gap that is not a number counts as the smallest one, whatever gaps follow.
  void take_gap(double gap, const Pair& pair);
};

/// Enters the residuals of a step, or of a part of it, in the report, where the larger values stay.
/// StepReport::excess becomes infinite if the step has not converged although no excess is above 1.
void report_residuals(const StepResiduals& residuals, double mean_radius, StepReport& report);

/// Throws Error(kNotConverged) if a step that ends at `time` [T] has not converged and leaves an
/// overlap of more than `mean_radius` [L]. `reason` returns the end of the message.
void refuse_deep_overlap(const StepResiduals& residuals, const Particles& particles,
                         const Setting& setting, double mean_radius, double time,
                         const std::function<std::string()>& reason);

/// The name of a pair in messages, with the ids of its particles: "particles 3 and 4", "particle 3
/// and plane 1", or, if the domain has walls, "particle 3 and obstacle 1".
std::string name_of_pair(const Pair& pair, const Particles& particles, const Setting& setting);

}  // namespace viscontact::particles
