// The contacts of a step in a fluid: which pairs make contact, the impulses that keep their gaps
// open (docs/physics.md (6.4)), and their Coulomb friction (6.14). The velocities of particles
// depend linearly on forces. Contact is made at the threshold gap D_c (Fluid::threshold_gap): gaps
// of contacts are D - D_c here, with the distance D of the surfaces. gamma <= 0 is minus the
// impulse that the film of a contact has absorbed, and gamma_min the gamma at which the solids
// touch. Lengths, masses and times are in any consistent units; masses and impulses of discs are
// per length. Arrays of velocities, forces and loads have MotionLayout::components numbers for each
// particle [L/T, 1/T; M L/T^2, M L^2/T^2]. The other sources of this folder use it. Sizes and
// ranges of arguments are not checked; functions throw only what they say. A change must keep that
// the film carries no friction.
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

/// The velocity at which the gap opens [L/T], for the velocities v of all particles: G v with the
/// row G of the contact.
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

/// Linearised gap D - D_c + h G v at the end of a step of length h [L].
inline double gap_after(const Contact<2>& contact, const double* velocities, double h,
                        const MotionLayout& layout) {
  return contact.gap + h * opening(contact, velocities, layout);
}

/// The largest speed of a particle [L/T], without its turning, which changes no gap; NaN if one is
/// not a number, 0 without particles.
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

/// Adds a contact force [M L/T^2], > 0 if it pushes, to the forces and torques on all particles.
inline void add_contact_force(const Contact<2>& contact, double force, std::span<double> forces,
                              const MotionLayout& layout) {
  for (std::size_t d = 0; d < layout.directions(); ++d) {
    forces[layout.at(contact.second, d)] += contact.normal[d] * force;
    if (contact.first >= 0) forces[layout.at(contact.first, d)] -= contact.normal[d] * force;
  }
  if (contact.levers[1] != 0) forces[layout.at(contact.second, 2)] += contact.levers[1] * force;
  if (contact.levers[0] != 0) forces[layout.at(contact.first, 2)] += contact.levers[0] * force;
}

/// The velocities [L/T, 1/T] that forces and torques [M L/T^2, M L^2/T^2] add to those of all
/// particles. It is linear and positive semidefinite, and symmetric except in a fluid with inertia.
/// If it asks a fluid solver, it throws the errors of FluidSolver, also Error(kInterrupted) if a
/// stop is requested.
using Mobility = std::function<std::vector<double>(std::span<const double> forces)>;

/// The step without contact, and how exact its contacts must be.
struct ContactConditions {
  std::span<const double> free_velocities;  ///< of all particles without contact [L/T, 1/T]
  double h = 0;                             ///< length of the step [T], > 0
  MotionLayout layout;                      ///< of all velocities and forces
  SolverSettings solver;                    ///< tolerances, and the largest number of iterations
  double mean_radius = 0;                   ///< [L], > 0
  /// Relative error >= 0 of velocities and of the mobility. Residuals cannot be smaller than what
  /// it causes.
  double velocity_error = 0;
  /// Impulse of a force in the step over h times the force: 1, except in a fluid with inertia,
  /// where it is the length of the step before over h (BlowStep::kick) [1], > 0.
  double share_of_impulse = 1;
  /// Hinges hold a gap or a slip if a unit force of its contact changes its velocity by no more
  /// than this [T/M], >= 0. The gap or slip is then left out of the problem. 0: hinges hold none.
  double least_w = 0;
  double least_reach = 0;  ///< pairs are listed up to this gap at least [L], >= 0
  /// Whether the mobility is symmetric. In a fluid with inertia it is not symmetric, because moving
  /// fluid carries the effect of a contact to the contacts downstream.
  bool is_symmetric = true;
  /// Whether impulses that are a solution within the tolerances already stay as they are. If not,
  /// they are improved as far as the errors of the mobility allow.
  bool keeps_solution = false;
};

/// Error [L], > 0, of a gap after the step by rounding errors of positions and by errors of
/// velocities; NaN if a velocity without contact is.
inline double rounding_error_of_gaps(const ContactConditions& conditions) {
  constexpr double kOfPositions = 1e-14;  // in mean radii: some 50 units in the last place
  return kOfPositions * conditions.mean_radius +
         conditions.velocity_error * conditions.h *
             fastest(conditions.free_velocities, conditions.layout);
}

/// Contact::w of a contact that is left out of the problem, because hinges hold its gap.
inline constexpr double kHeld = -1;

/// Sets Contact::allowed, the allowed residual [L], from the tolerances of gaps and impulses. For
/// contacts with w <= 0, which are left out of the problem, it is the tolerance of gaps alone.
///
/// Returns the impulses at work in each contact [M L/T]. For a particle this is the largest of the
/// impulses of its contacts and of those that alone would keep their gaps from changing; for a
/// contact it is the smaller value of its two particles. One number for each contact, >= 0.
std::vector<double> set_allowed(std::span<Contact<2>> contacts,
                                const ContactConditions& conditions);

