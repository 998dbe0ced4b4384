// Reads the case file of many particles (particles_case.hpp). Lengths, masses and times are in the
// units of the case. A change must keep the keys and their defaults, because users have written
// cases with them.
#include "viscontact/case_file/particles_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "viscontact/case_file/arrangement_section.hpp"
#include "viscontact/case_file/particles_start.hpp"
#include "viscontact/case_file/particles_template.hpp"
#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/particles/io/particle_file.hpp"

namespace viscontact::case_file {
namespace {

using particles::Particles;
using particles::PiecewiseConstant;
using particles::Vector;
using particles::operator*;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators

// Squares and cubes of numbers within these bounds, and of their inverses, are finite and not 0.
constexpr double kLargest = 1e100;
constexpr Allowed kModerate = {[](double v) { return std::abs(v) <= kLargest; },
                               "at most 1e100 in magnitude"};
constexpr Allowed kModeratelyPositive = {
    [](double v) { return v >= 1 / kLargest && v <= kLargest; }, "from 1e-100 to 1e100"};
constexpr Allowed kNotPositive = {[](double v) { return v <= 0; }, "<= 0"};
constexpr Allowed kTolerance = {[](double v) { return v >= 1e-12 && v <= 0.1; },
                                "between 1e-12 and 0.1"};

/// Reads an array with one number for each dimension.
Vector read_vector(const TomlSection& section, std::string_view key, int dimension) {
  const auto numbers = section.numbers(key, kModerate);
  if (numbers.size() != static_cast<std::size_t>(dimension))
    section.fail(
        key, fmt::format("contains {} numbers; it must contain {}, one for each dimension of space",
                         numbers.size(), dimension));
  return {numbers[0], numbers[1], dimension == 3 ? numbers[2] : 0.0};
}

/// Reads a constant vector, or pieces { until, value } that must last until end_time [T].
PiecewiseConstant read_pieces(const TomlSection& section, std::string_view key, int dimension,
                              double end_time) {
  PiecewiseConstant function;
  if (!section.is_array_of_tables(key)) {
    if (section.has(key) && !section.is_array(key))
      section.fail(
          key, "is not a list; it must be a list of numbers, or a list of pieces { until, value }");
    function.pieces.push_back(
        {std::numeric_limits<double>::max(), read_vector(section, key, dimension)});
    return function;
  }
  double before = 0;
  for (const auto& piece : section.sections(key)) {
    const double until = piece.number("until", kPositive);
    if (!(until > before))
      piece.fail("until",
                 fmt::format("is {}; it must be greater than {}, where the piece before ends",
                             until, before));
    function.pieces.push_back({until, read_vector(piece, "value", dimension)});
    piece.finish();
    before = until;
  }
  if (before < end_time * (1 - 1e-9))
    section.fail(key, fmt::format("ends at {}; it must reach viscous_contact.end_time, {}", before,
                                  end_time));
  // The last piece is extended beyond end_time, because rounding errors could put the end of the
  // last time step after the end of this piece.
  function.pieces.back().until = std::max(before, std::nextafter(end_time * (1 + 1e-6), kLargest));
  return function;
}

void read_law(const TomlSection& section, particles::ContactLaw& law) {
  if (section.has("gamma_min")) law.gamma_min = section.number("gamma_min", kNotPositive);
  if (section.has("viscosity")) law.viscosity = section.number("viscosity", kModeratelyPositive);
  if (section.has("roughness")) law.roughness = section.number("roughness", kModeratelyPositive);
  if (law.gamma_min && law.viscosity)
    section.fail(
        "viscosity",
        "must be left out, because gamma_min is given and would also follow from viscosity");
  if (law.viscosity.has_value() != law.roughness.has_value())
    section.fail(
        law.viscosity ? "roughness" : "viscosity",
        fmt::format("is missing; a case with a {} needs both viscosity and roughness, from "
                    "which gamma_min follows",
                    law.viscosity ? "viscosity" : "roughness"));
}

particles::Plane read_plane(const TomlSection& section, int dimension, double end_time) {
  particles::Plane plane;
  plane.start.point = read_vector(section, "point", dimension);
  Vector normal = read_vector(section, "normal", dimension);
  const double length = particles::norm(normal);
  if (!(length > 1e-100))
    section.fail("normal", "is 0; it must be a vector that points into the free side of the plane");
  plane.start.normal = (1 / length) * normal;
  if (section.has("velocity"))
    plane.velocity = read_pieces(section, "velocity", dimension, end_time);
  if (section.has("angular_velocity"))
    plane.angular_velocity = dimension == 2
                                 ? Vector{0, 0, section.number("angular_velocity", kModerate)}
                                 : read_vector(section, "angular_velocity", dimension);
  else if (section.has("pivot"))
    section.fail("pivot", "must be left out, because this plane has no angular_velocity");
  plane.pivot = section.has("pivot") ? read_vector(section, "pivot", dimension) : plane.start.point;
  section.finish();
  return plane;
}

void add(Particles& p, const Vector& centre, const Vector& velocity, double radius, double mass) {
  for (int d = 0; d < p.dimension; ++d) {
    p.positions.push_back(centre[static_cast<std::size_t>(d)]);
    p.velocities.push_back(velocity[static_cast<std::size_t>(d)]);
  }
  p.radii.push_back(radius);
  p.masses.push_back(mass);
}

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

/// A map from the id of each particle to its index.
std::unordered_map<std::int32_t, std::int32_t> places_by_id(const Particles& p) {
  std::unordered_map<std::int32_t, std::int32_t> places;
  for (std::size_t k = 0; k < p.count(); ++k) places.emplace(p.id(k), static_cast<std::int32_t>(k));
  return places;
}

/// Reads [[force]]: the same force on all particles whose ids it names.
void read_forces_by_id(const TomlSection& root, int dimension, double end_time, ParticlesCase& c) {
  const auto places = places_by_id(c.particles);
  for (const auto& section : root.sections("force")) {
    const auto function = read_pieces(section, "value", dimension, end_time);
    for (const double id : section.numbers("particles", kNotNegative)) {
      const bool whole = id == std::floor(id) && id <= std::numeric_limits<std::int32_t>::max();
      const auto place = whole ? places.find(static_cast<std::int32_t>(id)) : places.end();
      if (place == places.end())
        section.fail("particles",
                     c.particles.ids.empty()
                         ? fmt::format("contains {}, which is not the number of a particle; the "
                                       "particles are numbered from 0 to {}",
                                       id, c.particles.count() - 1)
                         : fmt::format("contains {}, which is not the id of a particle; {} "
                                       "gives the ids",
                                       id, c.particles_file.string()));
      if (!c.setting.forces.emplace(place->second, function).second)
        section.fail(
            "particles",
            fmt::format("contains particle {} a second time; each particle must have one force",
                        id));
    }
    section.finish();
  }
}

/// Reads the key `method`. Earlier versions offered three methods that solve the same problem. A
/// case that names one of the other two is still accepted, and the present method is used.
void read_method(const TomlSection& solver) {
  constexpr std::array kMethods = {"conjugate_gradients", "accelerated_gradient", "gauss_seidel"};
  const auto text = solver.text("method");
  if (std::ranges::find(kMethods, text) == kMethods.end())
    solver.fail("method",
                fmt::format("is '{}'; it must be \"conjugate_gradients\", the only method", text));
}

void read_contact(const TomlSection& contact, ParticlesCase& c) {
  c.end_time = contact.number("end_time", kModeratelyPositive);
  c.setting.time_step = contact.number("time_step", kModeratelyPositive);
  if (c.setting.time_step > c.end_time)
    contact.fail("time_step", fmt::format("is {}; it must be at most end_time, {}",
                                          c.setting.time_step, c.end_time));
  if (constexpr double kMostSteps = 1e9; c.end_time / c.setting.time_step > kMostSteps)
    contact.fail(
        "time_step",
        fmt::format("is {}, which makes {:.3g} steps to end_time; at most {:.0e} are allowed",
                    c.setting.time_step, c.end_time / c.setting.time_step, kMostSteps));
  read_law(contact, c.setting.law);
  contact.finish();
}

void read_solver(const TomlSection& solver, particles::SolverSettings& settings) {
  if (solver.has("tolerance")) settings.tolerance = solver.number("tolerance", kTolerance);
  if (solver.has("impulse_tolerance"))
    settings.impulse_tolerance = solver.number("impulse_tolerance", kTolerance);
  if (solver.has("max_iterations"))
    settings.max_iterations = solver.count("max_iterations", 1, std::numeric_limits<int>::max());
  if (solver.has("method")) read_method(solver);
  solver.finish();
}

/// Reads the particles of the CSV file and of the tables [[particle]]. Returns the line number of
/// each particle of the CSV file.
std::vector<int> read_particles(const TomlSection& root, ParticlesCase& c) {
  const int dimension = c.particles.dimension;
  std::vector<int> lines;
  if (root.has("particles")) {
    const auto section = root.section("particles");
    c.particles_file = c.path.parent_path() / section.text("file");
    section.finish();
    auto file = particles::read_particles(c.particles_file, dimension);
    c.particles = std::move(file.particles);
    lines = std::move(file.lines);
  }
  if (root.has("particle"))
    for (const auto& section : root.sections("particle")) {
      if (section.has("force"))
        c.setting.forces[static_cast<std::int32_t>(c.particles.count())] =
            read_pieces(section, "force", dimension, c.end_time);
      add(c.particles, read_vector(section, "centre", dimension),
          section.has("velocity") ? read_vector(section, "velocity", dimension) : Vector{},
          section.number("radius", kModeratelyPositive),
          section.number("mass", kModeratelyPositive));
      if (!c.particles.ids.empty()) add_id(c.particles, section);
      section.finish();
    }
  if (root.has("arrangement"))
    c.arrangement = read_arrangement(root.section("arrangement"), c.setting.domain,
                                     c.setting.fluid.has_value(), c.particles);
  if (c.particles.count() == 0 && !c.particles_file.empty())
    throw_bad_input({c.particles_file.string()},
                    "has no particle; it must have a row for each particle after the header line");
  if (c.particles.count() == 0)
    throw_bad_input({c.path.string()},
                    "has no particle; name a file in [particles], or add a [[particle]] or an "
                    "[arrangement]");
  return lines;
}

}  // namespace

ParticlesCase read_particles_case(const std::filesystem::path& path) {
  std::string text = read_file(path);
  const auto root = TomlSection::parse(text, path.string());
  return read_particles_case(root, std::move(text), path);
}

ParticlesCase read_particles_case(const TomlSection& root, std::string text,
                                  const std::filesystem::path& path) {
  ParticlesCase c;
  c.path = path;
  c.text = std::move(text);
  c.title = root.text("title");

  const auto space = root.section("space");
  const int dimension = space.count("dimension", 2, 3);
  c.particles.dimension = dimension;
  if (space.has("gravity")) c.setting.gravity = read_vector(space, "gravity", dimension);
  space.finish();

  read_contact(root.section("viscous_contact"), c);
  if (root.has("solver")) read_solver(root.section("solver"), c.setting.solver);
  c.frame_interval = c.end_time / 100;
  if (root.has("output")) {
    const auto output = root.section("output");
    if (output.has("every")) c.frame_interval = output.number("every", kModeratelyPositive);
    output.finish();
  }
  if (root.has("plane"))
    for (const auto& section : root.sections("plane"))
      c.setting.planes.push_back(read_plane(section, dimension, c.end_time));

  const auto lines = read_particles(root, c);
  if (root.has("force")) read_forces_by_id(root, dimension, c.end_time, c);
  if (root.has("sweep")) c.sweep = read_particles_sweep(root.section("sweep"));
  root.finish();
  check_start(c, lines);
  return c;
}

}  // namespace viscontact::case_file
