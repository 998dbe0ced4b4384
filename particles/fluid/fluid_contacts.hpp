// The contacts of a step in a fluid: which pairs make contact, the impulses that keep their gaps
// open (docs/physics.md (6.4)), and their Coulomb friction (6.14). Contact is made at the threshold
// gap D_c (Fluid::threshold_gap): the gap of a contact is D - D_c here, with the distance D of the
// surfaces. gamma <= 0 is minus the impulse that the film of a contact has absorbed, and gamma_min
// the gamma at which the solids touch. Units are any consistent ones; masses and impulses of discs
// are per length. Arrays of velocities, forces and loads have MotionLayout::components numbers for
// each particle: velocities in [L/T, 1/T], forces and loads in [M L/T^2, M L^2/T^2]. The other
// sources of this folder use it. Sizes and ranges of arguments are not checked; functions throw
// only what they say. A change must keep that the film carries no friction.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/contact/contact_laws.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/fluid.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"
#include "viscontact/particles/links/links.hpp"
#include "viscontact/particles/pair_memory.hpp"
#include "viscontact/particles/setting.hpp"
#include "viscontact/particles/state.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

/// The velocity [L/T] at which the gap of a contact opens if all particles have the `velocities` v.
/// It is written G v below, with a row G of coefficients for each contact.
inline double opening(const Contact<2>& contact, const double* velocities,
                      const MotionLayout& layout) {
  double sum = 0;
  for (std::size_t d = 0; d < layout.directions(); ++d) {
    sum += contact.normal[d] * velocities[layout.at(contact.second, d)];
    if (contact.first >= 0) sum -= contact.normal[d] * velocities[layout.at(contact.first, d)];
  }
  if (contact.levers[1] != 0) sum += contact.levers[1] * velocities[layout.at(contact.second, 2)];
  if (contact.levers[0] != 0) sum += contact.levers[0] * velocities[layout.at(contact.first, 2)];
  return sum;
}

/// Linearised gap D - D_c + h G v [L] at the end of a step of length h > 0 [T].
inline double gap_after(const Contact<2>& contact, const double* velocities, double h,
                        const MotionLayout& layout) {
  return contact.gap + h * opening(contact, velocities, layout);
}

/// The largest speed of the centre of a particle [L/T]; NaN if a speed is NaN, 0 without particles.
inline double fastest(std::span<const double> velocities, const MotionLayout& layout) {
  double largest = 0;
  for (std::size_t k = 0; k < velocities.size(); k += layout.components) {
    double square = 0;
    for (std::size_t d = 0; d < layout.directions(); ++d)
      square += velocities[k + d] * velocities[k + d];
    largest = largest_or_nan(largest, std::sqrt(square));
  }
  return largest;
}

/// Adds the `force` of a contact [M L/T^2], > 0 if it pushes, to the `forces` and torques on all
/// particles.
inline void add_contact_force(const Contact<2>& contact, double force, std::span<double> forces,
                              const MotionLayout& layout) {
  for (std::size_t d = 0; d < layout.directions(); ++d) {
    forces[layout.at(contact.second, d)] += contact.normal[d] * force;
    if (contact.first >= 0) forces[layout.at(contact.first, d)] -= contact.normal[d] * force;
  }
  if (contact.levers[1] != 0) forces[layout.at(contact.second, 2)] += contact.levers[1] * force;
  if (contact.levers[0] != 0) forces[layout.at(contact.first, 2)] += contact.levers[0] * force;
}

/// A function that returns the velocities [L/T, 1/T] that given forces and torques [M L/T^2,
/// M L^2/T^2] add to those of all particles. It is linear and positive semidefinite, and symmetric
/// except in a fluid with inertia. If it asks a fluid solver, it throws the errors of FluidSolver,
/// also Error(kInterrupted) if a stop is requested.
using Mobility = std::function<std::vector<double>(std::span<const double> forces)>;

