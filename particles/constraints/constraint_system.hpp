// Solves a time step of particles that turn, with the contacts with friction, rigid bodies and
// links (hinges, springs, arms, membranes). It makes the problem of constraint_problem.hpp, solves
// it, and writes the solution to contacts, particles and bodies. A unit is a particle or rigid body
// that moves as one. Lengths [L], masses [M] and times [T] are in any consistent units; D is 2
// (discs) or 3 (spheres). Numbers such as (5.9) are equations of docs/physics.md. Nothing is
// checked or thrown; solve(), residual() and link_residual() tell whether a step is solved.
// projection/ uses it. Results depend on the order of units, contacts and links. A change must keep
// the order of the link forces, which restart files store.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "viscontact/particles/bodies/rigid_bodies.hpp"
#include "viscontact/particles/constraints/constraint_problem.hpp"
#include "viscontact/particles/constraints/constraint_solver.hpp"
#include "viscontact/particles/constraints/refinement.hpp"
#include "viscontact/particles/contact/contact_laws.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/dual_problem/contact_system.hpp"
#include "viscontact/particles/links/link_rows.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// A time step, and what its constraints depend on besides contacts. The arrays that are not const
/// belong to the simulation: before solve() they hold the motion without contacts and links, after
/// solve() the motion with them. h = end - begin > 0 [T] is the length of the step, w are angular
/// velocities [1/T], I moments of inertia [M L^2].
struct ConstraintStep {
  const ContactLaws& laws;           ///< the laws of all contacts
  std::span<const Plane> obstacles;  ///< planes, which may move, and circles
  double begin = 0,                  ///< time at which the step begins [T]
      end = 0;                       ///< time at which the step ends [T]
  bool is_first = false;             ///< true: the first step of the simulation
  double kick = 0;          ///< time for which forces act on the velocities in the step [T], > 0
  std::span<double> turns;  ///< h w of all particles [rad], 1 (discs) or 3 numbers for each
  /// h/I of all particles [T/(M L^2)], > 0, or 0 if the motion is given. This and the arrays of
  /// displacements, mobilities and turns have entries of the planes under a load after those of
  /// the particles.
  std::span<const double> turn_mobilities;
  std::span<BodyStep> bodies;    ///< motions of all rigid bodies
  const Links* links = nullptr;  ///< must not be null, but may contain no links
  /// Forces and torques of all links [M L/T^2, M L^2/T^2], in the order of State::link_forces:
  /// before solve() the first guess, after solve() the solution.
  std::span<double> link_forces;
  /// Works of the impulses across all arms, (5.21), in the order of Links::arms [M L^2/T^2]: after
  /// solve() the solution.
  std::span<double> works_across;
};

/// What is known of the error of an impulse.
struct ImpulseError {
  /// Estimate of the error [M L/T], >= 0, by a Refinement; negative if there was none.
  double estimate = -1;
  double rounding = 0;  ///< error that rounding errors of gaps and lengths cause [M L/T], >= 0
};

/// The coefficients by which the motion of one unit enters a link's equation.
template <int D>
Motion<D> row_of(const LinkPart& part) {
  if (!part.is_turn) return displacement_row<D>(part.direction, part.arm);
  Motion<D> row{};
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  for (std::size_t i = 0; i < r; ++i) row[d + i] = part.direction[3 - r + i];
  return row;
}

/// The contacts, rigid bodies and links of a step as one ConstraintProblem, and its solution.
template <int D>
class ConstraintSystem {
 public:
  /// All arguments must outlive this object. `displacements` are those of all particles without
  /// contacts and links [L], D numbers for each particle; solve() changes them. `mobilities` has
  /// h/m > 0 [T/M] for each particle, with its mass m.
  ConstraintSystem(const ConstraintStep& step, const Particles& particles,
                   std::span<double> displacements, std::span<const double> mobilities);

  /// Adds the particles of all links to `system`. It must be called before a contact is added.
  void join_linked(ContactSystem<D>& system) const;

  /// True if an arm keeps the particles of `pair` from overlapping, at the end of the step, by more
  /// than 1e-6 of the sum of their radii. (Cases may leave such an overlap, because they give the
  /// length of the arm with rounding errors.) The contact of such a pair would repeat the equation
  /// of the arm to first order in the arm's turn, and contradict it to second order, and its load
  /// would not be unique. The contact must therefore not be added.
  bool is_held_apart(const Pair& pair) const;

