// The case file of many particles (docs/case-file.md, "Many particles"). Lengths, masses and times
// are in any one consistent system of units.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/case_file/keys.hpp"
#include "viscontact/particles/arrangement/arrangement.hpp"
#include "viscontact/particles/simulation.hpp"

namespace viscontact::case_file {

/// What `viscontact sweep` varies in a case of particles. Options on its command line replace these
/// values.
struct ParticlesSweepRequest {
  std::vector<std::string> vary;  ///< "KEY=RANGE" each, as on the command line; may be empty
  std::uint64_t samples = 0;      ///< number of random samples; 0: the whole grid
  std::uint64_t draws = 0;        ///< number of arrangements at each point; 0: that of the case
};

/// Content of a case file of many particles.
struct ParticlesCase {
  std::filesystem::path path;  ///< the case file
  std::string text;            ///< content of the file
  std::string title;           ///< a title for pages and pictures
  /// Everything that the simulation needs besides the particles.
  particles::Setting setting;
  /// The particles of the CSV file, followed by those of the tables [[particle]] and by the random
  /// discs of [arrangement].
  particles::Particles particles;
  std::filesystem::path particles_file;  ///< the CSV file; empty if there is none
  double end_time = 0;                   ///< [T], > 0
  double frame_interval = 0;             ///< [T], > 0
  /// What [arrangement] asks for; its discs are the last particles.
  std::optional<particles::Arrangement> arrangement;
  /// What the section [sweep] asks for; nothing if the case has no such section.
  std::optional<ParticlesSweepRequest> sweep;
};

/// Reads and checks a case file. Throws Error(kBadInput) with the file, the line, the key, its
/// value and what is allowed. Also throws if there is no particle; if, at the start, two particles
/// overlap or a particle is on the wrong side of a plane by more than solver.tolerance mean radii;
/// if a radius is less than a hundred times that length; if a particle is further from the origin
/// than particles::largest_resolved_distance; or if a particle is outside the domain or touches its
/// own image in a periodic one. A case with a fluid has further conditions (check_fluid_start() in
/// particles_sections.hpp).
ParticlesCase read_particles_case(const std::filesystem::path& path);

/// The same for a file that is already parsed: `root` is its root table and `text` its content.
ParticlesCase read_particles_case(const TomlSection& root, std::string text,
                                  const std::filesystem::path& path);

/// What docs/case-file.md says about the keys of each section.
std::vector<KeyTable> tables_of_particles_case();

/// A case file of many particles that was read, and the cases that differ from it in some numbers.
class ParticlesCaseTemplate {
 public:
  /// Reads and parses the file. Throws Error(kBadInput) if it cannot be read or is not valid TOML.
  explicit ParticlesCaseTemplate(const std::filesystem::path& path);

  const std::string& text() const { return text_; }  ///< content of the file

  /// The case with these numbers at these keys, such as "arrangement.seed" or
  /// "particle[0].centre[1]". Throws the errors of read_particles_case, and Error(kBadInput) for a
  /// key that the case cannot have.
  ParticlesCase with(std::span<const std::pair<std::string, double>> numbers) const;

  /// The text of a case file with these numbers, which may be in any folder, because the files that
  /// it names have absolute paths. Equal cases give equal texts, whatever their comments are.
  /// Throws Error(kBadInput) for a key that the case cannot have.
  std::string text_with(std::span<const std::pair<std::string, double>> numbers) const;

 private:
  std::filesystem::path path_;
  std::string text_;
  TomlSection root_;
};

}  // namespace viscontact::case_file
