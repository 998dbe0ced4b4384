// The constraints of a time step as one ConstraintProblem: contacts with friction, rigid bodies and
// links. Numbers such as (5.9) are equations of docs/physics.md.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "viscontact/constraint_rows/contact_rows.hpp"
#include "viscontact/constraint_rows/link_rows.hpp"
#include "viscontact/constraint_rows/solver_names.hpp"
#include "viscontact/contact_dynamics/constraints/contact_system.hpp"
#include "viscontact/contact_solver/constraint_solver.hpp"
#include "viscontact/contact_solver/problem/constraint_problem.hpp"
#include "viscontact/contact_solver/refinement.hpp"
#include "viscontact/particles/contact/contact_laws.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/state/particles.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"

namespace viscontact::particles {

/// A time step, and what its constraints depend on besides contacts. Before solve() the arrays that
/// are not const hold the motion without contacts and links, after it that with them. h = end -
/// begin > 0 [T], w are angular velocities [1/T] and I moments of inertia [M L^2].
struct ConstraintStep {
  const ContactLaws& laws;
  std::span<const Plane> obstacles;
  double begin = 0,
         end = 0;  ///< both [T]
  bool is_first = false;
  double impulse_time = 0;  ///< time for which forces act on the velocities in the step [T], > 0
  std::span<double> turns;  ///< h w of all particles [rad], 1 (discs) or 3 numbers for each
  /// h/I of all particles [T/(M L^2)], > 0, or 0 if the motion is given. This and the arrays of
  /// displacements, mobilities and turns also have entries of the planes under a load, after those
  /// of the particles.
  std::span<const double> turn_mobilities;
  std::span<BodyStep> bodies;
  const Links* links = nullptr;  ///< must not be null
  /// Forces and torques of all links [M L/T^2, M L^2/T^2], in the order of State::link_forces: a
  /// first guess, then the solution.
  std::span<double> link_forces;
  /// Works of the impulses across all arms, (5.21), in the order of Links::arms [M L^2/T^2]:
  /// output.
  std::span<double> works_across;
};

struct ImpulseError {
  /// Estimate of the error [M L/T], >= 0, by a Refinement; negative if there was none.
  double estimate = -1;
  double rounding = 0;  ///< error that rounding errors of gaps and lengths cause [M L/T], >= 0
};

template <int D>
Motion<D> row_of(const LinkPart& part) {
  if (!part.is_turn) return displacement_row<D>(part.direction, part.arm);
  Motion<D> row{};
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  for (std::size_t i = 0; i < r; ++i) row[d + i] = part.direction[3 - r + i];
  return row;
}

template <int D>
class IslandLadder;

template <int D>
class ConstraintSystem {
 public:
  /// All arguments must outlive this object. `displacements` are those without contacts and links
  /// [L], D for each particle; solve() changes them. `mobilities` has h/m [T/M] for each particle
  /// of mass m, or 0 if its motion is given.
  ConstraintSystem(const ConstraintStep& step, const Particles& particles,
                   std::span<double> displacements, std::span<const double> mobilities);

  /// Makes the particles of each link take part and connects them, before a contact is added.
  void join_linked(ContactSystem<D>& system) const;

  /// True if an arm keeps the particles of `pair` from overlapping, at the end of the step, by more
  /// than 1e-6 of the sum of their radii. (Cases may leave such an overlap, because they give
  /// lengths with rounding errors.) The contact of such a pair must not be added: it would repeat
  /// the equation of the arm to first order in the arm's turn and contradict it to second order,
  /// and its load would not be unique.
  bool is_held_apart(const Pair& pair) const;

  /// Adds the contact of `pair`, in the order of the ContactSystem. `memory` has its friction and
  /// load in the step before.
  void add(const Contact<D>& contact, const Pair& pair, const PairMemory& memory);