/// The step without contact, and how exact its contacts must be.
struct ContactConditions {
  std::span<const double> free_velocities;  ///< velocities without contact of all particles
  double h = 0;                             ///< length of the step [T], > 0
  MotionLayout layout;                      ///< order of all velocities and forces in arrays
  SolverSettings solver;                    ///< tolerances, and the largest number of iterations
  double mean_radius = 0;                   ///< mean radius of the particles [L], > 0
  /// Relative error [1], >= 0, of velocities and of the mobility. Residuals cannot be smaller than
  /// the errors that it causes.
  double velocity_error = 0;
  /// Impulse of a force in the step, divided by h times the force [1], > 0. It is 1, except in a
  /// fluid with inertia, where it is the length of the step before (BlowStep::kick) divided by h.
  double share_of_impulse = 1;
  /// Largest change [T/M], >= 0, of the velocity of a gap or slip by a unit force of its contact,
  /// with which this gap or slip counts as held by hinges. It is then left out of the problem. With
  /// 0 no gap or slip counts as held.
  double least_w = 0;
  double least_reach = 0;  ///< pairs are listed up to this distance at least [L], >= 0
  /// Whether the mobility is symmetric. In a fluid with inertia it is not symmetric, because moving
  /// fluid carries the effect of a contact to the contacts downstream.
  bool is_symmetric = true;
  /// True: impulses that already are a solution within the tolerances stay as they are. False: they
  /// are improved as far as the errors of the mobility allow.
  bool keeps_solution = false;
};

/// Error [L], > 0, of a gap after the step by rounding errors of positions and by errors of
/// velocities; NaN if a velocity without contact is NaN.
inline double rounding_error_of_gaps(const ContactConditions& conditions) {
  // In mean radii [1]: some 50 units in the last place; a free choice above rounding errors.
  constexpr double kOfPositions = 1e-14;
  return kOfPositions * conditions.mean_radius +
         conditions.velocity_error * conditions.h *
             fastest(conditions.free_velocities, conditions.layout);
}

/// The value of Contact::w that marks a contact as left out of the problem, because hinges hold its
/// gap.
inline constexpr double kHeld = -1;

/// Sets Contact::allowed, the allowed residual [L], from the tolerances of gaps and impulses. For
/// contacts with w <= 0, which are left out of the problem, it is the tolerance of gaps alone.
///
/// Returns the impulse at work in each contact [M L/T], one number >= 0 for each contact. The
/// impulse at work on a particle is the largest of two kinds: the impulses of its contacts, and the
/// impulses with which a contact alone would keep its gap from changing. The impulse at work in a
/// contact is the smaller one of those on its two particles.
std::vector<double> set_allowed(std::span<Contact<2>> contacts,
                                const ContactConditions& conditions);

/// Measures the residuals of contacts, for their impulses and for the `velocities` that the
/// particles have with these impulses. Sets Contact::allowed. In the result,
/// StepResiduals::impulse_errors has one number for each contact, 0 if the contact is left out of
/// the problem, and StepResiduals::converged says whether all residuals are allowed. A residual
/// that is NaN is not allowed.
StepResiduals measure_residuals(std::span<Contact<2>> contacts, std::span<const double> velocities,
                                const ContactConditions& conditions);

/// Largest number of contacts for which ContactProblem computes its matrix W, by one product with
/// the mobility for each contact. If there are more contacts and W is symmetric, conjugate
/// gradients compute products with W. The number is a free choice: it changes the time that a
/// solution takes, and results within the tolerances.
inline constexpr std::size_t kMostDenseContacts = 24;
/// The same number where the velocities of single particles by unit forces differ by more than the
/// factor kDifferentMobilities: conjugate gradients would need very many products, and the errors of
/// impulses would remain unknown.
inline constexpr std::size_t kMostDifferentContacts = 300;
/// The factor by which mobilities count as different [1].
inline constexpr double kDifferentMobilities = 100;

/// Finds the impulses p of contacts such that for each contact p >= gamma; the gap after the step
/// is >= 0 if p = gamma, and 0 if p > gamma. The gap after the step is gap_after() with the
/// velocities v = free velocities + mobility(G^T p/h). This is the dual problem (5.4) of
/// docs/physics.md with the matrix W = G mobility G^T [T/M] in place of h G M^-1 G^T.
///
/// If there are few contacts, W is assembled, and Newton's method on the set of contacts with p >
/// gamma solves the problem. If Newton's method cycles, MPRGP does: conjugate gradients with
/// gradient projection. If there are many contacts, MPRGP solves the problem with one call of the
/// mobility for each product with W.
class ContactProblem {
 public:
  /// `mobility` and the velocities of `conditions` must outlive the object.
  ContactProblem(const ContactConditions& conditions, const Mobility& mobility)
      : conditions_(conditions),
        mobility_(mobility),
        velocities_(conditions.free_velocities.begin(), conditions.free_velocities.end()) {}

