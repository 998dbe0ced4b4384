// The contacts of a step in a fluid, docs/physics.md (6.4), and their Coulomb friction (6.14).
#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/constraint_rows/contact_rows.hpp"
#include "viscontact/constraint_rows/solver_names.hpp"
#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/contact/contact_laws.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/links/links.hpp"
#include "viscontact/particles/setting/fluid.hpp"
#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/state/pair_memory.hpp"
#include "viscontact/particles/state/state.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

// Arrays of velocities [L/T, 1/T], and of forces and loads [M L/T^2, M L^2/T^2], have
// MotionLayout::components numbers for each particle; masses and impulses of discs are per length.
// Contact is made at the threshold gap D_c (Fluid::threshold_gap): the gap of a contact is D - D_c
// with the distance D of the surfaces. gamma <= 0 is minus the impulse that the film of a contact
// has absorbed, and gamma_min the gamma at which the solids touch.

/// The velocity [L/T] at which the gap of a contact opens with the `velocities` v of all particles:
/// G v, with a row G of coefficients for each contact.
inline double opening(const Contact<2>& contact, const double* velocities,
                      const MotionLayout& layout) {
  assert(contact.second >= 0);
  double sum = 0;
  for (std::size_t d = 0; d < layout.directions(); ++d) {
    sum += contact.normal[d] * velocities[layout.at(contact.second, d)];
    if (contact.first >= 0) sum -= contact.normal[d] * velocities[layout.at(contact.first, d)];
  }
  if (contact.levers[1] != 0) sum += contact.levers[1] * velocities[layout.at(contact.second, 2)];
  if (contact.levers[0] != 0) sum += contact.levers[0] * velocities[layout.at(contact.first, 2)];
  return sum;
}

/// Linearised gap D - D_c + h G v [L] at the end of a step of length h [T].
inline double gap_after(const Contact<2>& contact, const double* velocities, double h,
                        const MotionLayout& layout) {
  return contact.gap + h * opening(contact, velocities, layout);
}

/// The largest speed of the centre of a particle [L/T]; NaN if a speed is NaN, 0 without particles.
inline double fastest(std::span<const double> velocities, const MotionLayout& layout) {
  assert(velocities.size() % layout.components == 0);
  double largest = 0;
  for (std::size_t k = 0; k < velocities.size(); k += layout.components) {
    double square = 0;
    for (std::size_t d = 0; d < layout.directions(); ++d)
      square += velocities[k + d] * velocities[k + d];
    largest = largest_or_nan(largest, std::sqrt(square));
  }
  return largest;
}

/// Adds the `force` of a contact [M L/T^2], > 0 if it pushes, to the forces and torques of all.
inline void add_contact_force(const Contact<2>& contact, double force, std::span<double> forces,
                              const MotionLayout& layout) {
  assert(contact.second >= 0);
  for (std::size_t d = 0; d < layout.directions(); ++d) {
    forces[layout.at(contact.second, d)] += contact.normal[d] * force;
    if (contact.first >= 0) forces[layout.at(contact.first, d)] -= contact.normal[d] * force;
  }
  if (contact.levers[1] != 0) forces[layout.at(contact.second, 2)] += contact.levers[1] * force;
  if (contact.levers[0] != 0) forces[layout.at(contact.first, 2)] += contact.levers[0] * force;
}

/// The velocities that given forces and torques add to those of all particles. Linear and positive
/// semidefinite, and symmetric except in a fluid with inertia; may throw the errors of FluidSolver.
using Mobility = std::function<std::vector<double>(std::span<const double> forces)>;

struct ContactConditions {
  std::span<const double> free_velocities;  ///< velocities without contact of all particles
  double h = 0;                             ///< length of the step [T]
  MotionLayout layout;
  SolverSettings solver;
  double mean_radius = 0;  ///< of the particles [L], > 0
  /// Relative error [1], >= 0, of velocities and of the mobility, below which no residual can fall.
  double velocity_error = 0;
  /// Impulse of a force in the step, divided by h times the force [1]:
  /// FluidImpactStep::impulse_time over h.
  double share_of_impulse = 1;
  /// Largest change [T/M], >= 0, of the velocity of a gap or slip by a unit force of its contact,
  /// with which hinges count as holding it, so that it is left out of the problem; 0: none is held.
  double least_w = 0;
  double least_reach = 0;  ///< pairs are listed up to this distance at least [L], >= 0
  /// False in a fluid with inertia: moving fluid carries the effect of a contact downstream.
  bool is_symmetric = true;
  /// True: impulses that already are a solution within the tolerances stay as they are.
  bool keeps_solution = false;
};