  /// Adds the contact of `pair`. `memory` holds the guess of its friction. The caller must add the
  /// contacts of the ContactSystem in their order there.
  void add(const Contact<D>& contact, const Pair& pair, const PairMemory& memory);

  /// The equations of all links, and then those of the stops of hinges, which bound their angles.
  const std::vector<LinkEquations>& links() const { return links_; }
  /// Allowed residuals of links() [L], > 0; those of angles are multiplied by the mean radius. The
  /// caller sets them before solve().
  std::vector<double> links_allowed;
  /// Errors of the impulses of all contacts, in the order of add(), and then of all links() that
  /// are asked for [M L/T], >= 0; of angles as in links_allowed. The caller sets them before
  /// solve().
  std::vector<double> allowed_errors;
  /// Rounding errors of the gaps and values of the same contacts and links [L].
  std::vector<double> rounding;
  /// Allowed residuals of the slips, the tangential displacements of all contacts [L], > 0, in the
  /// order of add(). The caller sets them before solve().
  std::vector<double> slips_allowed;

  /// Solves the step. Each island of `system`, a set of particles that contacts and links connect,
  /// is solved by itself, so that its solution does not depend on the other islands. If an earlier
  /// call has solved an island as accurately as this call asks, and no contact was added to the
  /// island since, the solution of the island remains as it is. Sets the impulses of the contacts
  /// of `system`, the displacements and turns of its particles, the motions of the rigid bodies,
  /// and the forces of the links. If `is_rough`, all residuals may be up to `roughly_allowed` [L],
  /// > 0. Otherwise those of gaps, slips and links may be up to Contact::allowed, slips_allowed and
  /// links_allowed.
  ///
  /// Returns the number of iterations, in all calls together, of the island with the most, which is
  /// at most about `max_iterations` > 0. The returned residual is the largest one of the last
  /// problems plus the largest correction that would follow, both divided by what is allowed [1].
  /// If it is at most 1, the problems are solved, with given loads where has_given_up() says so.
  ///
  /// The equations of a problem are linear in the motions. The problem is therefore solved again,
  /// with offsets corrected by the difference between the lengths of links and the gaps of bodies
  /// after finite turns and their linear values, until this difference is below half of what is
  /// allowed. If the links of an island were solved before it had contacts, and their motion leaves
  /// all contacts open, that motion is the solution. (Equations that are linear about the beginning
  /// of the step would stop a particle that a hinge or arm takes past an obstacle.) Gaps are at
  /// first taken along the normals at the beginning of the step. If the corrected problem is not
  /// solved, or corrections diverge, gaps become distances of the particles
  /// (ContactSystem::use_distances()), and the solution begins anew.
  ///
  /// An island gives up if its friction must be bounded by given loads (has_given_up()), in the
  /// cases of this and the next three paragraphs. If Coulomb's law is not solved in
  /// `max_iterations`, these are the loads of the best iterate, so that at least gaps, films and
  /// links are exact. The given loads remain in all later calls. If they are so large that this
  /// fails, too, the friction is bounded by the loads of a solution without friction. residual()
  /// remains that of Coulomb's law.
  ///
  /// The convex relaxation (5.9) has no solution where friction locks particles that must move. If
  /// iterations no longer reduce its residual, the friction is bounded by the loads of a solution
  /// without friction, as in (5.17), and residual() is that of (5.17).
  ///
  /// If corrections diverge also with distances, the friction is bounded by the loads of a solution
  /// without friction with either law, unless all loads are given already.
  ///
  /// Friction may lock a body that turns about the line through two contacts. The corrected problem
  /// then has no solution with Coulomb's law, and the friction is bounded by the loads of a
  /// solution without friction. With (5.9) the corrected problem has a solution, but its loads are
  /// more than ten times those without corrections and give the island 1 % more energy. If this
  /// happens, the friction is bounded by the loads without corrections.
  SolverResult solve(ContactSystem<D>& system, bool is_rough, double roughly_allowed,
                     int max_iterations);

  /// True if solve() did not solve the problem of some island with the friction law that was asked
  /// for, and given loads bound the friction there.
  bool has_given_up() const { return has_given_up_; }

