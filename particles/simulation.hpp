// Many particles with viscous contact.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "viscontact/particles/contact_law.hpp"
#include "viscontact/particles/particles.hpp"
#include "viscontact/particles/piecewise_constant.hpp"
#include "viscontact/particles/plane.hpp"
#include "viscontact/particles/projection/projection.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

struct ProjectionResult;

/// What moves the particles, and how it is computed: as a case file has it (case_file/particles_case.hpp checks it); forces name particles that are there.
struct Setting {
  std::vector<Plane> planes;
  Vector gravity{};  ///< [L/T^2]
  std::map<std::int32_t, PiecewiseConstant>
      forces;  ///< of single particles, beside gravity [M L/T^2]
  ContactLaw law;
  double time_step = 0;  ///< h [T], > 0
  SolverSettings solver;
};

/// One step, for the record.
struct StepReport {
  double time = 0;           ///< at its end [T]
  std::size_t contacts = 0;  ///< in the projection
  std::size_t glued = 0;     ///< with gamma < 0 after it
  int iterations = 0;        ///< in all parts
  /// Largest |min(D + h G v, w (p - gamma))| of the close pairs, over the mean radius.
  double residual = 0;
  /// The same divided by w, over the impulses at work on the contact's particles.
  double impulse_residual = 0;
  bool converged = true;       ///< both residuals of each contact are within the tolerances
  double largest_overlap = 0;  ///< of linearised gaps, which no gap is below, over the mean radius
  int parts = 0;               ///< that the step was divided into, a power of 2
  /// Contacts that turn further than kLargestTurn (contact_geometry.hpp) in the smallest part.
  std::size_t unresolved = 0;
};

/// The lecture's problem for many particles (physics.md, section 5; Maury 2006, "A time-stepping scheme for inelastic collisions";
/// Lefebvre 2009, "Numerical simulation of gluey particles"):
///
///     D_ij >= 0,  gamma_ij <= 0,  D_ij gamma_ij = 0,     M d^2q/dt^2 = M f + sum lambda_ij G_ij,   dgamma_ij/dt = -lambda_ij,
///
/// velocities projected, in the norm of M, on G_ij.v = 0 where gamma_ij < 0 and G_ij.v >= 0 where gamma_ij = 0 and D_ij = 0. One convex projection
/// (contact_graph.hpp) a step: a film holds a pair by at most the impulse that it has taken, so that the pair leaves within the step in which gamma
/// comes to 0, with what is left of the pull; at gamma_min the solids carry the rest. As the linearised gap of two spheres is never above their gap, a
/// converged step leaves no overlap beyond the tolerance.
class Simulation {
 public:
  /// `state` as read_restart gave it, or one with its particles only. `threads` >= 1; they do not change a bit of the result.
  Simulation(Setting setting, State state, int threads);
  ~Simulation();
  Simulation(Simulation&&) noexcept;

  /// One step of size h; less if `end` comes first by more than a millionth of h; none if less than
  /// that is left. A step in which particles that touch turn about each other by more than
  /// kLargestTurn is halved, up to kMostHalvings times; contacts and glued films in the report are
  /// then those of the last part. Throws Error(kNotConverged), the state being that of before the
  /// step, if a position or a displacement is beyond what can
  /// be computed with, or if the projection has not converged and leaves an overlap of more than the
  /// mean radius, as it does where walls close on particles.
  StepReport step(double end);

  /// The smallest part of a step is a 256th: it resolves the contact of equal particles that move
  /// past each other at up to 256 radii a step.
  static constexpr int kMostHalvings = 8;

  const State& state() const { return state_; }
  const Setting& setting() const { return setting_; }

 private:
  struct StepBuffers;
  template <int D>
  void advance(double h, double next, int halvings, StepReport& report);
  template <int D>
  void advance_whole(double h, double next, StepReport& report);
  template <int D>
  void accept(const ProjectionResult& projected, double h, double next, StepReport& report);
  template <class Visit>
  void for_films(const Visit& visit) {
    for (auto* films : {&state_.pairs, &state_.walls})
      for (auto& film : *films) visit(film);
  }
  [[noreturn]] void throw_step_without_solution(const ProjectionResult& projected,
                                                double next) const;
  template <int D>
  void move_freely(double h, double next);  // displacements h u* of a step that ends at `next`
  template <int D>
  ProjectionResult project(double h, double next);  // displacements h u* become h v
  template <int D>
  void move(double h);

  Setting setting_;
  State state_;
  double mean_radius_;
  std::unique_ptr<StepBuffers> work_;
};

/// How far from the origin a particle may be, and how far it may go in a step [L]: beyond, double precision does not hold its gaps to the tolerance (of
/// SolverSettings).
double largest_resolved_distance(double tolerance, double mean_radius);

}  // namespace viscontact::particles
