// Contacts and their forces as CSV tables, in the units of the case: contacts, rebounds, walls,
// planes, stress.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/particle_runs/io/link_file.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {

/// CSV text: a line "# rows: N" with the number of contacts, the names of the columns, and a row
/// for each contact. Forces and impulses of discs in a fluid are per length. The columns are
///
/// - i,j: the ids (>= 0) of the first and the second particle; at an obstacle i is the id of the
///   particle, and j is -1, -2, ... for the first, second obstacle of the case;
/// - gap [L], < 0 where the two overlap;
/// - gamma [M L/T], <= 0, minus the impulse that the fluid film between both has absorbed, and
///   gamma_error, an estimate >= 0 of its error;
/// - normal_force, > 0 where it pushes both apart, and the components tangential_force_x and _y, in
///   space also _z (none on an axis), of the friction on the second particle [M L/T^2];
/// - the numbers that contact laws remember and kMemoryFields marks as is_shown;
/// - with `has_friction` solid_force, the part of normal_force that the solids bear, which bounds
///   the friction.
std::string write_contacts(const Particles& particles, std::span<const CurrentContact> contacts,
                           bool has_friction = false);

/// The table of the planes under a load, which a run with such planes writes: the number of the
/// plane as in walls.csv; how far it has moved along its normal since time 0 [L], and at which
/// velocity [L/T]; its load, and the sum of the normal forces of its contacts, both means over the
/// last step [M L/T^2].
inline constexpr const char* kPlanesFile = "planes.csv";
inline constexpr const char* kPlanesHeader = "time,wall,displacement,velocity,load,contact_force\n";

inline constexpr const char* kReboundsHeader =
    "time,first,second,approach_velocity,solid_impulse,velocity\n";
/// The rows of rebounds.csv, the members of Rebound (rebound.hpp): time [T], velocities [L/T] and
/// impulse [M L/T]. `first` and `second` are ids; at an obstacle `second` is -1, -2, ... for the
/// first, second obstacle.
std::string rebound_rows(const Particles& particles, std::span<const Rebound> rebounds);

/// The mean force of all contacts on each obstacle in the last step [M L/T^2], as in walls.csv.
std::vector<Vector> wall_forces(const Setting& setting, const State& state);

/// The components of the stress of the contacts in the last step, row by row, as in stress.csv. The
/// domain or the planes must bound a region; throws Error(kBadInput) if they no longer do.
std::vector<double> contact_stress(const Setting& setting, const State& state);

/// Tables over time that a case may ask for (output.tables), in the order of those in
/// asked_tables(). A run in a fluid always writes the first two.
inline constexpr auto kAskedTables =
    std::to_array<std::string_view>({"motion", "contacts", "walls", "stress"});

/// The tables whose names, some of kAskedTables, are in `names`. In a fluid the first two are
/// always among them, and planes.csv is if a plane has a load. Other names are ignored. Each row
/// begins with its time [T]:
///
/// - motion.csv: time,id, the position [L], the angle of discs that turn [rad], the velocity [L/T],
///   and the angular velocity of particles that turn [1/T], each with its components;
/// - contacts.csv: time and the columns of write_contacts() without gamma_error;
/// - walls.csv: time,wall,force_x,force_y[,force_z],point_x,...,velocity_x,..., on an axis
///   time,wall,force_z,point_z,velocity_z: the mean force of all contacts on each obstacle in the
///   last step [M L/T^2], which includes collisions; the place of its point, or of the centre of a
///   circle [L]; and the velocity of this point [L/T]. wall is -1, -2, ... for the first, second
///   obstacle;
/// - stress.csv: time,stress_xx,stress_xy,stress_yx,stress_yy, in space nine components, on an axis
///   time,stress_zz: the mean stress of the contacts in the domain in the last step [M/(L T^2)], of
///   discs without a fluid [M/T^2], which includes collisions, docs/physics.md (5.19). Its rows
///   throw as contact_stress() does.
std::vector<TimeTable> asked_tables(const Setting& setting, const Particles& particles,
                                    std::span<const std::string> names);

}  // namespace viscontact::particles
