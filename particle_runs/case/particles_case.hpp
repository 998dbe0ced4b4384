// The case file of many particles, a TOML file of the user (docs/case-file.md, "Many particles").
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/arrangement/arrangement.hpp"
#include "viscontact/case_file/case_template.hpp"
#include "viscontact/case_file/keys.hpp"
#include "viscontact/particles/setting/setting.hpp"

namespace viscontact::particles {

/// Content of a case file, in any one consistent system of units.
struct ParticlesCase {
  std::filesystem::path path;
  std::string text;   ///< content of the file
  std::string title;  ///< for pages and pictures; may be empty
  Units units{};      ///< for pages and pictures; may be empty
  /// Domain, fluid, laws of contact, planes, links, given motions, sources, gravity, step and
  /// solver.
  Setting setting;
  /// The particles at time 0: those of the CSV file, of the tables [[particle]], of [arrangement]
  /// and of [[membrane]], in this order. Their dimension is 1 (spheres on an axis), 2 or 3.
  Particles particles;
  std::filesystem::path particles_file;          ///< the CSV file; empty if there is none
  std::vector<std::filesystem::path> fit_files;  ///< of lubrication.fits
  /// Time at which the run ends [T], 1e-100 to 1e100. With lubrication it may be 0: no step is
  /// made, and the velocities are those at the start.
  double end_time = 0;
  double frame_interval = 0;  ///< time between outputs (frames) [T], 1e-100 to 1e100
  /// Time at which means over time begin [T], >= 0, < end_time unless that is 0.
  double average_from = 0;
  bool average_from_given = false;  ///< true: the case has the key average_from
  std::vector<std::string> tables;  ///< names of tables that the case asks for, of kAskedTables
                                    ///< (particle_runs/io/contact_file.hpp)
  std::vector<std::string>
      step_columns;                   ///< names of further columns of steps.csv, of kStepColumns
  std::vector<std::string> warnings;  ///< what the user should know of the case, in sentences
  /// Whether the run of a case with lubrication is compared with one of contact alone.
  bool compares = false;
  /// rho_f [M/L^3] of a fluid without inertia, for the Reynolds number only; 0: not known.
  double fluid_density = 0;
  /// Without a value if the case has no such section.
  std::optional<Arrangement> arrangement;
  /// Without a value if the case has no such section.
  std::optional<case_file::SweepRequest> sweep;
};

/// The files that the case names: of particles and of fits.
std::vector<std::filesystem::path> files_of(const ParticlesCase& c);

/// The columns that steps.csv has on request: the stages of the contact solver with their
/// iterations, StepReport::solver_stages.
inline constexpr auto kStepColumns = std::to_array<std::string_view>({"solver_stages"});

/// Reads and checks a case file. Throws Error(kBadInput), with the file, the line, the key, its
/// value and what is allowed, if the file cannot be read, is not TOML or has a wrong key. It also
/// throws if there is neither a particle nor a source, or if the particles cannot be there at the
/// start: with the tolerance of gaps, `solver.tolerance` times the mean radius, two particles must
/// not overlap, and no particle may reach behind a plane or a wall, by more than this tolerance;
/// each radius must be at least a hundred times the tolerance; each coordinate must be at most
/// largest_resolved_distance() (setting.hpp) in magnitude; and each centre must be in the domain,
/// with no particle touching its own periodic image. A case with a fluid has further conditions
/// (check_fluid_start() in particles_sections.hpp).
ParticlesCase read_particles_case(const std::filesystem::path& path);

/// Sets the film of viscous contact (5.2) in a case with pairs = "none": with a roughness,
/// gamma_min is the impulse of the film from the effective radius, where it begins without a fluid,
/// too, to the roughness times the mean radius of all particles, of which there must be one.
/// Without a roughness the film has no end.
void set_film_of_pairs(ParticlesCase& c);

/// Reads a case into `c` from the root table of its file; c.path must have been set. Throws the
/// errors of read_particles_case().
void read_root(const case_file::TomlSection& root, ParticlesCase& c);

/// The tables of docs/case-file.md, which describe the keys of each section.
std::vector<case_file::KeyTable> tables_of_particles_case();

/// The text of a case file with the contents of the root table `root`, which was read from the case
/// file at `path`. The files that it names have absolute paths, so that a file with this text may
/// be in any folder. Cases that differ only in comments and layout give equal texts. Throws
/// Error(kBadInput) if fluid.solver is not a list of texts.
std::string text_for_any_folder(const case_file::TomlSection& root,
                                const std::filesystem::path& path);

}  // namespace viscontact::particles
