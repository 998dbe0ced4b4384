// Reads the particles of a case (particle_tables.hpp). Lengths, masses and times are in the units
// of the case. A change must keep the keys and their defaults, because users have written cases
// with them.
#include "viscontact/case_file/particles/particle_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "viscontact/case_file/particles/arrangement_section.hpp"
#include "viscontact/case_file/particles/particle_ids.hpp"
#include "viscontact/case_file/vector_values.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/particles/io/particle_file.hpp"

namespace viscontact::case_file {
namespace {

using particles::Particles;
using particles::Vector;

constexpr Allowed kMassWithoutFluid = {
    [](double v) { return v >= 1 / kLargestNumber && v <= kLargestNumber; },
    "from 1e-100 to 1e100 (0 is allowed only in a case with [fluid])"};

/// Gives an id to a particle of a table [[particle]]: the largest id so far plus 1. Called only if
/// the CSV file gives ids.
void add_id(Particles& p, const TomlSection& section) {
  const auto largest = std::ranges::max(p.ids);
  if (largest == std::numeric_limits<std::int32_t>::max())
    section.fail("centre", fmt::format("belongs to a particle that cannot get an id: it would be "
                                       "the largest id so far plus 1, but {} is the largest id "
                                       "that is possible",
                                       largest));
  p.ids.push_back(largest + 1);
}

/// Throws an error for keys of a table [[particle]] that this case cannot have.
void check_keys(const TomlSection& section, int dimension, bool in_fluid) {
  if (section.has("semi_axes"))
    section.fail("semi_axes",
                 "is not possible yet, because ellipses are for a later version; the "
                 "particle must be a disc with a radius");
  for (const auto* key : {"fixed", "velocity_given"})
    if (section.has(key) && !in_fluid)
      section.fail(key, "belongs to a particle in a fluid; the case has no section [fluid]");
  for (const auto* key : {"torque", "angle", "angular_velocity", "moment_of_inertia"}) {
    if (!section.has(key)) continue;
    if (dimension == 1)
      section.fail(key, "must be left out, because a sphere on the axis does not turn");
    if (dimension == 3 && std::string_view(key) == "angle")
      section.fail(key, "must be left out, because the orientation of a sphere changes nothing");
  }
}

/// Reads the rotation of the last particle of a case without a fluid. Particles begin to turn with
/// the first table that has a key of rotation; the particles before it have the defaults.
void read_rotation(const TomlSection& section, Particles& p) {
  const auto given = {"torque", "angle", "angular_velocity", "moment_of_inertia"};
  if (!p.turn() && std::ranges::none_of(given, [&](auto* key) { return section.has(key); })) return;
  particles::add_rotation(p);
  const std::size_t k = p.count() - 1;
  if (section.has("angle")) p.angles[k] = section.number("angle", kModerate);
  if (section.has("moment_of_inertia"))
    p.inertias[k] = section.number("moment_of_inertia", kModeratelyPositive);
  if (!section.has("angular_velocity")) return;
  if (p.dimension == 2) {
    p.angular_velocities[k] = section.number("angular_velocity", kModerate);
    return;
  }
  const auto velocity = read_vector(section, "angular_velocity", p.dimension);
  for (std::size_t d = 0; d < 3; ++d) p.angular_velocities[3 * k + d] = velocity[d];
}

/// Reads `fixed` and `velocity_given`. Returns the key that gives the motion of the particle, or
/// nullptr if the particle moves freely.
const char* read_given_motion(const TomlSection& section, int dimension, double end_time,
                              particles::GivenMotion& motion) {
  const bool fixed = section.has("fixed") && section.truth("fixed");
  if (!section.has("velocity_given")) return fixed ? "fixed" : nullptr;
  if (fixed)
    section.fail("velocity_given",
                 "must be left out, because fixed = true already says how this particle moves");
  const auto given = section.section("velocity_given");
  motion.velocity = read_pieces(given, "value", dimension, end_time);
  if (given.has("angular_velocity")) {
    if (dimension == 1)
      given.fail("angular_velocity",
                 "must be left out, because a sphere on the axis does not turn");
    motion.angular_velocity = read_pieces_of_numbers(given, "angular_velocity", end_time);
  }
  given.finish();
  return "velocity_given";
}

/// Value of a function at time 0.
Vector at_start(const particles::PiecewiseConstant& function) {
  return function.pieces.empty() ? Vector{} : function.pieces.front().value;
}

/// Reads force, torque and given motion of the particle with number `k`. Returns its velocity at
/// the start: (vx, vy, angular velocity) in a fluid in the plane, else the velocity alone.
std::pair<Vector, double> read_motion_of_particle(const TomlSection& section, std::int32_t k,
                                                  ParticlesCase& c) {
  const int dimension = c.particles.dimension;
  particles::GivenMotion motion;
  if (const char* given = read_given_motion(section, dimension, c.end_time, motion)) {
    for (const auto* key : {"force", "torque", "velocity", "angular_velocity"})
      if (section.has(key))
        section.fail(key, fmt::format("has no effect, because {} gives the motion of this "
                                      "particle; one of them must be left out",
                                      given));
    c.setting.given_motions[k] = motion;
    return {at_start(motion.velocity), at_start(motion.angular_velocity)[2]};
  }
  if (section.has("force"))
    c.setting.forces[k] = read_pieces(section, "force", dimension, c.end_time);
  if (section.has("torque"))
    c.setting.torques[k] = dimension == 3 ? read_pieces(section, "torque", dimension, c.end_time)
                                          : read_pieces_of_numbers(section, "torque", c.end_time);
  return {section.has("velocity") ? read_vector(section, "velocity", dimension) : Vector{},
          c.setting.fluid && section.has("angular_velocity")
              ? section.number("angular_velocity", kModerate)
              : 0.0};
}

/// Reads a table [[particle]].
void read_particle(const TomlSection& section, ParticlesCase& c) {
  auto& p = c.particles;
  const bool in_fluid = c.setting.fluid.has_value();
  check_keys(section, p.dimension, in_fluid);
  const auto [velocity, angular_velocity] =
      read_motion_of_particle(section, static_cast<std::int32_t>(p.count()), c);
  const auto centre = read_vector(section, "centre", p.dimension);
  const double radius = section.number("radius", kModeratelyPositive);
  double mass = 0;
  if (!in_fluid)
    mass = section.number("mass", kMassWithoutFluid);
  else if (section.has("mass"))
    mass = section.number("mass", kModeratelyPositiveOr0);
  for (std::size_t d = 0; d < static_cast<std::size_t>(p.dimension); ++d) {
    p.positions.push_back(centre[d]);
    p.velocities.push_back(velocity[d]);
  }
  p.radii.push_back(radius);
  p.masses.push_back(mass);
  if (in_fluid && p.dimension == 2) {
    p.angles.push_back(section.has("angle") ? section.number("angle", kModerate) : 0.0);
    p.angular_velocities.push_back(angular_velocity);
    p.inertias.push_back(section.has("moment_of_inertia")
                             ? section.number("moment_of_inertia", kModeratelyPositiveOr0)
                             : particles::homogeneous_inertia(2, mass, radius));
  } else if (!in_fluid) {
    read_rotation(section, p);
  }
  if (!p.ids.empty()) add_id(p, section);
  section.finish();
}

/// Reads the CSV file that [particles] names.
void read_file_of_particles(const TomlSection& section, ParticlesCase& c, ParticleLines& lines) {
  c.particles_file = c.path.parent_path() / section.text("file");
  section.finish();
  const bool in_fluid = c.setting.fluid.has_value();
  auto file = particles::read_particles(c.particles_file, c.particles.dimension, in_fluid);
  c.particles = std::move(file.particles);
  lines.in_file = std::move(file.lines);
  auto& p = c.particles;
  if (in_fluid && p.dimension == 2)
    for (std::size_t k = 0; k < p.count(); ++k)
      p.inertias.push_back(particles::homogeneous_inertia(2, p.masses[k], p.radii[k]));
  if (!in_fluid && p.turn()) particles::add_rotation(p);
}

}  // namespace

ParticleLines read_particles_of_case(const TomlSection& root, ParticlesCase& c) {
  ParticleLines lines;
  if (root.has("particles")) read_file_of_particles(root.section("particles"), c, lines);
  if (root.has("particle"))
    for (const auto& section : root.sections("particle")) {
      read_particle(section, c);
      lines.in_case.push_back(section.line());
    }
  if (root.has("arrangement"))
    c.arrangement = read_arrangement(root.section("arrangement"), c.setting.domain,
                                     c.setting.fluid.has_value(), c.particles);
  if (!c.setting.fluid && (c.setting.laws.friction || c.particles.turn()))
    particles::add_rotation(c.particles);
  if (c.particles.count() == 0 && !c.particles_file.empty())
    throw_bad_input({c.particles_file.string()},
                    "has no particle; it must have a row for each particle after the header line");
  if (c.particles.count() == 0)
    throw_bad_input({c.path.string()},
                    "has no particle; name a file in [particles], or add a [[particle]] or an "
                    "[arrangement]");
  return lines;
}

void read_forces_by_id(const TomlSection& root, ParticlesCase& c) {
  if (!root.has("force")) return;
  const ParticleIds ids(c);
  for (const auto& section : root.sections("force")) {
    const auto function = read_pieces(section, "value", c.particles.dimension, c.end_time);
    for (const auto particle : ids.numbers(section, "particles")) {
      const auto id = c.particles.id(particles::index_of(particle));
      if (c.setting.given_motions.contains(particle))
        section.fail("particles", fmt::format("contains particle {}, whose motion is given, so "
                                              "that a force has no effect; it must be left out",
                                              id));
      if (!c.setting.forces.emplace(particle, function).second)
        section.fail(
            "particles",
            fmt::format("contains particle {} a second time; each particle must have one force",
                        id));
    }
    section.finish();
  }
}

}  // namespace viscontact::case_file
