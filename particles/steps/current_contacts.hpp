// The contacts of a state, for output, and its overlaps.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

enum class ContactFriction : std::int8_t {
  /// The case has no friction, or the solids carried no load. With FrictionMethod::kConvex such a
  /// contact may still have had friction, because a load that was given before the step bounds it.
  kNone,
  kSticks,  ///< the friction is smaller than coefficient times load
  kSlides   ///< the friction is coefficient times load, its largest magnitude
};

/// A contact as files show it. gamma is minus the impulse that the fluid film between both surfaces
/// has absorbed. A contact with gamma < 0 is called glued, because the film can pull.
struct CurrentContact {
  std::int32_t first;      ///< number of a particle, or -1 - k for obstacle k of obstacles_of()
  std::int32_t second;     ///< number of a particle
  double gap;              ///< [L], < 0 if the two overlap
  double gamma;            ///< Pair::gamma [M L/T], of discs in a fluid [M/T]; <= 0
  double gamma_error = 0;  ///< estimate of the error of gamma, in its unit, >= 0
  std::int32_t image = 0;  ///< periodic image of `second` that meets `first`, -13 to 13; 0: itself
  ContactFriction friction = ContactFriction::kNone;
  /// Mean normal force in the last step [M L/T^2], of discs in a fluid per length: that of solids
  /// and film together, > 0 where it pushes the bodies apart.
  double normal_force = 0;
  /// Mean friction on `second` in the last step, and the force across the normal of a film that
  /// pulls, (5.21), in the unit of normal_force.
  Vector tangential_force{};
  /// The part of normal_force that the solids bear, and not the film, >= 0. It bounds the friction.
  /// Always 0 in a case without friction.
  double solid_force = 0;
  // VTK files do not have the next two members.
  Vector normal{};  ///< unit normal from `first` to `second`
  /// Vector [L] to the centre of `second` from that of `first` or the nearest point of an obstacle.
  /// Components beyond the dimension are 0.
  Vector branch{};
  /// Numbers that laws remember of the pair and files show (pair_memory.hpp), often none.
  [[no_unique_address]] ShownMemory shown{};
};

/// Names of both bodies in files: the ids of the first and the second particle; or, at obstacle k,
/// the id of the particle and -1 - k, in this order.
std::pair<std::int32_t, std::int32_t> ids_of(const Particles& particles,
                                             const CurrentContact& contact);

/// The pairs of the state that are glued, touch, or had a force in the last step. First come the
/// pairs of particles in the order of State::pairs, then the particles at obstacles in the order of
/// State::walls; io/vtk_reader.cpp returns the contacts of a file in the same order. A pair touches
/// if its gap is at most SolverSettings::tolerance times the mean radius, to which
/// Fluid::threshold_gap is added in a fluid. Before the first step all forces are 0.
std::vector<CurrentContact> contacts_of(const Setting& setting, const State& state);

/// The largest Pair::gamma_error, in the unit of gamma; 0 without pairs.
double largest_gamma_error(const State& state);

/// Largest overlap of two particles, or of a particle and an obstacle, divided by the mean radius
/// [1]. It checks all particles, not only the pairs in the neighbour list. Two particles of one
/// body, or neighbours on a membrane, may overlap and do not count.
double largest_overlap(const Setting& setting, const State& state);

}  // namespace viscontact::particles
