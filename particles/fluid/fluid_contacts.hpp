// The contacts of a step in a fluid, docs/physics.md (6.4): which pairs take part, and impulses
// that keep their gaps open, as forces on particles whose velocities depend linearly on forces; and
// their Coulomb friction (6.14): the tangents along which solids slide, and impulses of friction. A
// gap of a contact is D - D_c here, with the threshold gap D_c. Lengths, masses and times are in
// the units of the case; masses and impulses of discs are per length. fluid_simulation.cpp,
// fluid_acceptance.cpp and the blows use it. Errors are those of the mobility. A change must keep
// that the film carries no friction.
#pragma once

#include <algorithm>
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

/// G v: the velocity at which the gap opens [L/T], for the velocities of all particles.
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
/// not a number.
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

/// Adds G^T force to the forces of all particles [M L/T^2]. A positive force pushes both apart.
inline void add_contact_force(const Contact<2>& contact, double force, std::span<double> forces,
                              const MotionLayout& layout) {
  for (std::size_t d = 0; d < layout.directions(); ++d) {
    forces[layout.at(contact.second, d)] += contact.normal[d] * force;
    if (contact.first >= 0) forces[layout.at(contact.first, d)] -= contact.normal[d] * force;
  }
  if (contact.levers[1] != 0) forces[layout.at(contact.second, 2)] += contact.levers[1] * force;
  if (contact.levers[0] != 0) forces[layout.at(contact.first, 2)] += contact.levers[0] * force;
}

/// Velocities [L/T, 1/T] of all particles that forces and torques [M L/T^2, M L^2/T^2] add to those
/// without contact; linear, and positive definite on the forces of contacts, along which it is
/// symmetric but in a fluid with inertia.
using Mobility = std::function<std::vector<double>(std::span<const double> forces)>;

/// The step without contact, and how exact its contacts must be.
struct ContactConditions {
  std::span<const double> free_velocities;  ///< of all particles without contact [L/T, 1/T]
  double h = 0;                             ///< length of the step [T], > 0
  MotionLayout layout;                      ///< of all velocities and forces
  SolverSettings solver;                    ///< tolerances, and the largest number of iterations
  double mean_radius = 0;                   ///< [L], > 0
  /// Relative error of velocities, and of the mobility, which is otherwise linear; >= 0. It limits
  /// how small residuals can be.
  double velocity_error = 0;
  /// The length of the step in which forces change the momentum, over h; 1 but in a fluid with
  /// inertia. The impulse of a force lambda is h lambda times this share.
  double share_of_impulse = 1;
  /// Change of the velocity of a gap, or of a slip, by a unit force of its contact [T/M] up to
  /// which the gap or slip counts as one that hinges hold, and takes no part; 0: none is held.
  double least_w = 0;
  double least_reach = 0;  ///< pairs are listed up to this gap at least [L]
  /// Whether the mobility is symmetric. Moving fluid carries what a contact does to the contacts
  /// behind it, so that the mobility of a fluid with inertia is not.
  bool is_symmetric = true;
  /// Whether impulses that are a solution within the tolerances already stay as they are. Otherwise
  /// the solution is made as exact as it can be.
  bool keeps_solution = false;
};

/// What rounding errors of positions, and errors of velocities, change in a gap after the step [L].
inline double rounding_error_of_gaps(const ContactConditions& conditions) {
  constexpr double kOfPositions = 1e-14;  // in mean radii
  return kOfPositions * conditions.mean_radius +
         conditions.velocity_error * conditions.h *
             fastest(conditions.free_velocities, conditions.layout);
}

/// Contact::w of a contact whose gap a hinge holds, as no force of the contact can change it. It
/// takes no part, and its gap is as exact as the hinge.
inline constexpr double kHeld = -1;

/// Sets Contact::allowed. Contacts with w = 0 take no part, and only the tolerance of the gaps
/// holds for them.
///
/// Returns the impulses at work in each contact [M L/T]: of its two particles the smaller one of
/// the largest impulse on each. The impulses on a particle are those of its contacts, and those
/// that would stop the motion without contact that changes a gap.
std::vector<double> set_allowed(std::span<Contact<2>> contacts,
                                const ContactConditions& conditions);

/// Measures the residuals of the impulses of contacts in the velocities that the particles have
/// with them; gaps are D - D_c + h G v. Sets Contact::allowed.
StepResiduals measure_residuals(std::span<Contact<2>> contacts, std::span<const double> velocities,
                                const ContactConditions& conditions);

/// Largest number of contacts for which the matrix W is computed, by one product with the mobility
/// for each contact. Above it, products take place within conjugate gradients, if W is symmetric.
inline constexpr std::size_t kMostDenseContacts = 24;