/// Error [L] of a gap after the step by rounding; NaN if a velocity without contact is NaN.
inline double rounding_error_of_gaps(const ContactConditions& conditions) {
  assert(conditions.h > 0 && conditions.velocity_error >= 0);
  // In mean radii [1]: some 50 units in the last place.
  constexpr double kOfPositions = 1e-14;
  return kOfPositions * conditions.mean_radius +
         conditions.velocity_error * conditions.h *
             fastest(conditions.free_velocities, conditions.layout);
}

/// Contact::w of a contact that is left out of the problem because hinges hold its gap.
inline constexpr double kImmovable = -1;

/// Sets Contact::allowed, the allowed residual [L], from the tolerances of gaps and impulses. For
/// contacts with w <= 0, which are left out of the problem, it is the tolerance of gaps alone.
///
/// Returns the impulse at work in each contact [M L/T], >= 0: the smaller one of those on its two
/// particles. The impulse at work on a particle is the largest of the impulses of its contacts and
/// of those with which a contact alone would keep its gap from changing.
std::vector<double> set_allowed(std::span<Contact<2>> contacts,
                                const ContactConditions& conditions);

/// Measures the residuals of contacts for the `velocities` that the particles have with their
/// impulses. Sets Contact::allowed. StepResiduals::impulse_errors gets one number for each contact,
/// 0 if the contact is left out of the problem. A residual that is NaN is not allowed.
StepResiduals measure_residuals(std::span<Contact<2>> contacts, std::span<const double> velocities,
                                const ContactConditions& conditions);

/// Up to this number of contacts ContactProblem computes its matrix W, by one product with the
/// mobility for each. For more contacts conjugate gradients compute products with W, if it is
/// symmetric.
inline constexpr std::size_t kMostDenseContacts = 24;
/// The same where the velocities of single particles by unit forces differ by more than the factor
/// kDifferentMobilities: conjugate gradients would need very many products.
inline constexpr std::size_t kMostDifferentContacts = 300;
inline constexpr double kDifferentMobilities = 100;

/// Finds the impulses p of contacts such that for each contact p >= gamma, and that the gap after
/// the step is >= 0 if p = gamma, and 0 if p > gamma, for the velocities v = free velocities +
/// mobility(G^T p/h). This is the dual problem (5.4) of docs/physics.md with the matrix W = G
/// mobility G^T [T/M] in place of h G M^-1 G^T.
///
/// If there are few contacts, W is assembled and Newton's method solves the problem. If it cycles,
/// or if there are many contacts, MPRGP does (conjugate gradients with gradient projection).
class ContactProblem {
 public:
  /// `mobility` and the velocities of `conditions` must outlive the object.
  ContactProblem(const ContactConditions& conditions, const Mobility& mobility)
      : conditions_(conditions),
        mobility_(mobility),
        velocities_(conditions.free_velocities.begin(), conditions.free_velocities.end()) {
    assert(conditions.h > 0);
  }

  /// Adds a contact, whose `impulse` is a first guess. The mobility must move at least one of its
  /// particles.
  void add(const Contact<2>& contact) { contacts_.push_back(contact); }

  /// Finds the impulses and the `w` of all contacts. Contacts may be added afterwards; the next
  /// solution then begins with the impulses found. A rough solution of many contacts has wider
  /// tolerances; it serves to find other contacts that must be added. Returns false if residuals
  /// are larger than allowed.
  [[nodiscard]] bool solve(bool is_rough);

  const std::vector<Contact<2>>& contacts() const { return contacts_; }
  /// Before solve() those without contact.
  const std::vector<double>& velocities() const { return velocities_; }
  /// Sums of the contact forces p/h, and of their torques, on each particle.
  std::vector<double> loads() const;
  int iterations() const { return iterations_; }
  const contact_solver::StagesRun& stages() const { return stages_; }
  bool is_rough() const { return is_rough_; }
  /// Velocities of all particles by a unit force of each contact; empty if they were not needed.
  std::vector<std::vector<double>> responses() const {
    return is_dense_ ? responses_ : std::vector<std::vector<double>>{};
  }
  /// StepContacts::amplification.
  double amplification() const { return amplification_; }

 private:
  void solve_dense();
  /// Corrects the impulses of a dense problem that is solved.
  void correct();
  /// Improves the impulses with one call of the mobility for each product with W.
  void solve_by_products();
  void take_velocities();

  ContactConditions conditions_;
  const Mobility& mobility_;
  std::vector<Contact<2>> contacts_;
  std::vector<std::vector<double>> responses_;  // velocities by a unit force of each contact
  std::vector<double> velocities_;
  double amplification_ = 1;
  bool is_dense_ = true, are_different_ = false;
  int iterations_ = 0;
  contact_solver::StagesRun stages_;
  bool is_rough_ = false;
};

