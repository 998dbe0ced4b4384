// A case of many particles that is read once, and from which many cases with other numbers are
// made, for a sweep.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include "viscontact/case_file/particles/particles_case.hpp"
#include "viscontact/case_file/toml_section.hpp"

namespace viscontact::case_file {

/// True if the file is a case of many particles and not of one sphere: it has the section [space].
/// Throws Error(kBadInput) if it cannot be read or is not valid TOML.
bool is_particles_case(const std::filesystem::path& path);

/// Reads the section [sweep] of a case of many particles.
ParticlesSweepRequest read_particles_sweep(const TomlSection& section);

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
