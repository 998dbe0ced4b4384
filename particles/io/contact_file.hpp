// Writes contacts and their forces as CSV tables: those at the end of a run, and those over time
// that a case asks for. Lengths, masses and times are in the units of the case; forces and impulses
// of discs in a fluid are per length. Nothing is checked or thrown. run/ writes the tables into
// files, and case/ checks their names. A change must keep the columns, which users' scripts read.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/particles/current_contacts.hpp"
#include "viscontact/particles/io/link_file.hpp"

namespace viscontact::particles {

/// CSV text with the columns i,j, the members gap,gamma,gamma_error,normal_force of CurrentContact,
/// the tangential force on CurrentContact::second [M L/T^2] (x and y, in space also z; not on an
/// axis) and those of kMemoryFields that are shown. i and j are the ids of two particles, of which
/// j is the second; or of a particle, and -1, -2, ... for the first, second obstacle.
std::string write_contacts(const Particles& particles, std::span<const CurrentContact> contacts);

/// The line with the names of the columns of rebounds.csv.
inline constexpr const char* kReboundsHeader =
    "time,first,second,approach_velocity,solid_impulse,velocity\n";
/// The rows of rebounds.csv (rebound.hpp), one for each of `rebounds`; empty without any. first and
/// second are as i and j in write_contacts().
std::string rebound_rows(const Particles& particles, std::span<const Rebound> rebounds);

/// Tables over time that a case may ask for (output.tables). A run in a fluid has the first two.
inline constexpr auto kAskedTables =
    std::to_array<std::string_view>({"motion", "contacts", "walls", "stress"});

/// The tables that `names`, some of kAskedTables, ask for, and in a fluid the first two; other
/// names are ignored:
///
/// - motion.csv: time,id, the position, the angle of discs that turn, the velocity, and the angular
///   velocity of particles that turn, each with its components;
/// - contacts.csv: time and the columns of write_contacts() without gamma_error;
/// - walls.csv: time,wall,force_x,force_y[,force_z], on an axis force_z: the mean force of all
///   contacts on each obstacle in the last step, with its blows [M L/T^2]; wall is -1, -2, ...;
/// - stress.csv: time,stress_xx,stress_xy,stress_yx,stress_yy, on an axis stress_zz: the mean
///   stress of the contacts in the domain in the last step, with its blows [M/(L T^2)],
///   docs/physics.md (5.19). It needs a domain.
std::vector<TimeTable> asked_tables(const Setting& setting, const Particles& particles,
                                    std::span<const std::string> names);

}  // namespace viscontact::particles