/// Measures the residuals of contacts, for their impulses and the velocities that the particles
/// have with these. Sets Contact::allowed. StepResiduals::impulse_errors has one number for each
/// contact, 0 if the contact is left out of the problem; StepResiduals::converged says whether all
/// residuals are allowed.
StepResiduals measure_residuals(std::span<Contact<2>> contacts, std::span<const double> velocities,
                                const ContactConditions& conditions);

/// Largest number of contacts for which the matrix W (below) is computed, by one product with the
/// mobility for each contact. Above it, if W is symmetric, conjugate gradients compute products
/// with W. It changes the time, and results by rounding.
inline constexpr std::size_t kMostDenseContacts = 24;

/// Finds the impulses p of contacts with gaps D and rows G such that p >= gamma, D + h G v >= 0 if
/// p = gamma, and D + h G v = 0 if p > gamma, with v = free velocities + mobility(G^T p/h). This is
/// the dual problem (5.4) of docs/physics.md with W = G mobility G^T in place of h G M^-1 G^T.
///
/// If contacts are few, W is assembled, and Newton's method on the set of contacts with p > gamma
/// solves the problem, or, if it cycles, MPRGP: conjugate gradients with gradient projection. If
/// they are many, MPRGP solves it with one call of the mobility for each product with W.
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
  /// next solution begins with the impulses found. A solution that `is_rough` has wider tolerances
  /// and saves products: it serves to see which other contacts must be added. Returns whether the
  /// residuals of all contacts are within the tolerances; false if they are not after
  /// SolverSettings::max_iterations or a fixed number of rounds. True if there are no contacts.
  /// Throws what the mobility throws.
  [[nodiscard]] bool solve(bool is_rough);

  /// All contacts, in the order in which they were added, with the impulses of the last solve().
  const std::vector<Contact<2>>& contacts() const { return contacts_; }
  /// Velocities of the particles with the impulses found [L/T, 1/T]; before solve() those without
  /// contact.
  const std::vector<double>& velocities() const { return velocities_; }
  /// Sums of the contact forces p/h, and of their torques, on each particle [M L/T^2, M L^2/T^2].
  std::vector<double> loads() const;
  /// Number of products with the mobility and iterations with the assembled W in all solve().
  int iterations() const { return iterations_; }
  /// True if the last solution was rough.
  bool is_rough() const { return is_rough_; }

 private:
  // The next two functions improve the impulses until the residuals are allowed.
  void solve_dense();
  void solve_by_products();
  /// Sets the velocities by the responses of all contacts to their impulses.
  void take_velocities();

  ContactConditions conditions_;
  const Mobility& mobility_;
  std::vector<Contact<2>> contacts_;
  std::vector<std::vector<double>> responses_;  // velocities by a unit force of each contact
  std::vector<double> velocities_;
  int iterations_ = 0;
  bool is_rough_ = false;
};

/// The friction of a contact whose solids may touch, docs/physics.md (6.14).
struct ContactFrictionInFluid {
  std::size_t contact = 0;  ///< number in StepContacts::contacts
  /// Unit vector along the surfaces: the normal, turned by 90 degrees to the left.
  std::array<double, 2> tangent{};
  /// Change of the slip per turn of the first and of the second particle, counter-clockwise [L].
  std::array<double, 2> levers{};
  /// Slip of the step if no particle moved [L]: the displacement along the tangent of the periodic
  /// image that touches, relative to the second particle, or minus that of the obstacle.
  double displacement = 0;
  /// gamma - gamma_min >= 0: the impulse that the film takes up before the solids touch [M L/T];
  /// infinite if they never touch.
  double capacity = 0;
  /// Impulse of friction on the second particle along the tangent [M L/T]: a guess, then the
  /// solution.
  double impulse = 0;
  /// Change of the slip per impulse of friction [T/M], >= 0; 0 if it is not known yet, or if a
  /// hinge holds the place at which the friction acts.
  double w = 0;
  /// If the solids slide in the solution, the sign of `impulse`, 1 or -1; if they stick, or do not
  /// touch, 0.
  int slides = 0;

