// Reads the case file of many particles, a TOML file in which a user describes a simulation
// (docs/case-file.md, "Many particles"). Lengths, masses and times are in any one consistent system
// of units. run/, sweep/, python/ and the sweep of particles_study.hpp use it. Every fault of a
// case throws Error(kBadInput), with the line and the key if it is in one of them. A change must
// keep accepting the cases that users have written.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/case_file/case_template.hpp"
#include "viscontact/case_file/keys.hpp"
#include "viscontact/particles/arrangement/arrangement.hpp"
#include "viscontact/particles/setting.hpp"

namespace viscontact::particles {

/// Content of a case file of many particles.
struct ParticlesCase {
  std::filesystem::path path;  ///< the case file
  std::string text;            ///< content of the file
  std::string title;           ///< a title for pages and pictures; may be empty
  Units units{};               ///< words for the units, for pages and pictures; may be empty
  /// Everything that the simulation needs besides the particles.
  Setting setting;
  /// The particles at time 0: those of the CSV file, of the tables [[particle]], of [arrangement]
  /// and of [[membrane]], in this order.
  Particles particles;
  std::filesystem::path particles_file;  ///< the CSV file; empty if there is none
  double end_time = 0;                   ///< time at which the run ends [T], > 0
  double frame_interval = 0;             ///< time between two outputs (frames) [T], > 0
  double average_from = 0;          ///< time at which means over time begin [T], >= 0, < end_time
  std::vector<std::string> tables;  ///< names of tables that the case asks for, of kAskedTables
                                    ///< (io/contact_file.hpp)
  /// What [arrangement] asks for; nothing if the case has no such section.
  std::optional<Arrangement> arrangement;
  /// What the section [sweep] asks for; nothing if the case has no such section.
  std::optional<case_file::SweepRequest> sweep;
};

/// Reads and checks a case file. Throws Error(kBadInput) if the file cannot be read or is no TOML,
/// or, with the file, the line, the key, its value and what is allowed, for a wrong key. Also
/// throws if there is neither a particle nor a source; if, at the start, two particles overlap or a
/// particle is on the wrong side of a plane by more than solver.tolerance mean radii; if a radius
/// is less than a hundred times that length; if a coordinate exceeds largest_resolved_distance() in
/// magnitude; or if a particle is outside the domain or touches its own periodic image. A case with
/// a fluid has further conditions (check_fluid_start() in particles_sections.hpp).
ParticlesCase read_particles_case(const std::filesystem::path& path);

/// Reads a case from the root table of its file (case_file/case_template.hpp). Throws as
/// read_particles_case().
void read_root(const case_file::TomlSection& root, ParticlesCase& c);

/// What docs/case-file.md says about the keys of each section.
std::vector<case_file::KeyTable> tables_of_particles_case();

/// The text of the case file at `path` with the root table `root`, with absolute paths of the files
/// that it names, so that a file with this text may be in any folder. Cases that differ only in
/// comments and layout give equal texts. Throws Error(kBadInput) if fluid.solver is not a list of
/// texts.
std::string text_for_any_folder(const case_file::TomlSection& root,
                                const std::filesystem::path& path);

}  // namespace viscontact::particles