  /// Writes the friction of contact number `c`, from 0 in the order of add(), the impulse that its
  /// solids carry, and the impulse of its film across the normal to `memory` [M L/T]. solve() must
  /// have been called before this and the next functions.
  void remember(std::size_t c, PairMemory& memory) const {
    memory.set_friction(contact_states_[c].friction);
    memory[Remembered::kCarried] = contact_states_[c].carried;
    memory.set_across(contact_states_[c].across);
  }
  /// Residual of contact number `c`, from 0 in the order of add(), in the last solution [L].
  const BlockResidual& residual(std::size_t c) const { return contact_states_[c].residual; }
  /// Residual of link number `l` of links() in the last solution [L]; that of angles is multiplied
  /// by the mean radius.
  double link_residual(std::size_t l) const { return link_residuals_[l]; }
  /// Error of the normal impulse of contact number `c` in the last solution.
  const ImpulseError& impulse_error(std::size_t c) const { return contact_states_[c].error; }
  /// Error of the impulse of link number `l` of links() in the last solution; moments of angles are
  /// divided by the mean radius.
  const ImpulseError& link_impulse_error(std::size_t l) const { return link_errors_[l]; }
  /// The impulse of row `k` of link number `l` of links() [M L/T], or [M L^2/T] if it is an angle:
  /// that of the last solution, or the first guess.
  double link_impulse(std::size_t l, std::size_t k) const {
    return times_.kick * link_forces_[links_[l].first_force + k];
  }
  /// Adds the impulses of links across their directions on particles whose motion is given.
  void add_loads_across(std::vector<GivenParticleLoad>& on_given) const {
    for (const auto& of_link : across_on_given_)
      on_given.insert(on_given.end(), of_link.begin(), of_link.end());
  }
  /// The largest kappa, (5.21), of the links that push, and of the pressures that keep areas, in the
  /// last solution. What they push moves away like an unstable pendulum, by a factor of about
  /// exp(kappa^(1/2)) in the step, and a step with kappa above 1 does not resolve it.
  double buckling() const;
  /// For each constraint of the last solve(), first all contacts, then all links, its violation
  /// [L], >= 0, by the motion that violates all constraints least. Violations of angles are
  /// multiplied by the mean radius. That motion has the least sum of v^2/w over the rows of rigid
  /// links and the negative gaps, with the value v and the mobility w of a row. If some motion
  /// satisfies all of these constraints, the result is 0 but for rounding errors. Otherwise the
  /// constraints contradict each other: together the impulses v/w move nothing (Farkas' lemma), and
  /// constraints without a part in the contradiction have 0.
  std::vector<double> least_violations() const;