/// The friction of a contact whose solids may touch, docs/physics.md (6.14).
struct ContactFrictionInFluid {
  std::size_t contact = 0;  ///< number in StepContacts::contacts
  /// The normal, turned by 90 degrees to the left.
  std::array<double, 2> tangent{};
  /// Change of the slip [L] per counter-clockwise turn [rad] of both particles.
  std::array<double, 2> levers{};
  /// Part of the slip of the step [L] that the motions of the particles do not cause, along the
  /// tangent: the displacement of the periodic image that touches, relative to the second particle,
  /// or at an obstacle minus that of the obstacle.
  double displacement = 0;
  /// gamma - gamma_min >= 0 [M L/T]: the impulse that the film takes up before the solids touch;
  /// infinite if they never touch.
  double capacity = 0;
  /// Impulse of friction on the second particle along the tangent [M L/T]; a guess before the
  /// problem is solved.
  double impulse = 0;
  /// Change of the slip per impulse of friction [T/M], >= 0; 0 if it is not known, or if a hinge
  /// holds the place at which the friction acts.
  double w = 0;
  /// The sign of `impulse`, 1 or -1, if the solids slide; 0 if they stick or do not touch.
  int slides = 0;

  /// Velocity [L/T] along the tangent of the surface of the second particle relative to that of the
  /// first, without the part of `displacement`.
  double slip_rate(const Contact<2>& of, const double* velocities,
                   const MotionLayout& layout) const {
    assert(layout.components == 3);
    double sum = 0;
    for (std::size_t d = 0; d < 2; ++d) {
      sum += tangent[d] * velocities[layout.at(of.second, d)];
      if (of.first >= 0) sum -= tangent[d] * velocities[layout.at(of.first, d)];
    }
    sum += levers[1] * velocities[layout.at(of.second, 2)];
    if (of.first >= 0) sum += levers[0] * velocities[layout.at(of.first, 2)];
    return sum;
  }
  /// The slip [L] of a step of length h [T].
  double slip(const Contact<2>& of, const double* velocities, double h,
              const MotionLayout& layout) const {
    return displacement + h * slip_rate(of, velocities, layout);
  }
  /// Adds a force of friction [M L/T^2], and its torques, to those of all particles.
  void add_force(const Contact<2>& of, double force, std::span<double> forces,
                 const MotionLayout& layout) const {
    assert(layout.components == 3);
    for (std::size_t d = 0; d < 2; ++d) {
      forces[layout.at(of.second, d)] += tangent[d] * force;
      if (of.first >= 0) forces[layout.at(of.first, d)] -= tangent[d] * force;
    }
    forces[layout.at(of.second, 2)] += levers[1] * force;
    if (of.first >= 0) forces[layout.at(of.first, 2)] += levers[0] * force;
  }
  /// Part of the normal impulse that the solids carry, p_s of (5.7) [M L/T], >= 0.
  double solid_load(const Contact<2>& of) const { return load_of_solids(of.impulse, capacity); }
};

struct FrictionOfStep;

/// The circles that touch both surfaces of a contact at the beginning of the step and have their
/// radii of curvature (SurfaceContact).
struct ContactCircles {
  PairRadii radii{};  ///< [L]
  /// Their centres from those of the particles, along the normal [L]; 0 for discs and obstacles.
  std::array<double, 2> arms{};
};

struct StepContacts {
  std::vector<Pair> pairs,  ///< of particles that may touch in this step, with their memory
      walls;                ///< of a particle and an obstacle
  /// The contacts of all `pairs`, then of all `walls`, then of the stops of hinges, which have no
  /// film. Contacts that take no part have the impulse 0 and w = 0 or kImmovable.
  std::vector<Contact<2>> contacts;
  std::vector<ContactCircles> circles;  ///< of `pairs`, then of `walls`
  /// Of the contacts with a finite capacity, in the order of `contacts`; empty without friction.
  std::vector<ContactFrictionInFluid> frictions;
  /// Velocities of all particles by a unit force of each contact [T/M, T/(M L)]; may be empty in a
  /// problem of many contacts.
  std::vector<std::vector<double>> of_gaps;
  /// The same by a unit force of each friction along its tangent.
  std::vector<std::vector<double>> of_slips;
  /// Estimate of the largest error of a scaled impulse sqrt(w) p over the largest residual/sqrt(w)
  /// [1], >= 1, where of_gaps is not known.
  double amplification = 1;
  std::vector<double> loads;       ///< forces and torques of contacts and friction on particles
  std::vector<double> velocities;  ///< with these forces
  int iterations = 0;  ///< products with the mobility, and iterations of a dense problem
  contact_solver::StagesRun stages;  ///< which methods of solution ran
  bool is_solved = true;
  bool has_given_loads = false;  ///< given loads bound the friction (solve_with_friction())
  double reach = 0;  ///< all pairs whose surfaces are nearer than this are listed [L], > 0
};