  /// Velocity of the surface of the second particle relative to that of the first along the tangent
  /// [L/T], for the velocities of all particles, without the part that `displacement` contains.
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
  /// The slip of a step of length h: displacement of the surface of the second particle relative to
  /// that of the first or of the obstacle, along the tangent [L].
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
  std::vector<Pair> pairs,  ///< of particles in reach of each other in this step, with their memory
      walls;                ///< the same of particles and obstacles
  /// The contacts of all `pairs`, then of all `walls`, then of the stops of hinges, which have no
  /// film. Contacts that take no part have the impulse 0 and w = 0 or kHeld.
  std::vector<Contact<2>> contacts;
  /// The friction of the contacts whose solids may touch, that is with a finite capacity, in the
  /// order of `contacts`; empty without friction.
  std::vector<ContactFrictionInFluid> frictions;
  std::vector<double> loads;       ///< forces and torques of contacts and friction on particles
  std::vector<double> velocities;  ///< with these forces [L/T, 1/T]
  int iterations = 0;     ///< products with the mobility, and iterations of a dense problem, >= 0
  bool is_solved = true;  ///< ContactProblem::solve() reached the tolerances
  bool has_given_loads = false;  ///< given loads bound the friction (solve_with_friction())
  double reach = 0;  ///< all pairs with a distance of surfaces below it are listed [L], > 0
};

/// Solves for `step.contacts`, whose impulses are first guesses, in rounds. After each round those
/// contacts are added whose gaps the solution has closed. Sets the impulses and w of the contacts,
/// and the loads, velocities and `is_solved` of the step, which is false if residuals are larger
/// than allowed; adds to its iterations. Throws what the mobility throws.
void solve_listed(StepContacts& step, const Mobility& mobility,
                  const ContactConditions& conditions);

/// The largest distance [L] of surfaces that can come to contact in a step with these velocities.
double reach_of(const State& state, const Fluid& fluid, std::span<const double> velocities,
                const ContactConditions& conditions);

/// The radii [L] of both surfaces of a pair at its contact: radii_of() with the round ends of
/// plates. `obstacles` are obstacles_of(setting).
PairRadii radii_in_fluid(const Fluid& fluid, const Pair& pair, const Particles& particles,
                         std::span<const Plane> obstacles);

/// The stops of hinges as contacts. The gap of a stop is the angle that is left to it times the
/// radius of the particle that the hinge holds [L]. One contact for each stop of each hinge; empty
/// without stops.
std::vector<Contact<2>> contacts_of_stops(const Links& links, const Particles& particles);

/// Adds the torques [M L^2/T^2] of the stops of hinges to `link_forces`, which has the order of
/// State::link_forces. The last of the `contacts` are those of contacts_of_stops() after a step of
/// length `h` [T].
void add_torques_of_stops(const Links& links, const Particles& particles,
                          std::span<const Contact<2>> contacts, double h,
                          std::span<double> link_forces);

/// Lists the pairs that may come to contact in the step and finds the impulses of their contacts;
/// the list is extended until no other gap can close. `state` is that before the step, `obstacles`
/// are at their places at the end of the step. The finite rotation of plates is taken into account
/// up to a quarter of the tolerance of gaps. Pairs for which `is_left_out` is true are no contacts.
/// `friction` is null if there is none; with it the coefficient of its setting is used.
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
  const Setting& setting;            ///< with ContactLaws::friction and a fluid, in the plane
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

/// The friction of a contact, all but ContactFrictionInFluid::contact and w. `contact` has the gap
/// D between the surfaces, and the particles are at their places at the beginning of the step. The
/// first guess of the impulse is the friction in the memory of the pair.
ContactFrictionInFluid friction_of_contact(const FrictionOfStep& step, const Particles& particles,
                                           const Pair& pair, const Contact<2>& contact,
                                           const FrictionPlace& place,
                                           const ContactConditions& conditions);

/// Solves for contacts as solve_listed(), with the friction of `step.frictions` and its coefficient
/// `mu_s` >= 0 [1]. If Coulomb's law is not reached within the tolerances, `step.is_solved` is
/// false, `step.has_given_loads` is true, and the friction is bounded by mu_s times the loads of an
/// earlier iteration or of a solution without friction, docs/physics.md (5.17); gaps and films are
/// exact for it. Throws what the mobility throws.
void solve_with_friction(StepContacts& step, double mu_s, const Mobility& mobility,
                         const ContactConditions& conditions);

/// The power [M L^2/T^3] that friction turns into heat in the step, >= 0 up to the tolerances:
/// minus the sum over all contacts of force times velocity of slip, for the velocities with which
/// the particles move; 0 without friction.
double heat_of_friction(const StepContacts& step, std::span<const double> velocities,
                        const ContactConditions& conditions);

/// Adds the residuals [L] of Coulomb's law to `residuals`, for the velocities that the particles
/// have with the contact forces [L/T, 1/T]. The residual of a contact that sticks is its slip, that
/// of one that slides the error of its friction times ContactFrictionInFluid::w.
void take_residuals_of_friction(const StepContacts& step, double mu_s,
                                std::span<const double> velocities,
                                const ContactConditions& conditions, StepResiduals& residuals);

}  // namespace viscontact::particles