  /// Adds a contact, whose `impulse` is a first guess. The mobility must move at least one of its
  /// particles (not checked).
  void add(const Contact<2>& contact) { contacts_.push_back(contact); }

  /// Finds the impulses and the `w` of all contacts. Further contacts may be added afterwards; the
  /// next solution then begins with the impulses found. If `is_rough` is true, the solution has
  /// wider tolerances and takes fewer products; it serves to find other contacts that must be
  /// added. Returns true if the residuals of all contacts are within the tolerances, or if there
  /// are no contacts. Returns false if they are not after SolverSettings::max_iterations or a fixed
  /// number of rounds. Throws what the mobility throws.
  [[nodiscard]] bool solve(bool is_rough);

  /// All contacts, in the order in which they were added, with the impulses of the last solve().
  const std::vector<Contact<2>>& contacts() const { return contacts_; }
  /// Velocities of the particles with the impulses found [L/T, 1/T]; before solve() the velocities
  /// without contact.
  const std::vector<double>& velocities() const { return velocities_; }
  /// Sums of the contact forces p/h, and of their torques, on each particle [M L/T^2, M L^2/T^2].
  std::vector<double> loads() const;
  /// Number of products with the mobility plus that of iterations with the assembled W, of all
  /// calls of solve().
  int iterations() const { return iterations_; }
  /// True if the last solution was rough.
  bool is_rough() const { return is_rough_; }
  /// Velocities of all particles by a unit force of each contact; empty if the last solution did
  /// without them.
  std::vector<std::vector<double>> responses() const {
    return is_dense_ ? responses_ : std::vector<std::vector<double>>{};
  }
  /// StepContacts::amplification.
  double amplification() const { return amplification_; }

 private:
  // The next two functions improve the impulses until the residuals are allowed, or until
  // SolverSettings::max_iterations are done.
  void solve_dense();
  void correct();
  void solve_by_products();
  /// Sets the velocities by the responses of all contacts to their impulses.
  void take_velocities();

  ContactConditions conditions_;
  const Mobility& mobility_;
  std::vector<Contact<2>> contacts_;
  std::vector<std::vector<double>> responses_;  // velocities by a unit force of each contact
  std::vector<double> velocities_;
  double amplification_ = 1;
  bool is_dense_ = true, are_different_ = false;
  int iterations_ = 0;
  bool is_rough_ = false;
};

/// The friction of a contact whose solids may touch, docs/physics.md (6.14).
struct ContactFrictionInFluid {
  std::size_t contact = 0;  ///< number in StepContacts::contacts
  /// Unit vector along the surfaces: the normal, turned by 90 degrees to the left.
  std::array<double, 2> tangent{};
  /// Change of the slip [L] per counter-clockwise turn [rad] of the first and of the second
  /// particle.
  std::array<double, 2> levers{};
  /// Part of the slip of the step [L] that the motions of the particles do not cause. If a periodic
  /// image of the second particle touches, it is the displacement of this image relative to the
  /// second particle; at an obstacle it is minus the displacement of the obstacle; both along the
  /// tangent.
  double displacement = 0;
  /// gamma - gamma_min >= 0 [M L/T]: the impulse that the film takes up before the solids touch;
  /// infinite if they never touch.
  double capacity = 0;
  /// Impulse of friction on the second particle along the tangent [M L/T]. It is a guess before the
  /// problem is solved, and then the solution.
  double impulse = 0;
  /// Change of the slip per impulse of friction [T/M], >= 0; 0 if it is not known yet, or if a
  /// hinge holds the place at which the friction acts.
  double w = 0;
  /// The sign of `impulse`, 1 or -1, if the solids slide in the solution; 0 if they stick or do not
  /// touch.
  int slides = 0;