 private:
  // The block of a row of geometric stiffness.
  struct Tension {
    std::size_t source = 0;   // block of the link or film
    double moved_before = 0;  // step times the rate of the row at its beginning [L, rad]
    double moved_given = 0;   // by particles whose motion is given, in the step [L, rad]
    Vector direction{};       // of the impulse on the second particle; 0 of a turn
    // Directions of the impulses on particles whose motion is given.
    std::vector<std::pair<std::int32_t, Vector>> on_given{};
  };
  // A set of particles that contacts and links connect, and its problem.
  struct Island {
    std::vector<std::int32_t> bodies;          // numbers that ContactSystem gives to the particles
    std::vector<std::size_t> contacts, links;  // numbers of the blocks of the problem, in its order
    ConstraintProblem<D> problem;  // empty if the last solve() left the island as it was
    // The last blocks of the problem, after those of contacts and links.
    std::vector<Tension> tensions;
    std::vector<double> shifts;         // last corrections of the blocks of contacts and links [L]
    std::vector<double> shifts_across;  // of the motions, by the last change of their tensions [L]
    // True if redundant loads have no unique values, which may differ a little in each solution, and
    // with them the tensions.
    bool loads_may_drift = false;
    // can_give_up: false if the problem had no solution with given loads either.
    bool has_given_up = false, can_give_up = true;
  };
  // How the island of a particle was solved so far.
  struct Progress {
    enum class Solved : unsigned char { kNot, kRoughly, kAccurately } solved = Solved::kNot;
    int iterations = 0;
  };
  // What is known of a contact besides what the ContactSystem has.
  struct ContactState {
    ContactTangents<D> tangents;
    Vector friction{};      // impulse of friction [M L/T]
    Vector across{};        // impulse of the film across the normal, on the second particle [M L/T]
    double carried = 0;     // part of the impulse that solids carry [M L/T]
    double first_load = 0;  // load with which solutions begin, that of the last rough solution or
                            // of the step before [M L/T]
    double given_load = 0;  // load that bounds the friction after the island has given up [M L/T]
    bool gave_up = false, could_not_give_up = false;  // its island
    BlockResidual residual;                           // in the last solution
    ImpulseError error;                               // in the last solution
    // ConstraintBlock::given_load in the last solution that was not rough [M L/T]; without a value
    // before.
    std::optional<double> last_load;
  };
  void find_islands(ContactSystem<D>& system);
  bool is_solved(const ContactSystem<D>& system, const Island& island, bool is_rough) const;
  SolverResult solve_island(ContactSystem<D>& system, Island& island, bool is_rough,
                            double roughly_allowed, int max_iterations);
  // True if the motion of the particle is given, so that it has no unit.
  bool is_given(std::int32_t particle) const { return !(mobilities_[index_of(particle)] > 0); }
  UnitMotion given_motion(std::int32_t particle) const;
  ContactSide side_of(std::int32_t entry) const;
  void number_units(const ContactSystem<D>& system, Island& island);
  void add_contact(const Contact<D>& contact, std::size_t c, double allowed_slip,
                   ConstraintProblem<D>& problem);
  void add_link(std::size_t l, double allowed, ConstraintProblem<D>& problem);
  UnitMotion motion_of(std::int32_t unit, std::span<const Motion<D>> motions) const;
  void move_particles(const ContactSystem<D>& system, const Island& island,
                      std::span<const Motion<D>> motions);
  double correct(ContactSystem<D>& system, Island& island, std::span<const Motion<D>> motions);
  // Rows of the geometric stiffness of block `b`, that of a contact or link, at its impulses.
  std::vector<LinkRow> tension_rows(const ContactSystem<D>& system, const Island& island,
                                    std::size_t b) const;
  // For each unit kappa of its films, share_of_film(); empty if no film is a spring.
  std::vector<double> film_kappas_of_units(const ContactSystem<D>& system,
                                           const Island& island) const;
  // Compares the geometric stiffness in the problem with that of its impulses. Takes over the latter
  // if the difference changes a motion by more than half of what is allowed, or if `is_always`.
  // Returns the change of `motions` divided by what is allowed [1].
  double change_tensions(const ContactSystem<D>& system, Island& island,
                         std::span<const Motion<D>> motions, bool is_always);
  // The works of arms and the impulses of films across their directions.
  void take_impulses_across(const Island& island, std::span<const Motion<D>> motions);
  bool has_motions_without_contacts(const Island& island) const;
  std::vector<Motion<D>> motions_without_contacts(const ContactSystem<D>& system,
                                                  const Island& island) const;
  bool begin_without_contacts(ContactSystem<D>& system, Island& island);
  bool has_large_shifts(const Island& island) const;
  bool can_use_distances(ContactSystem<D>& system, const Island& island) const;
  void make_problem(const ContactSystem<D>& system, Island& island, bool is_rough,
                    double roughly_allowed);
  bool may_give_up(const Island& island) const;
  bool give_up(Island& island, bool have_diverged, ConstraintSolution<D>& solution,
               SolverResult& result);
  void give_loads_of_step(Island& island);
  std::pair<std::vector<double>, std::vector<double>> errors_of_values(const Island& island) const;
  double change_of_impulses(const Island& island, const Refinement<D>& refinement) const;
  void take_errors(const Island& island, const Refinement<D>* refinement);
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
  // Motions of the unit of each body of the ContactSystem whose island was solved without contacts.
  std::vector<std::optional<Motion<D>>> without_contacts_;
  // Place in ConstraintProblem::units of the particles and rigid bodies of the island that is
  // solved.
  std::vector<std::int32_t> unit_of_particle_, unit_of_body_;
  std::vector<Vector> offsets_;     // of each particle, from the centre of its rigid body [L]
  std::vector<Island> islands_;     // of the last solve()
  std::vector<Progress> progress_;  // of all bodies of the ContactSystem
  std::size_t known_contacts_ = 0;  // number of contacts in the last solve()
  bool has_given_up_ = false;       // an island has given up
};

}  // namespace viscontact::particles
