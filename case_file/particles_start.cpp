// Checks the state at the start of a case of many particles (particles_start.hpp). Lengths are in
// the unit of the case. Messages must name the line of the CSV file, because it can be long.
#include "viscontact/case_file/particles_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "viscontact/common/error.hpp"
#include "viscontact/particles/neighbours/close_pairs.hpp"

namespace viscontact::case_file {

using particles::operator-;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators

namespace {

/// Describes a particle in a message, and says in which file and line it is given.
class ParticleNames {
 public:
  ParticleNames(const ParticlesCase& c, const std::vector<int>& lines) : case_(c), lines_(lines) {}
  std::string operator()(std::size_t k) const {
    const auto x = case_.particles.position(k);
    const auto place = case_.particles.dimension == 2 ? fmt::format("{}, {}", x[0], x[1])
                                                      : fmt::format("{}, {}, {}", x[0], x[1], x[2]);
    return fmt::format("particle {} ({}centre {}, radius {})", case_.particles.id(k),
                       k < lines_.size() ? fmt::format("line {}, ", lines_[k]) : "", place,
                       case_.particles.radii[k]);
  }
  FilePosition at(std::size_t k) const {
    return k < lines_.size() ? FilePosition{case_.particles_file.string(), lines_[k]}
                             : FilePosition{case_.path.string()};
  }

 private:
  const ParticlesCase& case_;
  const std::vector<int>& lines_;
};

}  // namespace

void check_start(const ParticlesCase& c, const std::vector<int>& lines) {
  const ParticleNames names(c, lines);
  const auto& p = c.particles;
  const double tolerance = c.setting.solver.tolerance;
  const double allowed = tolerance * particles::mean_radius(p);
  const auto smallest =
      static_cast<std::size_t>(std::ranges::min_element(p.radii) - p.radii.begin());
  if (constexpr double kOfRadius = 0.01; allowed > kOfRadius * p.radii[smallest])
    throw_bad_input(names.at(smallest),
                    fmt::format("{} is too small for solver.tolerance, {}: the tolerance times "
                                "the mean radius is {:.3g}; it must be at most a hundredth of each "
                                "radius",
                                names(smallest), tolerance, allowed));
  const double farthest =
      particles::largest_resolved_distance(tolerance, particles::mean_radius(p));
  for (std::size_t k = 0; k < p.count(); ++k)
    for (const double x : p.position(k))
      if (std::abs(x) > farthest)
        throw_bad_input(names.at(k),
                        fmt::format("{} is too far from the origin for its gaps to be known to "
                                    "solver.tolerance; each coordinate must be at most {:.3g} in "
                                    "magnitude",
                                    names(k), farthest));
  ThreadPool pool(1);
  for (const auto& [first, second] :
       particles::close_pairs(p.dimension, p.positions, p.radii, pool)) {
    const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
    const double overlap = p.radii[i] + p.radii[j] - particles::norm(p.position(j) - p.position(i));
    if (overlap > allowed)
      throw_bad_input(
          names.at(j),
          fmt::format("{} and {} overlap by {:.3g} at the start; at most {:.3g} is allowed",
                      names(i), names(j), overlap, allowed));
  }
  for (std::size_t w = 0; w < c.setting.planes.size(); ++w) {
    const auto place = c.setting.planes[w].at(0);
    for (std::size_t k = 0; k < p.count(); ++k)
      if (const double gap = particles::gap(place, p.position(k), p.radii[k]); gap < -allowed)
        throw_bad_input(
            names.at(k),
            fmt::format("{} is {:.3g} into plane {} at the start, or behind it; a plane's "
                        "normal must point into the free side",
                        names(k), -gap, w + 1));
  }
}

}  // namespace viscontact::case_file