  /// Velocity [L/T] along the tangent of the surface of the second particle relative to that of the
  /// first, for the `velocities` of all particles, without the part that `displacement` contains.
  /// `of` is the contact.
  double slip_rate(const Contact<2>& of, const double* velocities,
                   const MotionLayout& layout) const {
    double sum = 0;
    for (std::size_t d = 0; d < 2; ++d) {
      sum += tangent[d] * velocities[layout.at(of.second, d)];
      if (of.first >= 0) sum -= tangent[d] * velocities[layout.at(of.first, d)];
    }
    sum += levers[1] * velocities[layout.at(of.second, 2)];
    if (of.first >= 0) sum += levers[0] * velocities[layout.at(of.first, 2)];
    return sum;
  }
  /// The slip [L] of a step of length h > 0 [T]: the displacement along the tangent of the surface
  /// of the second particle relative to that of the first particle or of the obstacle.
  double slip(const Contact<2>& of, const double* velocities, double h,
              const MotionLayout& layout) const {
    return displacement + h * slip_rate(of, velocities, layout);
  }
  /// Adds a force of friction [M L/T^2], and its torques, to the forces of all particles.
  void add_force(const Contact<2>& of, double force, std::span<double> forces,
                 const MotionLayout& layout) const {
    for (std::size_t d = 0; d < 2; ++d) {
      forces[layout.at(of.second, d)] += tangent[d] * force;
      if (of.first >= 0) forces[layout.at(of.first, d)] -= tangent[d] * force;
    }
    forces[layout.at(of.second, 2)] += levers[1] * force;
    if (of.first >= 0) forces[layout.at(of.first, 2)] += levers[0] * force;
  }
  /// Part of the normal impulse that the solids carry, p_s of (5.7) [M L/T], >= 0.
  double carried(const Contact<2>& of) const { return FrictionLaw::carried(of.impulse, capacity); }
};

struct FrictionOfStep;

/// The contacts of a step, solved.
struct StepContacts {
  std::vector<Pair> pairs,  ///< pairs of particles that may touch in this step, with their memory
      walls;                ///< pairs of a particle and an obstacle that may touch in this step
  /// The contacts of all `pairs`, then of all `walls`, then of the stops of hinges, which have no
  /// film. Contacts that take no part have the impulse 0 and w = 0 or kHeld.
  std::vector<Contact<2>> contacts;
  /// The friction of the contacts whose solids may touch, that is with a finite capacity, in the
  /// order of `contacts`; empty without friction.
  std::vector<ContactFrictionInFluid> frictions;
  /// Velocities of all particles by a unit force of each contact [T/M, T/(M L)]; empty where they
  /// are not known, which may be in a problem of many contacts.
  std::vector<std::vector<double>> of_gaps;
  /// The same by a unit force of each friction along its tangent.
  std::vector<std::vector<double>> of_slips;
  /// The largest error of a scaled impulse sqrt(w) p over the largest residual/sqrt(w) [1], >= 1,
  /// where of_gaps is not known. It is an estimate.
  double amplification = 1;
  std::vector<double> loads;       ///< forces and torques of contacts and friction on particles
  std::vector<double> velocities;  ///< velocities of all particles with these forces [L/T, 1/T]
  int iterations = 0;     ///< products with the mobility, and iterations of a dense problem, >= 0
  bool is_solved = true;  ///< false: the residuals are larger than the tolerances
  bool has_given_loads = false;  ///< given loads bound the friction (solve_with_friction())
  double reach = 0;  ///< all pairs whose surfaces are nearer than this are listed [L], > 0
};

/// Finds the impulses of `step.contacts`, whose impulses are first guesses, in rounds. After each
/// round those contacts are added to the problem whose gaps the solution has closed. Sets the
/// impulses and w of the contacts, and `loads`, `velocities` and `is_solved` of the step; the last
/// one is false if residuals are larger than allowed. Adds the iterations to `step.iterations`.
/// Throws what the mobility throws.
void solve_listed(StepContacts& step, const Mobility& mobility,
                  const ContactConditions& conditions);

/// The largest distance [L] of two surfaces that can come to contact in a step of length
/// `conditions.h` in which all particles move with `velocities`.
double reach_of(const State& state, const Fluid& fluid, std::span<const double> velocities,
                const ContactConditions& conditions);

/// The radii [L] of both surfaces of a pair at its contact: radii_of() with the round ends of
/// plates. `obstacles` are obstacles_of(setting).
PairRadii radii_in_fluid(const Fluid& fluid, const Pair& pair, const Particles& particles,
                         std::span<const Plane> obstacles);