  /// The equations of all links, and then those of the stops of hinges, which bound their angles.
  const std::vector<LinkEquations>& links() const { return links_; }
  /// How solutions begin. The caller sets all public members before solve().
  ConstraintStart start = ConstraintStart::kSweeps;
  /// True if the caller takes the step anew, in shorter parts, if needs_shorter_step(). Islands do
  /// not give up then.
  bool can_be_divided = false;
  /// Allowed residuals of links() [L], > 0; those of angles times the mean radius.
  std::vector<double> links_allowed;
  /// Errors that are asked for of the impulses of all contacts, in the order of add(), and then of
  /// all links() [M L/T], >= 0; of angles as in links_allowed.
  std::vector<double> allowed_errors;
  /// Rounding errors of the gaps and values of the same contacts and links [L].
  std::vector<double> rounding;
  /// Allowed residuals of the slips of all contacts, their tangential displacements [L], > 0.
  std::vector<double> slips_allowed;

  /// Solves each island of `system`, a set of particles that contacts and links connect, by itself.
  /// An island that was solved as accurately before, and got no contact since, stays as it is. Sets
  /// the impulses of contacts, displacements and turns of particles, motions of rigid bodies and
  /// forces of links. If `is_rough`, all residuals may be up to `roughly_allowed` > 0 [L].
  ///
  /// Returns the iterations, in all calls together, of the island with the most, at most about
  /// `max_iterations`, the stages of this call, and the largest residual of the last problems plus
  /// the largest correction that would follow, both over what is allowed [1]. If it is at most 1,
  /// the problems are solved, with given loads where has_given_up() says so.
  ///
  /// IslandLadder lists the strategies. If the motion of the links without contacts leaves all
  /// contacts open, it is the solution. (Equations that are linear about the beginning of the step
  /// would stop a particle that a hinge or arm takes past an obstacle.) Gaps are at first taken
  /// along the normals at the beginning of the step. An island that gives up bounds its friction by
  /// given loads in all later calls. residual() remains that of Coulomb's law, but is about the
  /// given loads with the convex relaxation (5.9).
  SolverResult solve(ContactSystem<D>& system, bool is_rough, double roughly_allowed,
                     int max_iterations);

  /// True if the last solve() did not solve an island with friction, and the step can_be_divided.
  bool needs_shorter_step() const { return needs_shorter_step_; }

  /// True if given loads bound the friction of an island, because solve() could not solve its
  /// problem with the friction law that was asked for.
  bool has_given_up() const { return has_given_up_; }

  /// Writes the friction of contact `c`, in the order of add(), the impulse that its solids carry,
  /// and that of its film across the normal to `memory` [M L/T]. This and the next functions are
  /// about the last solve().
  void remember(std::size_t c, PairMemory& memory) const {
    assert(c < contact_states_.size());
    memory.set_friction(contact_states_[c].friction);
    memory[Remembered::kSolidLoad] = contact_states_[c].solid_load;
    memory.set_across(contact_states_[c].across);
  }
  const Vector& friction(std::size_t c) const { return contact_states_[c].friction; }  ///< [M L/T]
  const BlockResidual& residual(std::size_t c) const { return contact_states_[c].residual; }
  /// Residual of link `l` of links() [L]; that of angles is multiplied by the mean radius.
  double link_residual(std::size_t l) const { return link_residuals_[l]; }
  const ImpulseError& impulse_error(std::size_t c) const { return contact_states_[c].error; }
  /// Error of the impulse of link `l` of links(); moments of angles are divided by the mean radius.
  const ImpulseError& link_impulse_error(std::size_t l) const { return link_errors_[l]; }
  /// The impulse of row `k` of link `l` of links() [M L/T], or [M L^2/T] if it is an angle: that of
  /// the last solution, or the first guess.
  double link_impulse(std::size_t l, std::size_t k) const {
    assert(l < links_.size() && k < links_[l].rows.size());
    return times_.impulse_time * link_forces_[links_[l].first_force + k];
  }
  /// Adds the impulses of links across their directions on particles whose motion is given.
  void add_loads_across(std::vector<GivenParticleLoad>& on_given) const {
    for (const auto& of_link : across_on_given_)
      on_given.insert(on_given.end(), of_link.begin(), of_link.end());
  }
  /// The largest kappa, (5.21), of the links that push, and of the pressures that keep areas. What
  /// they push moves away by a factor of about exp(kappa^(1/2)) in the step, which kappa > 1 does
  /// not resolve.
  double buckling() const;
  /// For all contacts and then all links the violation [L] by the motion that violates all
  /// constraints least, as particles::least_violations(); those of angles are multiplied by the
  /// mean radius. Unless it is 0 but for rounding errors, the constraints contradict each other:
  /// together the impulses v/w move nothing (Farkas' lemma), and constraints without a part in the
  /// contradiction have 0.
  std::vector<double> least_violations() const;