/// Finds the impulses p of contacts with p >= gamma, D + h G v >= 0 where p = gamma, and
/// D + h G v = 0 where p > gamma, with v = free velocities + mobility(G^T p/h). This is the dual
/// problem (5.4) of docs/physics.md with W = G mobility G^T in place of h G M^-1 G^T.
///
/// Few contacts: W is assembled, and Newton's method on the set of contacts with p > gamma solves,
/// or MPRGP where Newton's method cycles. Many contacts: MPRGP with products by the mobility.
class ContactProblem {
 public:
  /// `mobility` and the velocities of `conditions` must outlive the object.
  ContactProblem(const ContactConditions& conditions, const Mobility& mobility)
      : conditions_(conditions),
        mobility_(mobility),
        velocities_(conditions.free_velocities.begin(), conditions.free_velocities.end()) {}

  /// Adds a contact, whose `impulse` is a first guess. Contacts of which the mobility moves neither
  /// particle must not be added.
  void add(const Contact<2>& contact) { contacts_.push_back(contact); }

  /// Finds the impulses and the `w` of all contacts. Further contacts may be added after it, and
  /// their solution begins at the impulses found. A rough solution serves only to see which other
  /// contacts take part, and saves products where there are many. Returns whether the residuals of
  /// all contacts reached the tolerances (of a rough solution, the wide ones). May throw what the
  /// mobility throws.
  [[nodiscard]] bool solve(bool is_rough);

  /// All contacts, in the order in which they were added, with the impulses of the last solve().
  const std::vector<Contact<2>>& contacts() const { return contacts_; }
  /// Velocities of the particles with the impulses found [L/T, 1/T].
  const std::vector<double>& velocities() const { return velocities_; }
  /// Sums of the contact forces p/h on each particle [M L/T^2].
  std::vector<double> loads() const;
  /// Number of products with the mobility and of steps without such a product.
  int iterations() const { return iterations_; }
  /// True if the last solution was rough.
  bool is_rough() const { return is_rough_; }

 private:
  /// Both improve the impulses until the residuals are those allowed.
  void solve_dense();
  void solve_by_products();
  /// Sets the velocities by the responses of all contacts to their impulses.
  void take_velocities();

  ContactConditions conditions_;
  const Mobility& mobility_;
  std::vector<Contact<2>> contacts_;
  std::vector<std::vector<double>> responses_;  // to a unit force of each contact [T/M]
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
  /// Slip of the step if no particle moved [L]: the displacement of the image of the second
  /// particle relative to that particle, or minus that of the obstacle.
  double displacement = 0;
  /// gamma - gamma_min >= 0: the impulse that the film takes up before the solids touch [M L/T].
  double capacity = 0;
  /// Impulse of friction on the second particle along the tangent [M L/T]: a guess, then the
  /// solution.
  double impulse = 0;
  /// Change of the slip per impulse of friction [T/M]; 0 if none is known, or if a hinge holds the
  /// place at which the friction acts.
  double w = 0;
  /// Where the solution slides, the sign of its friction; where it sticks, or the solids do not
  /// touch, 0.
  int slides = 0;

  /// Velocity of the surface of the second particle relative to that of the first along the tangent
  /// [L/T], for the velocities of all particles. Obstacles are at rest, and images do not move
  /// relative to their particles.
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
  /// Adds a force of friction, and its torques, to the forces of all particles [M L/T^2].
  void add_force(const Contact<2>& of, double force, std::span<double> forces,
                 const MotionLayout& layout) const {
    for (std::size_t d = 0; d < 2; ++d) {
      forces[layout.at(of.second, d)] += tangent[d] * force;
      if (of.first >= 0) forces[layout.at(of.first, d)] -= tangent[d] * force;
    }
    forces[layout.at(of.second, 2)] += levers[1] * force;
    if (of.first >= 0) forces[layout.at(of.first, 2)] += levers[0] * force;
  }
  /// Part of the normal impulse that the solids carry, p_s of (5.7) [M L/T].
  double carried(const Contact<2>& of) const { return FrictionLaw::carried(of.impulse, capacity); }
};

struct FrictionOfStep;

/// The contacts of a step, solved.
struct StepContacts {
  std::vector<Pair> pairs,  ///< of particles in reach of each other in this step, with their memory
      walls;                ///< the same of particles and obstacles
  /// Of all `pairs`, then of all `walls`, then of the stops of hinges, which remember nothing.
  /// Contacts that take no part have the impulse 0 and w = 0.
  std::vector<Contact<2>> contacts;
  /// Of the contacts whose solids may touch, that is with a finite capacity, in the order of
  /// `contacts`; empty without friction.
  std::vector<ContactFrictionInFluid> frictions;
  std::vector<double> loads;       ///< sums of contact forces on each particle [M L/T^2]
  std::vector<double> velocities;  ///< with the contact forces [L/T, 1/T]
  int iterations = 0;     ///< products with the mobility, and iterations of a dense problem
  bool is_solved = true;  ///< ContactProblem::solve() reached the tolerances
  double reach = 0;       ///< all pairs with a gap below it are listed [L]
};