/// The stops of hinges as contacts, one for each stop of each hinge; empty without stops. A stop is
/// a bound of the angle of a hinge. Its gap [L] is the angle that is left before the stop, times
/// the radius of the particle that the hinge holds.
std::vector<Contact<2>> contacts_of_stops(const Links& links, const Particles& particles);

/// Adds the torques [M L^2/T^2] of the stops of hinges to `link_forces`, which has the order and
/// size of State::link_forces. The last of the `contacts` must be those of contacts_of_stops(),
/// with their impulses in a step of length `h` > 0 [T].
void add_torques_of_stops(const Links& links, const Particles& particles,
                          std::span<const Contact<2>> contacts, double h,
                          std::span<double> link_forces);

/// Lists the pairs that may come to contact in the step, and finds the impulses of their contacts.
/// The list is extended until no other gap can close. `state` is that before the step, `obstacles`
/// are at their places at the end of the step. The finite rotation of plates is taken into account
/// up to a quarter of the tolerance of gaps. Pairs for which `is_left_out` returns true make no
/// contact. `friction` is null if the contacts have no friction; otherwise its setting has the
/// coefficient.
///
/// If the tolerances are not reached, StepContacts::is_solved is false. Throws what `mobility`
/// throws, and Error(kNotConverged) if two plates turn so far that they overlap at a place that was
/// no contact of theirs.
StepContacts solve_contacts(const State& state, const Fluid& fluid, const Links& links,
                            std::span<const PlanePosition> obstacles,
                            const std::function<bool(const Pair&)>& is_left_out,
                            const Mobility& mobility, const ContactConditions& conditions,
                            ThreadPool& pool, const FrictionOfStep* friction = nullptr);

/// What friction needs of a step besides ContactConditions.
struct FrictionOfStep {
  const Setting& setting;            ///< in the plane, with ContactLaws::friction and a fluid
  std::span<const Plane> obstacles;  ///< obstacles_of(setting)
  const PairMemories& memories;      ///< State::memories, with the friction of the step before
  double begin = 0;                  ///< time at which the step begins [T]
  double end = 0;                    ///< time at which it ends [T], > begin
};

/// Where friction acts on the particles of a contact.
struct FrictionPlace {
  /// Distances, along the normal, of the contact from the centres of the first and the second
  /// particle [L].
  std::array<double, 2> arms{};
  Vector on_obstacle{};  ///< the point of the obstacle at the contact [L]
};

/// The friction of a contact, with all members but ContactFrictionInFluid::contact, w and slides,
/// which keep their defaults. `contact` must have the distance D of the surfaces as its gap. The
/// particles are at their places at the beginning of the step. The first guess of the impulse is
/// the friction in the memory of the pair.
ContactFrictionInFluid friction_of_contact(const FrictionOfStep& step, const Particles& particles,
                                           const Pair& pair, const Contact<2>& contact,
                                           const FrictionPlace& place,
                                           const ContactConditions& conditions);

/// Finds the impulses of contacts as solve_listed() does, but with the friction of `step.frictions`
/// and its coefficient `mu_s` >= 0 [1]. If Coulomb's law is not reached within the tolerances,
/// `step.is_solved` is false and `step.has_given_loads` is true. The friction is then bounded by
/// mu_s times the loads of an earlier iteration or of a solution without friction, docs/physics.md
/// (5.17), and gaps and films are exact for this friction. Throws what the mobility throws.
void solve_with_friction(StepContacts& step, double mu_s, const Mobility& mobility,
                         const ContactConditions& conditions);

/// The power [M L^2/T^3] that friction turns into heat in the step; 0 without friction, and >= 0 up
/// to the tolerances. It is minus the sum over all contacts of the force of friction times the
/// velocity of slip, for the `velocities` with which the particles move in the step.
double heat_of_friction(const StepContacts& step, std::span<const double> velocities,
                        const ContactConditions& conditions);

/// Adds the residuals [L] of Coulomb's law to `residuals`, for the `velocities` that the particles
/// have with the contact forces. The residual of a contact that sticks is its slip. That of a
/// contact that slides is the error of its friction times ContactFrictionInFluid::w.
void take_residuals_of_friction(const StepContacts& step, double mu_s,
                                std::span<const double> velocities,
                                const ContactConditions& conditions, StepResiduals& residuals);

}  // namespace viscontact::particles
