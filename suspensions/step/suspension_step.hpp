// The convex problem of a step: films by their first integrals, and rigid contact, (9.11) to
// (9.17); with inertia or a given stress, (9.19) to (9.23).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "viscontact/common/index.hpp"
#include "viscontact/particles/contact/film_law.hpp"
#include "viscontact/suspensions/linear/conjugate_gradients.hpp"
#include "viscontact/suspensions/pairs/pair_sizes.hpp"
#include "viscontact/suspensions/pairs/pair_system.hpp"
#include "viscontact/suspensions/pairs/row_blocks.hpp"
#include "viscontact/suspensions/step/acceleration.hpp"
#include "viscontact/suspensions/values/affine_motion.hpp"
#include "viscontact/suspensions/values/stress_sums.hpp"

namespace viscontact::suspensions {

/// What a pair remembers of its contact.
struct ContactMemory {
  std::int32_t first = 0, second = 0;
  /// Mean force of the contact in the last step, > 0 where it pushes [M L/T^2].
  double load = 0;
  double least_load = 0;  ///< in the step, <= 0: gamma/h if it has a film [M L/T^2]
  Vector friction{};      ///< mean friction on the second body in the last step [M L/T^2]
};

struct SphereInertia {
  double mass = 0, moment = 0;  ///< [M], [M L^2]
  Motion start{};               ///< motion at the start less the mean flow on the way of the step
};

/// A given mean shear stress, with which the rate of the flow is one more unknown.
struct GivenStress {
  Matrix gradient{};        ///< of the flow of rate 1 [1/T]
  double rate = 0;          ///< near the solution [1]
  double of_stress = 0;     ///< the stress times the volume, its power at rate 1 [M L^2/T^3]
  double of_repulsion = 0;  ///< the part of it that the repulsion has [M L^2/T^3]
  double of_fluid = 0;      ///< power of the fluid alone at rate 1 [M L^2/T^3]
};

struct StepProblem {
  PairLubrication lubrication;
  double friction = 0;  ///< coefficient of Coulomb's friction [1]
  /// Of contacts without lubrication; nullptr if they have none.
  const particles::FilmLaw* contact_film = nullptr;
  std::span<const double> radii;  ///< of spheres, then of planes, which are infinite [L]
  double mean_radius = 1;
  std::vector<NearPair> pairs;          ///< at the start of the step
  std::vector<ContactMemory> memories;  ///< in order of first, second
  std::vector<Motion> motions;          ///< of the last step, relative to the flow
  std::vector<Motion> loads;            ///< given forces and torques; empty without any
  std::vector<SphereInertia> inertia;   ///< of the spheres; empty without inertia
  Matrix gradient{};                    ///< [1/T]; at GivenStress::rate
  std::optional<GivenStress> stress;    ///< without planes and inertia
  double h = 0;                         ///< [T]
  ThreadPool* pool = nullptr;
  /// Whether a solution is of use in which only the bounds of friction are not right.
  bool takes_given_bounds = true;
};

struct StepSolution {
  std::vector<Motion> motions;          ///< relative to the flow, means over the step
  std::vector<Motion> changes;          ///< of velocities in the step, of spheres with inertia
  double rate = 1;                      ///< if the stress is given
  double least_rate = 0;                ///< below it rates of shear are at rest [1/T]
  std::vector<ContactMemory> contacts;  ///< with a load or a memory
  StressSums stresses;
  double dissipation = 0;  ///< of drag, films, contacts and friction [M L^2/T^3]
  int solutions = 0;       ///< linear problems
  int iterations = 0;      ///< of conjugate gradients
  /// Whether motions, gaps and slips are right with the friction's bounds; these are perhaps wrong.
  bool is_solved = false;
  bool converged = false;        ///< is_solved, and the bounds are those of the loads
  bool has_given_loads = false;  ///< whether the loads that bound friction were fixed
  /// The largest error of a gap and of friction_error(), in mean radii.
  double residual = 0;
  double smallest_gap = 0;  ///< at the end [L]
  std::size_t touching = 0;
};

struct Contact;
struct Film;
struct FilmStrain;
struct FrictionContact;

class SuspensionStep {
 public:
  explicit SuspensionStep(StepProblem problem);
  ~SuspensionStep();
  StepSolution solve();