/// Solves for contacts in rounds, in which those join whose gaps the others close. Takes
/// `step.contacts` with their bounds and guesses; sets their impulses and w, and the loads,
/// velocities and `is_solved` of the step. Adds to its iterations.
void solve_listed(StepContacts& step, const Mobility& mobility,
                  const ContactConditions& conditions);

/// Up to which gap pairs may meet in the step if particles have these velocities [L].
double reach_of(const State& state, const Fluid& fluid, std::span<const double> velocities,
                const ContactConditions& conditions);

/// The radii of both surfaces of a pair at its contact: radii_of() with the round ends of plates.
PairRadii radii_in_fluid(const Fluid& fluid, const Pair& pair, const Particles& particles,
                         std::span<const Plane> obstacles);

/// The stops of hinges as contacts: with the radius of the particle that a hinge holds as its
/// lever, the gap of a stop is a length, as those of other contacts.
std::vector<Contact<2>> contacts_of_stops(const Links& links, const Particles& particles);

/// Adds the torques of the stops, of which `contacts` ends with the contacts, to
/// State::link_forces. `h` is the length of the step [T].
void add_torques_of_stops(const Links& links, const Particles& particles,
                          std::span<const Contact<2>> contacts, double h,
                          std::span<double> link_forces);

/// Finds the impulses of all contacts, such that no gap closes that was not among the contacts
/// either. `state` is that before the step, `obstacles` are positions at the end of the step.
/// Plates that turn by finite angles keep their gaps, but for a quarter of the tolerance. Pairs for
/// which `is_left_out` is true are no contacts, because no contact force changes their distance.
/// `friction` is null if there is none.
/// Throws what `mobility` throws, and Error(kNotConverged) if two plates turn so far that they
/// overlap at a place that was no contact of theirs.
StepContacts solve_contacts(const State& state, const Fluid& fluid, const Links& links,
                            std::span<const PlanePosition> obstacles,
                            const std::function<bool(const Pair&)>& is_left_out,
                            const Mobility& mobility, const ContactConditions& conditions,
                            ThreadPool& pool, const FrictionOfStep* friction = nullptr);

/// What friction needs of a step besides ContactConditions.
struct FrictionOfStep {
  const Setting& setting;            ///< with ContactLaws::friction and a fluid, in the plane
  std::span<const Plane> obstacles;  ///< obstacles_of(setting)
  const PairMemories& memories;      ///< of the pairs, whose friction is the first guess
  double begin = 0;                  ///< time at which the step begins [T]
  double end = 0;                    ///< time at which it ends [T]
};

/// Where friction acts on the particles of a contact.
struct FrictionPlace {
  /// Distances, along the normal, of the contact from the centres of the first and the second
  /// particle [L].
  std::array<double, 2> arms{};
  Vector on_obstacle{};  ///< the point of the obstacle at the contact [L]
};

/// The friction of a contact, but for its number. `contact` has the gap between the surfaces, and
/// the particles are where the step begins. The first guess of the impulse is that in the memory of
/// the pair.
ContactFrictionInFluid friction_of_contact(const FrictionOfStep& step, const Particles& particles,
                                           const Pair& pair, const Contact<2>& contact,
                                           const FrictionPlace& place,
                                           const ContactConditions& conditions);

/// Solves for contacts as solve_listed(), with the friction of `step.frictions`, of which `mu_s` >=
/// 0 is the coefficient, without dimension. If Coulomb's law (5.7) is not reached within the
/// tolerances, `step.is_solved` is false, and the friction has the bounds (5.17) of given loads;
/// gaps and films are exact for the friction that was found. Throws what the mobility throws.
void solve_with_friction(StepContacts& step, double mu_s, const Mobility& mobility,
                         const ContactConditions& conditions);

/// The heat that friction makes in a unit of time [M L^2/T^3], >= 0 but for the tolerances: minus
/// the sum of the forces of friction times the slips of the step, for the velocities with which the
/// particles move.
double heat_of_friction(const StepContacts& step, std::span<const double> velocities,
                        const ContactConditions& conditions);

/// Takes the residuals of Coulomb's law into `residuals`, for the velocities that the particles
/// have with the contact forces [L/T, 1/T]. The residual of a contact is its slip where it sticks,
/// and the error of its friction times its tangential mobility where it slides [L].
void take_residuals_of_friction(const StepContacts& step, double mu_s,
                                std::span<const double> velocities,
                                const ContactConditions& conditions, StepResiduals& residuals);

}  // namespace viscontact::particles