/// Finds the impulses of `step.contacts`, whose impulses are first guesses. A contact takes part if
/// its gap would close, or if its impulse or lower bound is not 0; rounds add those whose gaps the
/// solution has closed. Adds to `step.iterations`.
void solve_listed(StepContacts& step, const Mobility& mobility,
                  const ContactConditions& conditions);

/// The largest distance [L] of two surfaces that can come to contact in a step in which all
/// particles move with `velocities`.
double reach_of(const State& state, const Fluid& fluid, std::span<const double> velocities,
                const ContactConditions& conditions);

/// The stops of hinges (bounds of their angles) as contacts. The gap [L] of a stop is the angle
/// that is left before it, times the radius of the particle that the hinge holds.
std::vector<Contact<2>> contacts_of_stops(const Links& links, const Particles& particles);

/// Adds the torques [M L^2/T^2] of the stops of hinges to `link_forces` (State::link_forces). The
/// last of the `contacts` must be those of contacts_of_stops(), with their impulses in a step of
/// length `h` [T].
void add_torques_of_stops(const Links& links, const Particles& particles,
                          std::span<const Contact<2>> contacts, double h,
                          std::span<double> link_forces);

/// Lists the pairs that may come to contact in the step, until no other gap can close, and finds
/// the impulses of their contacts. `state` is that before the step, `obstacles` are at their places
/// at its end. The finite rotation of particles that are not round is taken into account up to a
/// quarter of the tolerance of gaps. `friction` may be null.
///
/// Throws Error(kNotConverged) if two particles with sides turn so far that they overlap at a place
/// that was no contact of theirs.
StepContacts solve_contacts(const State& state, const Fluid& fluid, const Links& links,
                            std::span<const PlanePosition> obstacles,
                            const std::function<bool(const Pair&)>& is_left_out,
                            const Mobility& mobility, const ContactConditions& conditions,
                            ThreadPool& pool, const FrictionOfStep* friction = nullptr);

struct FrictionOfStep {
  const Setting& setting;            ///< in the plane, with ContactLaws::friction and a fluid
  std::span<const Plane> obstacles;  ///< obstacles_of(setting)
  const PairMemories& memories;      ///< State::memories, with the friction of the step before
  double begin = 0;                  ///< time at which the step begins [T]
  double end = 0;                    ///< time at which it ends [T], > begin
};

/// Where friction acts.
struct FrictionPlace {
  /// Distances of the contact from the centres of both particles along the normal [L].
  std::array<double, 2> arms{};
  Vector on_obstacle{};  ///< the point of the obstacle at the contact [L]
};

/// The friction of a contact before the problem is solved, without ContactFrictionInFluid::contact,
/// w and slides. `contact` must have the distance D of the surfaces as its gap, and the particles
/// are at their places at the beginning of the step. The first guess of the impulse is the friction
/// in the memory of the pair. `radii` are those of ContactCircles.
ContactFrictionInFluid friction_of_contact(const FrictionOfStep& step, const Particles& particles,
                                           const Pair& pair, const Contact<2>& contact,
                                           const FrictionPlace& place, const PairRadii& radii,
                                           const ContactConditions& conditions);

/// Finds the impulses of contacts as solve_listed() does, but with friction. If Coulomb's law is
/// not reached, `step.is_solved` is false and `step.has_given_loads` is true: the friction is then
/// bounded by mu_s times the loads of an earlier iteration or of a solution without friction,
/// docs/physics.md (5.17), and gaps and films are exact for this friction.
void solve_with_friction(StepContacts& step, double mu_s, const Mobility& mobility,
                         const ContactConditions& conditions);

/// The power [M L^2/T^3] that friction turns into heat in the step, >= 0 up to the tolerances, for
/// the `velocities` with which the particles move.
double heat_of_friction(const StepContacts& step, std::span<const double> velocities,
                        const ContactConditions& conditions);

/// Adds the residuals [L] of Coulomb's law: the slip of a contact that sticks, the error of the
/// friction times ContactFrictionInFluid::w if it slides.
void take_residuals_of_friction(const StepContacts& step, double mu_s,
                                std::span<const double> velocities,
                                const ContactConditions& conditions, StepResiduals& residuals);

}  // namespace viscontact::particles