 private:
  struct Rate;
  // What the present motions make of the gaps.
  struct Gaps {
    double error = 0;                                           // the largest of a contact [L]
    double smallest = std::numeric_limits<double>::infinity();  // [L]
    double stiffness = 0;     // sum of those of films and contacts [M/T]
    std::size_t changes = 0;  // contacts that would be linearised otherwise
    // A measure of the power that the change of the loads of contacts by update_contacts() would
    // leave over [M L^2/T^3].
    double power_of_changes = 0;
  };
  // The loads that bound friction: those of contacts, or fixed ones.
  enum class Bounds : std::uint8_t { kOfLoads, kGiven };
  // Calls work(p) for all pairs p.
  template <class Work>
  void for_each_pair(const Work& work) const {
    problem_.pool->for_blocks(
        problem_.pairs.size(),
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t p = begin; p < end; ++p) work(p);
        },
        kPairsInBlock);
  }
  // Takes pairs at half of the step of the present motions.
  void place_again();
  // (9.19) to (9.21): the resistance by inertia, and what the motion at the start adds to the
  // loads.
  void add_inertia();
  // Whether each sphere would close a gap with a film by its motion at the start.
  std::vector<bool> stopped_spheres() const;
  void add_momentum(std::vector<Motion>& loads) const;
  std::vector<Motion> changes_of_velocities() const;
  // Translates all spheres with inertia, if there is no plane, so that the loads from outside alone
  // change their momentum.
  void balance_momentum();
  // What the velocities v and the motions at the start s give: v.M v and v.M s over theta h.
  double power_of_inertia() const;
  double power_of_momentum() const;
  PairSizes sizes(std::size_t p) const { return system_.sizes(p); }
  double delta(std::size_t p) const;  // of pair p [L]
  // What two bodies resist to an approach by their inertia [M/T].
  double inertia_of(std::int32_t first, std::int32_t second) const;
  // Sets what films have by the place of the pairs.
  void place_films();
  // Sets what the films and the given loads have by the flow.
  void set_flow();
  FilmStrain film_strain(std::size_t p) const;
  void add_contacts();
  void add_contact(std::size_t p, const ContactMemory& memory);
  // Sets what a contact has by the place of its pair; `friction` is that of its memory.
  void place_contact(Contact& contact);
  void place_friction(FrictionContact& contact, const Lanes& friction);
  Lanes force_of(const FrictionContact& contact) const;  // on the second body
  // The contacts that have a load or a memory, in order.
  std::vector<ContactMemory> memories() const;
  // Whether the film of pair p alone keeps its gap above 0, so that it has no contact before its
  // gap is kSolidGap.
  bool is_kept_apart(std::size_t p) const;
  // The width below which the force of a film is linear in it [L].
  double solid_width() const;
  // Rate at which pair p opens relative to the flow [L/T].
  double opening(std::size_t p, const std::vector<Motion>& motions) const {
    const auto& row = system_.resistance().pairs[p];
    return dot(row.normal,
               motions[index_of(row.second)].along - motions[index_of(row.first)].along);
  }
  // The slip (9.16) of the surfaces, turned by a right angle about the normal [L/T]: the sum of
  // both parts.
  Lanes slip(const FrictionContact& contact, const std::vector<Motion>& motions) const;
  Lanes slip_by_motions(const FrictionContact& contact, const std::vector<Motion>& motions) const;
  Lanes slip_by_strain(const FrictionContact& contact) const {
    return slip_by_strain(contact, strain_);
  }
  Lanes slip_by_strain(const FrictionContact& contact, const SymmetricTensor& strain) const;
  // The friction at a slip, and how it changes with the slip where it was linearised.
  Lanes friction_at(const FrictionContact& contact, const Lanes& at_slip) const;
  static Lanes change_of_friction(const FrictionContact& contact, const Lanes& change);
  double friction_bound(const FrictionContact& contact) const;
  double coulomb_bound(const FrictionContact& contact) const;
  // What contacts that stick slip in the step. Where the friction differs from Coulomb's, of the
  // loads or, in the first member, of the bounds in use, the slip that makes this difference [L].
  struct FrictionError {
    double with_bounds = 0, with_loads = 0;
  };
  FrictionError friction_error() const;
  // Whether the bounds in use are those of the loads.
  bool are_bounds_right() const;
  // Sets the rows and right sides at the present motions.
  void linearise(bool is_first);
  // Of film and contact; false if the film is not linearised where it is.
  bool linearise_pair(std::size_t p, bool is_first);
  void linearise_friction(FrictionContact& contact);
  // Contacts that would be linearised otherwise at the present motions.
  std::size_t count_changes() const;
  bool is_changed(const Contact& contact, double width) const;
  // Sets the loads of contacts by the present motions.
  void update_contacts();
  // Sets them with the bounds of friction that are in use.
  void settle_contacts();
  // The same with friction, accelerated after some `solutions`. Changes the motions, too.
  void update_friction(int solutions);
  // Loads and friction of all contacts, each over the root of its stiffness [(M L^2/T^3)^(1/2)].
  std::vector<double> scaled_loads() const;
  void set_scaled_loads(const std::vector<double>& loads);
  // Takes the nearest loads and friction that obey (9.13) and (9.15).
  void obey_bounds();
  // Finds loads and motions by the splitting of Douglas & Rachford (Lions & Mercier 1979): in turn
  // the nearest loads that obey Coulomb's law, and motions with which contacts are springs that
  // stick. It needs more linear problems than the augmented Lagrangian, but solves steps in which
  // the loads of that one go in circles. Returns whether the loads change by less than `allowed`
  // [M L^2/T^3]. With friction only.
  bool split(StepSolution& solution, double allowed);
  // Stiffnesses of contacts along and across over the resistance of the film at contact.
  void set_stiffnesses(double along, double across);
  // Takes the loads of springs that stick.
  void take_trial_loads();
  void find_states();  // of friction, by the present loads
  // Finds the gaps at the end of the step, and contacts that were not expected.
  void find_gaps();
  // Goes back from the present motions and rate towards those before, if the function to be
  // minimised rises. `curvature` is the change of the motions times R times this change, by which
  // `before` is replaced.
  void shorten(std::vector<Motion>& before, double rate_before, double curvature);
  // Where the linear problem ends that follows so many, if this residual is allowed.
  ConjugateGradients::End end_of_linear(int solutions, double allowed) const;
  ConjugateGradients::Result solve_linear(const ConjugateGradients::End& end);
  // With a given stress: what the strain alone has in the row of the rate.
  void place_rate();
  // The row of the rate in the linear problem at the present motions.
  void linearise_rate();
  // Adds what pair p has in this row.
  void add_to_rate(std::size_t p);
  ConjugateGradients::Result solve_with_rate(const ConjugateGradients::End& end);
  void set_rate();
  // Sets the loads of contacts at the present motions, and then scales these and the rate by what
  // the stress still differs from the given one.
  void settle_rate(StepSolution& solution);
  double least_power() const;     // [M L^2/T^3]
  double rounding_power() const;  // of residuals by rounding errors of gaps [M L^2/T^3]
  double rate_error() const;      // of a rate that is not given, by the same [1]
  // Rates of shear below it cannot be told from rest [1/T].
  double least_rate() const;
  void sum_stresses(StepSolution& solution);
  // Sets what the solution has of the last motions. Only the destructor may follow.
  void finish(StepSolution& solution);

  StepProblem problem_;
  SymmetricTensor strain_;
  PairSystem system_;
  BlockPreconditioner preconditioner_;
  bool has_factors_ = false;               // of the pairs as they are placed
  std::size_t changed_since_factors_ = 0;  // pairs whose stiffness has changed
  ConjugateGradients gradients_;
  std::vector<Motion> motions_, right_, given_loads_;
  std::vector<SphereDrag> inertia_;  // mass and moment of inertia over theta h
  std::vector<Film> films_;
  std::vector<Contact> contacts_;
  std::vector<FrictionContact> frictions_;  // of the contacts, with friction
  Acceleration acceleration_;
  std::unique_ptr<Rate> rate_;  // nullptr if the rate is given
  Gaps gaps_;
  Bounds bounds_ = Bounds::kOfLoads;
  bool is_stiff_ = false;      // whether all contacts have the large stiffness
  bool is_split_ = false;      // whether contacts are linearised as springs that stick
  int updates_ = 0;            // of loads with friction
  int unchanged_ = 0;          // linear problems since a contact began to stick, slide or open
  bool is_film_exact_ = true;  // whether all films were linearised where they are
};

}  // namespace viscontact::suspensions
