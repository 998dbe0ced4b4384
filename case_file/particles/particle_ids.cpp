// Finds particles by their ids (particle_ids.hpp).
#include "viscontact/case_file/particles/particle_ids.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace viscontact::case_file {

ParticleIds::ParticleIds(const ParticlesCase& c) : case_(c) {
  for (std::size_t k = 0; k < c.particles.count(); ++k)
    places_.emplace(c.particles.id(k), static_cast<std::int32_t>(k));
}

std::int32_t ParticleIds::place(const TomlSection& section, std::string_view key, double id,
                                std::string_view verb) const {
  const bool whole = id == std::floor(id) && id <= std::numeric_limits<std::int32_t>::max();
  const auto found = whole ? places_.find(static_cast<std::int32_t>(id)) : places_.end();
  if (found == places_.end())
    section.fail(key, case_.particles.ids.empty()
                          ? fmt::format("{} {}, which is not the number of a particle; the "
                                        "particles are numbered from 0 to {}",
                                        verb, id, case_.particles.count() - 1)
                          : fmt::format("{} {}, which is not the id of a particle; {} gives the "
                                        "ids",
                                        verb, id, case_.particles_file.string()));
  return found->second;
}

std::vector<std::int32_t> ParticleIds::numbers(const TomlSection& section,
                                               std::string_view key) const {
  std::vector<std::int32_t> numbers;
  for (const double id : section.numbers(key, kNotNegative))
    numbers.push_back(place(section, key, id, "contains"));
  return numbers;
}

std::array<std::int32_t, 2> ParticleIds::pair(const TomlSection& section,
                                              std::string_view key) const {
  const auto found = numbers(section, key);
  if (found.size() != 2 || found[0] == found[1])
    section.fail(key, fmt::format("is {}; it must contain the ids of two different particles",
                                  section.shown(key)));
  return {found[0], found[1]};
}

std::int32_t ParticleIds::number(const TomlSection& section, std::string_view key) const {
  return place(section, key, section.number(key, kNotNegative), "is");
}

}  // namespace viscontact::case_file
