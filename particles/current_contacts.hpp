// Lists the contacts of a state for output, and measures its overlaps. Lengths, masses and times
// are in the units of the case. Tables, VTK files and pages show these contacts; io/, run/ and
// python/ use this file. Nothing is checked or thrown. A change must keep the order of
// contacts_of(), because io/vtk_reader.cpp returns the contacts of a file in the same order.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "viscontact/particles/setting.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// What friction did at a contact in the last step.
enum class ContactFriction : std::int8_t {
  kNone,    ///< no load on the solids (given loads may bear friction), or a case without friction
  kSticks,  ///< the friction is smaller than coefficient times load
  kSlides   ///< the friction is coefficient times load, its largest magnitude
};

/// A contact as files show it. gamma is minus the impulse that the fluid film between both surfaces
/// has absorbed; a contact with gamma < 0 is glued.
struct CurrentContact {
  std::int32_t first;      ///< number of a particle, or -1 - k for obstacle k of obstacles_of()
  std::int32_t second;     ///< number of a particle, its place in Particles, from 0
  double gap;              ///< [L], < 0 if the two overlap
  double gamma;            ///< Pair::gamma [M L/T], of discs in a fluid [M/T]; <= 0
  double gamma_error = 0;  ///< estimate of the error of gamma, in its unit, >= 0
  std::int32_t image = 0;  ///< periodic image of `second` that meets `first`, -13 to 13; 0: itself
  ContactFriction friction = ContactFriction::kNone;  ///< in the last step
  /// Mean normal force in the last step [M L/T^2], of discs in a fluid per length: that of solids
  /// and film together, > 0 where it pushes the bodies apart.
  double normal_force = 0;
  Vector tangential_force{};  ///< mean friction on `second` in the last step, in the same unit
  // The next members are not in VTK files.
  Vector normal{};  ///< unit normal from `first` to `second`
  /// Vector [L] to the centre of `second` from that of `first` or the nearest point of an obstacle.
  /// Components beyond the dimension are 0.
  Vector branch{};
  /// Numbers that laws remember of the pair and files show (pair_memory.hpp), often none.
  [[no_unique_address]] ShownMemory shown{};
};

/// Names of both bodies in files: the ids of two particles, or of one, and -1 - k for obstacle k.
std::pair<std::int32_t, std::int32_t> ids_of(const Particles& particles,
                                             const CurrentContact& contact);

/// The pairs that are glued, touch, or had a force in the last step: first pairs of particles, then
/// particles at obstacles, each in the order of the state. A pair touches if its gap is at most
/// SolverSettings::tolerance times the mean radius, to which Fluid::threshold_gap is added in a
/// fluid.
std::vector<CurrentContact> contacts_of(const Setting& setting, const State& state);

/// Largest Pair::gamma_error of all pairs, in the unit of gamma, >= 0; 0 without pairs.
double largest_gamma_error(const State& state);

/// Largest overlap of two particles, or of a particle and an obstacle, divided by the mean radius;
/// 0 if nothing overlaps. It checks all particles, not only the pairs in the neighbour list.
double largest_overlap(const Setting& setting, const State& state);

}  // namespace viscontact::particles