 private:
  friend class IslandLadder<D>;
  // The block of a row of geometric stiffness.
  struct Tension {
    std::size_t source = 0;   // block of the link or film
    double moved_before = 0;  // step times the rate of the row at its beginning [L, rad]
    double moved_given = 0;   // by particles whose motion is given, in the step [L, rad]
    Vector direction{};       // of the impulse on the second particle; 0 of a turn
    // The directions of the impulses on particles whose motion is given.
    std::vector<std::pair<std::int32_t, Vector>> on_given{};
  };
  struct Island {
    std::vector<std::int32_t> bodies;          // numbers in the ContactSystem
    std::vector<std::size_t> contacts, links;  // in the order of the blocks of the problem
    ConstraintProblem<D> problem;  // empty if the last solve() left the island as it was
    // The last blocks of the problem, after those of contacts and links.
    std::vector<Tension> tensions;
    std::vector<double> shifts;         // last corrections of the blocks of contacts and links [L]
    std::vector<double> shifts_across;  // of the motions, by the last change of their tensions [L]
    // True if redundant loads, and with them the tensions, may differ a little in each solution.
    bool loads_may_drift = false;
    // can_give_up is false if the problem had no solution with given loads either.
    bool has_given_up = false, can_give_up = true;
    bool needs_shorter_step = false;
  };
  struct Progress {
    enum class Solved : unsigned char { kNot, kRoughly, kAccurately } solved = Solved::kNot;
    int iterations = 0;
  };
  struct ContactState {
    ContactTangents<D> tangents;
    Vector friction{};      // impulse of friction [M L/T]
    Vector across{};        // impulse of the film across the normal, on the second particle [M L/T]
    double solid_load = 0;  // part of the impulse that solids carry [M L/T]
    double first_load = 0;  // load with which solutions begin, that of the last rough solution or
                            // of the step before [M L/T]
    double given_load = 0;  // load that bounds the friction after the island has given up [M L/T]
    bool gave_up = false, could_not_give_up = false;  // its island
    BlockResidual residual;                           // in the last solution
    ImpulseError error;                               // in the last solution
    // ConstraintBlock::given_load in the last solution that was not rough [M L/T].
    std::optional<double> last_load;
  };
  void find_islands(ContactSystem<D>& system);
  // True if it was solved as accurately before, no contact was added since, and residuals are
  // allowed, but for those of Coulomb's law if it has given up.
  bool is_solved(const ContactSystem<D>& system, const Island& island, bool is_rough) const;
  bool is_given(std::int32_t particle) const { return !(mobilities_[index_of(particle)] > 0); }
  UnitMotion given_motion(std::int32_t particle) const;
  // The side of an obstacle has no unit (-1).
  ContactSide side_of(std::int32_t entry) const;
  // The film of smooth particles absorbs every impulse, so that they have no friction.
  bool has_friction(const ContactTangents<D>& tangents) const;
  // True if no impulse changes how the surfaces slide on each other: a plane under a load, which
  // moves along its normal only, and a particle whose motion is given.
  bool has_given_slip(const Contact<D>& contact) const;
  // The impulse of friction on such a particle [M L/T], 0 if the surfaces do not slide.
  Vector friction_of_given_slip(const Contact<D>& contact, const ContactState& state) const;
  // Makes a unit of each rigid body, and of each particle without a body, of the island.
  void number_units(const ContactSystem<D>& system, Island& island);
  // Takes the last impulses as the guess. `allowed_slip` is in [L].
  void add_contact(const Contact<D>& contact, std::size_t c, double allowed_slip,
                   ConstraintProblem<D>& problem);
  // Takes the last forces as the guess. `allowed` [L] is divided by the mean radius for angles.
  void add_link(std::size_t l, double allowed, ConstraintProblem<D>& problem);
  // The motion is zero if `unit` is -1.
  UnitMotion motion_of(std::int32_t unit, std::span<const Motion<D>> motions) const;
  void move_particles(const ContactSystem<D>& system, const Island& island,
                      std::span<const Motion<D>> motions);
  // Moves the particles, and shifts the offsets of the rows so that their linear values become
  // those after finite turns. Returns the largest shift over what is allowed [1].
  double correct(ContactSystem<D>& system, Island& island, std::span<const Motion<D>> motions);
  // The rows of the geometric stiffness of block `b`, a contact or link, at its impulses.
  std::vector<LinkRow> tension_rows(const ContactSystem<D>& system, const Island& island,
                                    std::size_t b) const;
  // For each unit kappa of its films, share_of_film(); empty if no film is a spring.
  std::vector<double> film_kappas_of_units(const ContactSystem<D>& system,
                                           const Island& island) const;
  // Takes over the geometric stiffness of the impulses if it changes a motion by more than half of
  // what is allowed, or if `is_always`. Returns the change of `motions` over what is allowed [1].
  double change_tensions(const ContactSystem<D>& system, Island& island,
                         std::span<const Motion<D>> motions, bool is_always);
  void take_impulses_across(const Island& island, std::span<const Motion<D>> motions);
  // True if the island has contacts, and a part of it was solved without contacts before.
  bool has_motions_without_contacts(const Island& island) const;
  // The motions of a solution with links, and of free units where there was none.
  std::vector<Motion<D>> motions_without_contacts(const ContactSystem<D>& system,
                                                  const Island& island) const;
  void keep_motions_without_contacts(const ContactSystem<D>& system, const Island& island,
                                     std::span<const Motion<D>> motions);
  // Linearises about these motions. Returns true if they leave all contacts open and are the
  // solution.
  bool begin_without_contacts(ContactSystem<D>& system, Island& island);
  void make_problem(const ContactSystem<D>& system, Island& island, bool is_rough,
                    double roughly_allowed);
  // A contact gets the load at which its island gave up, or that of the step before if it was added
  // later, or, from an island that joined later, that of its last solution that could be given up.
  void give_loads_of_step(Island& island);
  // For each block the error of its impulse that is asked for, and the rounding errors of its
  // values.
  std::pair<std::vector<double>, std::vector<double>> errors_of_values(const Island& island) const;
  void take_errors(const Island& island, const Refinement<D>* refinement);
  // The residual [L] is that of Coulomb's law if it was asked for, also with given loads.
  BlockResidual residual_of_contact(const Island& island, std::size_t b,
                                    const ConstraintSolution<D>& solution) const;
  void take_over(ContactSystem<D>& system, const Island& island,
                 const ConstraintSolution<D>& solution);

