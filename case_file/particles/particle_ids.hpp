// The particles that a table of a case names by their ids.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "viscontact/case_file/particles/particles_case.hpp"
#include "viscontact/case_file/toml_section.hpp"

namespace viscontact::case_file {

/// Finds the numbers of particles, which count from 0 in the order of ParticlesCase::particles, by
/// the ids that users gave them.
class ParticleIds {
 public:
  /// `c` must outlive this object, and its particles must have been read.
  explicit ParticleIds(const ParticlesCase& c);

  /// The numbers of the particles whose ids are in the list at `key`. Throws Error(kBadInput) for an
  /// id that does not exist.
  std::vector<std::int32_t> numbers(const TomlSection& section, std::string_view key) const;

  /// The same for a list of two different ids.
  std::array<std::int32_t, 2> pair(const TomlSection& section, std::string_view key) const;

  /// The number of the particle whose id is the value of `key`.
  std::int32_t number(const TomlSection& section, std::string_view key) const;

 private:
  std::int32_t place(const TomlSection& section, std::string_view key, double id,
                     std::string_view verb) const;

  const ParticlesCase& case_;
  std::unordered_map<std::int32_t, std::int32_t> places_;  // number of each id
};

}  // namespace viscontact::case_file
