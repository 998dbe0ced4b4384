// A check of the state at the start of a case of many particles, and the gaps in it. Lengths are in
// the unit of the case.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "viscontact/case_file/particles/particles_case.hpp"
#include "viscontact/common/error.hpp"

namespace viscontact::case_file {

/// Lines in which the particles are given, for messages.
struct ParticleLines {
  std::vector<int> in_file;  ///< of the particles of the CSV file, which are the first ones
  std::vector<int> in_case;  ///< of the tables [[particle]], whose particles are the next ones
};

/// Describes a particle in a message, and says in which file and line it is given.
class ParticleNames {
 public:
  /// Both arguments must outlive the object.
  ParticleNames(const ParticlesCase& c, const ParticleLines& lines) : case_(c), lines_(lines) {}
  /// Describes particle `k` (from 0) by its id, centre and radius, such as "particle 3 (centre 0,
  /// 1, radius 0.5)".
  std::string operator()(std::size_t k) const;
  /// The file and the line in which particle `k` (from 0) is given; line 0 if it has no line of its
  /// own.
  FilePosition at(std::size_t k) const;

 private:
  const ParticlesCase& case_;
  const ParticleLines& lines_;
};

/// A gap at the start between two particles, or an obstacle and a particle.
struct StartGap {
  std::int32_t first;   ///< number of a particle, or -1 - k for obstacle k
  std::int32_t second;  ///< number of a particle
  double gap;           ///< [L], < 0 if they overlap
};

/// All gaps at the start that are smaller than `limit` >= 0 [L], also across periods. The gap
/// between a sphere on an axis and the side of its cylinder, which never changes, is left out. No
/// particle may be close to an image of itself: the largest diameter plus `limit` must be less than
/// each period.
std::vector<StartGap> gaps_at_start(const ParticlesCase& c, double limit);

/// Name of obstacle k in a message, for example "the left side of the box" or "plane 2".
std::string obstacle_name(const ParticlesCase& c, std::size_t k);

/// Throws the Error(kBadInput) of read_particles_case() if the solver cannot begin with this state:
/// particles outside the domain, overlaps, particles behind a plane or too far away, and radii that
/// are too small, or too large for the periods of the domain.
void check_start(const ParticlesCase& c, const ParticleLines& lines);

}  // namespace viscontact::case_file