  const ConstraintStep& step_;
  const Particles& particles_;
  std::span<double> displacements_;
  std::span<const double> mobilities_;
  double mean_radius_;
  bool is_convex_;  // the friction's method is kConvex
  LinkTimes times_;
  std::vector<double> free_turns_;     // h w* of all particles
  std::vector<BodyStep> free_bodies_;  // motions of bodies without contacts and links
  std::vector<LinkEquations> links_;
  std::vector<ContactState> contact_states_;
  std::vector<double> link_residuals_, link_forces_;
  std::vector<std::vector<GivenParticleLoad>> across_on_given_;  // of each of links_
  std::vector<ImpulseError> link_errors_;
  // Forces of links with which solutions begin, in the order of link_forces_.
  std::vector<double> first_link_forces_;
  // Motions of the units of bodies whose island was solved without contacts.
  std::vector<std::optional<Motion<D>>> without_contacts_;
  // Places in ConstraintProblem::units of particles and bodies of the present island.
  std::vector<std::int32_t> unit_of_particle_, unit_of_body_;
  std::vector<Vector> offsets_;     // of each particle, from the centre of its rigid body [L]
  std::vector<Island> islands_;     // of the last solve()
  std::vector<Progress> progress_;  // of all bodies of the ContactSystem
  std::size_t known_contacts_ = 0;  // number of contacts in the last solve()
  bool has_given_up_ = false, needs_shorter_step_ = false;
};

}  // namespace viscontact::particles
