// Contacts and their forces as CSV tables, in the units of the case: contacts, rebounds, walls,
// planes, stress.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/particle_runs/io/columns.hpp"
#include "viscontact/particle_runs/io/link_file.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {

/// final_contacts.csv: a line "# rows: N" with the number of contacts, the names of the columns
/// (contact_columns()), and a row for each contact. Forces and impulses of discs in a fluid are per
/// length.
std::string write_contacts(const Particles& particles, std::span<const CurrentContact> contacts,
                           bool has_friction = false);

/// The table of the planes under a load, which a run with such planes writes.
inline constexpr const char* kPlanesFile = "planes.csv";

/// The line with the names of the columns of rebounds.csv.
std::string rebounds_header();
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
/// always among them, and planes.csv is if a plane has a load. Other names are ignored. Rows of
/// stress.csv throw as contact_stress() does.
std::vector<TimeTable> asked_tables(const Setting& setting, const Particles& particles,
                                    std::span<const std::string> names);

/// The tables of docs/file-formats.md with the columns of the files above.
std::vector<ColumnTable> contact_file_tables();

}  // namespace viscontact::particles
