// The convex problem of a step: films by their first integrals, and rigid contact, (9.11) to (9.17).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/particles/contact/film_law.hpp"
#include "viscontact/suspensions/affine_motion.hpp"
#include "viscontact/suspensions/conjugate_gradients.hpp"
#include "viscontact/suspensions/pair_system.hpp"
#include "viscontact/suspensions/stress_sums.hpp"

namespace viscontact::suspensions {

/// What a pair remembers of its contact.
struct ContactMemory {
  std::int32_t first = 0, second = 0;
  /// Mean force of the contact in the last step, > 0 where it pushes [M L/T^2].
  double load = 0;
  double least_load = 0;  ///< in the step, <= 0: gamma/h if it has a film [M L/T^2]
  Vector friction{};      ///< mean load of friction, (9.16), in the last step [M L/T^2]
};

struct StepProblem {
  PairLubrication lubrication;
  double friction = 0;  ///< coefficient of Coulomb's friction [1]
  /// Of contacts without lubrication; nullptr if they have none.
  const particles::FilmLaw* contact_film = nullptr;
  std::span<const double> radii;  ///< [L]
  double mean_radius = 1;
  std::vector<NearPair> pairs;          ///< at the start of the step
  std::vector<ContactMemory> memories;  ///< in order of first, second
  std::vector<Motion> motions;          ///< of the last step, relative to the flow
  std::vector<Motion> loads;            ///< given forces and torques
  Matrix gradient{};                    ///< [1/T]
  double h = 0;                         ///< [T]
};

struct StepSolution {
  std::vector<Motion> motions;
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

class SuspensionStep {
 public:
  explicit SuspensionStep(StepProblem problem);
  ~SuspensionStep();
  StepSolution solve();

 private:
  struct Film;
  struct Contact;
  // The loads that bound friction: those of contacts, others that follow these, or fixed ones.
  enum class Bounds : std::uint8_t { kOfLoads, kFollowing, kGiven };
  // Takes pairs at half of the step of the present motions.
  void place_again();
  void add_films();
  void add_contacts();
  void add_contact(std::size_t p, const ContactMemory& memory);
  // Whether the film of pair p alone keeps its gap above 0, so that it never has a contact.
  bool is_kept_apart(std::size_t p) const;
  // Rate at which pair p opens relative to the flow [L/T].
  double opening(std::size_t p, const std::vector<Motion>& motions) const;
  // The slip (9.16) of the surfaces, turned by a right angle about the normal [L/T]: the sum of both
  // parts.
  Lanes slip(const Contact& contact, const std::vector<Motion>& motions) const;
  Lanes slip_by_motions(const Contact& contact, const std::vector<Motion>& motions) const;
  Lanes slip_by_strain(const Contact& contact) const;
  // The friction at a slip, and how it changes with the slip where it was linearised.
  Lanes friction_at(const Contact& contact, const Lanes& at_slip) const;
  static Lanes change_of_friction(const Contact& contact, const Lanes& change);
  double friction_bound(const Contact& contact) const;
  double coulomb_bound(const Contact& contact) const;
  // What contacts that stick slip in the step. Where the friction differs from Coulomb's, of the loads
  // or, in the first member, of the bounds in use, the slip that makes this difference [L].
  struct FrictionError {
    double with_bounds = 0, with_loads = 0;
  };
  FrictionError friction_error() const;
  // Whether the bounds in use are those of the loads.
  bool are_bounds_right() const;
  // Sets the rows and right sides at the present motions.
  void linearise(bool is_first);
  void linearise_friction(Contact& contact, Lanes& turn1, Lanes& turn2);
  double trial_load(const Contact& contact) const;
  // Contacts that would be linearised otherwise at the present motions.
  std::size_t count_changes() const;
  // Sets the loads of contacts by the present motions.
  void update_contacts();
  // Finds the gaps at the end of the step, and contacts that were not expected.
  void find_gaps();
  // Goes back from the present motions towards those before, if the function to be minimised rises.
  void shorten(const std::vector<Motion>& before);
  double least_power() const;  // [M L^2/T^3]
  void sum_stresses(StepSolution& solution);

  StepProblem problem_;
  SymmetricTensor strain_;
  PairSystem system_;
  ConjugateGradients gradients_;
  std::vector<Motion> motions_, right_, given_loads_;
  std::vector<Film> films_;
  std::vector<Contact> contacts_;
  double gap_error_ = 0, smallest_gap_ = 0;  // [L]
  Bounds bounds_ = Bounds::kOfLoads;
  bool is_film_exact_ = true;  // whether all films were linearised where they are
};

}  // namespace viscontact::suspensions
