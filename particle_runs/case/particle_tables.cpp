// Reads [particles] (a CSV file), [[particle]] and [[force]].
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/particle_runs/case/particles_sections.hpp"
#include "viscontact/particle_runs/io/particle_file.hpp"
#include "viscontact/particles/shapes/shape_rule.hpp"

namespace viscontact::particles {
namespace {

constexpr Allowed kMassWithoutFluid = {
    [](double v) { return v >= 1 / kLargestNumber && v <= kLargestNumber; },
    "from 1e-100 to 1e100 (0 is allowed only in a case with [fluid], with [lubrication] without "
    "inertia, or with a given motion)"};
constexpr std::array kKeysOfRotation = {"torque", "angle", "angular_velocity", "moment_of_inertia"};

/// The rules of shapes with a key, in the order in which the keys are read: first those that stand
/// in place of the radius.
std::vector<const ShapeRule*> shape_rules_of_keys() {
  std::vector<const ShapeRule*> rules;
  for (const bool needs_radius : {false, true})
    for (const auto* rule : kShapeRules)
      if (!rule->key.name.empty() && rule->key.needs_radius == needs_radius) rules.push_back(rule);
  return rules;
}

/// Throws Error(kBadInput) for keys of a table [[particle]] that are not allowed in this case, or
/// beside each other.
void check_keys(const case_file::TomlSection& section, const ParticlesCase& c) {
  const int dimension = c.particles.dimension;
  const bool rebounds = !c.setting.fluid && c.setting.laws.restitution.is_on();
  const ShapeKey* given = nullptr;  // the first key of a shape that the table has
  for (const auto* rule : shape_rules_of_keys()) {
    const auto& key = rule->key;
    if (!section.has(key.name)) continue;
    section.require(dimension == 2, key.name,
                    "makes this particle a shape, '{}', which is possible in the plane; this "
                    "particle must have a radius alone",
                    rule->name);
    section.require(!rebounds, key.name,
                    "makes this particle a shape, '{}', beside viscous_contact.restitution: "
                    "without a fluid only discs rebound; restitution must be left out, or this "
                    "particle must have a radius alone",
                    rule->name);
    section.require(given == nullptr, key.name,
                    "must be left out, because {} gives this particle its shape",
                    given == nullptr ? "" : given->name);
    section.require(key.needs_radius || !section.has("radius"), "radius",
                    "must be left out, because {} gives this particle its shape, '{}'", key.name,
                    rule->name);
    given = &key;
  }
  for (const auto* key : kKeysOfRotation)
    section.require(dimension != 1 || !section.has(key), key,
                    "must be left out, because a sphere on the axis does not turn");
  const auto& pairs = c.setting.lubrication;
  for (const auto* key : {"fixed", "velocity_given"})
    section.require(!pairs || !section.has(key), key,
                    "gives the motion of this particle, and a case with [lubrication] computes the "
                    "motion of all; the key must be left out");
  for (const auto* key : {"velocity", "angular_velocity", "moment_of_inertia"})
    section.require(!pairs || pairs->inertia || !section.has(key), key,
                    "has no effect, because lubrication.inertia is false; it must be left out, or "
                    "inertia be true");
  section.require(dimension != 3 || !section.has("angle"), "angle",
                  "must be left out, because the orientation of a sphere changes nothing");
}

/// Keys of the motion of a driven particle, which must be given up to `end_time` [T].
void given_motion_keys(case_file::Keys& keys, GivenMotion& motion, int dimension, double end_time) {
  keys.required("value", pieces(motion.velocity, dimension, end_time),
                {"velocity of a particle that is driven"});
  keys.require(dimension != 1 || !keys.has("angular_velocity"), "angular_velocity",
               "must be left out, because a sphere on the axis does not turn");
  keys.optional("angular_velocity", pieces_of_turn(motion.angular_velocity, dimension, end_time),
                {"counter-clockwise", "0"});
}

/// Angles are in radians.
struct ParticleTable {
  // At time 0: [L], [L/T], [1/T].
  Vector centre{}, velocity{}, angular_velocity{};
  // [L], [M], [rad]. The radius is that of discs and spheres, or of round parts of other shapes.
  double radius = 0, mass = 0, angle = 0;
  std::optional<double> moment_of_inertia;
  std::optional<Shape> shape;  // one that is not given by the radius alone
  Shape shape_in(int dimension) const {
    if (shape) return *shape;
    return dimension == 2 ? Shape::disc(radius) : Shape::sphere(radius);
  }
  /// Moment of inertia about the centre [M L^2]: the one that is given, or else that of a
  /// homogeneous particle in the plane.
  double inertia_in_plane() const { return moment_of_inertia.value_or(shape_in(2).inertia(mass)); }
  PiecewiseConstant force, torque;  // [M L/T^2], [M L^2/T^2]; empty if they are not given
  bool is_fixed = false;
  std::optional<GivenMotion> given;  // how it is driven; a fixed particle has velocities 0
};

void read_given_motion(const case_file::TomlSection& section, std::string_view key,
                       ParticleTable& p, const ParticlesCase& c) {
  section.require(!p.is_fixed, key,
                  "must be left out, because fixed = true already says how this particle moves");
  case_file::read_keys(section.section(key), given_motion_keys, p.given.emplace(),
                       c.particles.dimension, c.end_time);
}

/// Keys of the mass, or of the density (mass over area or volume) in its place.
void read_mass(case_file::Keys& keys, ParticleTable& p, int dimension, bool in_fluid) {
  double density = 0;
  const bool has_density = keys.optional(
      "density", case_file::number(density, kModeratelyPositiveOr0),
      {"in place of `mass`: mass of the disc over its area, or of the sphere over its volume",
       "from `mass`"});
  const bool may_be_0 = in_fluid || p.given.has_value();
  keys.require(!has_density || density > 0 || may_be_0, "density",
               "is 0; a particle without a fluid must have a mass");
  keys.require(!has_density || !keys.has("mass"), "mass",
               "must be left out, because density gives the mass of this particle");
  if (has_density) p.mass = density * p.shape_in(dimension).measure();
  if (has_density && keys.reads()) return;
  keys.required_if(!may_be_0, "mass",
                   case_file::number(p.mass, may_be_0 ? kModeratelyPositiveOr0 : kMassWithoutFluid),
                   {"mass of the disc or sphere", "required; in a fluid, or with a given motion, 0",
                    "from 1e-100 to 1e100, in a fluid or with a given motion also 0"});
}

/// The numbers of the key of a shape [L], of which a single one is the first.
void read_shape_key(const case_file::TomlSection& section, std::string_view key, const ShapeKey& of,
                    Vector2& place) {
  if (!of.is_pair) {
    place[0] = section.number(key, kModeratelyPositive);
    return;
  }
  const auto numbers = section.numbers(key, kModeratelyPositive);
  section.require(numbers.size() == place.size(), key,
                  "contains {} numbers; it must contain 2 lengths", numbers.size());
  std::ranges::copy(numbers, place.begin());
}

/// Reads the keys of shapes that stand beside the radius, or of those in its place. Returns whether
/// one is there.
bool read_shape_keys(case_file::Keys& keys, bool beside_radius, ParticleTable& p) {
  bool any = false;
  for (std::size_t kind = 0; kind < kShapeRules.size(); ++kind) {
    const auto& key = kShapeRules[kind]->key;
    if (key.name.empty() || key.needs_radius != beside_radius) continue;
    Vector2 numbers{};
    const auto kind_of_value =
        key.is_pair ? case_file::custom("two lengths `[a, b]`", read_shape_key, key, numbers)
                    : case_file::number(numbers[0], kModeratelyPositive);
    if (!keys.optional(key.name, kind_of_value, {key.meaning, key.otherwise})) continue;
    any = true;
    if (!keys.reads()) continue;
    const Vector2 axes = key.semi_axes(numbers, p.radius);
    const double ratio =
        key.is_pair ? std::ranges::max(axes) / std::ranges::min(axes) : axes[0] / axes[1];
    keys.require(
        ratio >= key.least_ratio && ratio <= key.most_ratio, key.name,
        "gives the shape '{}' the half sizes {:.6g} and {:.6g} with the ratio {:.6g}; this "
        "ratio must be from {} to {}",
        kShapeRules[kind]->name, axes[0], axes[1], ratio, key.least_ratio, key.most_ratio);
    p.shape = Shape(static_cast<ShapeKind>(kind), axes);
  }
  return any;
}

void particle_keys(case_file::Keys& keys, ParticleTable& p, const ParticlesCase& c) {
  const int dimension = c.particles.dimension;
  const bool in_fluid = may_lack_mass(c.setting);
  const auto read_fixed = [&](const case_file::TomlSection& section, std::string_view key) {
    p.is_fixed = section.truth(key);
  };
  if (keys.reads()) check_keys(keys.section(), c);
  keys.optional("fixed", case_file::custom("`true` or `false`", read_fixed),
                {"whether the particle is at rest, whatever acts on it", "`false`"});
  keys.optional("velocity_given",
                case_file::custom("`{ value, angular_velocity }`", read_given_motion, p, c),
                {"how the particle is driven, whatever acts on it"});
  if (p.is_fixed) p.given.emplace();
  for (const auto* key : {"force", "torque", "velocity", "angular_velocity"})
    keys.require(
        !p.given || !keys.has(key), key,
        "has no effect, because {} gives the motion of this particle; one of them must be left out",
        p.is_fixed ? "fixed" : "velocity_given");
  keys.optional("force", pieces(p.force, dimension, c.end_time), {"is added to gravity", "0"});
  keys.optional("torque", pieces_of_turn(p.torque, dimension, c.end_time),
                {"in 2D counter-clockwise", "0"});
  keys.optional("velocity", vector(p.velocity, dimension),
                {"at time 0", "0, with `[lubrication]` that of the flow"});
  keys.optional("angular_velocity", turn(p.angular_velocity, dimension),
                {"at time 0, in 2D counter-clockwise", "0, with `[lubrication]` that of the flow"});
  keys.required("centre", vector(p.centre, dimension), {"at time 0"});
  const bool has_shape = read_shape_keys(keys, false, p);
  keys.required_if(
      !has_shape, "radius", case_file::number(p.radius, kModeratelyPositive),
      {"radius of the disc or sphere, or of the ends of a plate", "required without `semi_axes`"});
  read_shape_keys(keys, true, p);
  read_mass(keys, p, dimension, in_fluid);
  keys.optional("angle", case_file::number(p.angle, kModerate), {"at time 0, in 2D only"});
  keys.optional("moment_of_inertia",
                case_file::number(p.moment_of_inertia,
                                  in_fluid ? kModeratelyPositiveOr0 : kModeratelyPositive),
                {"about the centre", "mass r²/2 of a disc, 2 mass r²/5 of a sphere",
                 "from 1e-100 to 1e100, in a fluid also 0"});
}

/// Sets angle, angular velocity and moment of inertia of the last particle of a case without a
/// fluid. The first table with a shape or one of kKeysOfRotation makes all particles turn; those
/// before it get the defaults of add_rotation().
void add_rotation_of_last(const case_file::TomlSection& section, const ParticleTable& table,
                          Particles& p) {
  const bool is_turned =
      table.shape || (table.given && !table.given->angular_velocity.pieces.empty());
  if (!p.turn() && !is_turned &&
      std::ranges::none_of(kKeysOfRotation, [&](auto* key) { return section.has(key); }))
    return;
  add_rotation(p);
  const std::size_t k = p.count() - 1;
  if (p.dimension == 2) {
    p.angles[k] = table.angle;
    p.angular_velocities[k] = table.angular_velocity[2];
  } else {
    for (std::size_t d = 0; d < 3; ++d) p.angular_velocities[3 * k + d] = table.angular_velocity[d];
  }
  if (table.moment_of_inertia) p.inertias[k] = *table.moment_of_inertia;
}

/// The value at time 0; 0 without pieces.
Vector at_start(const PiecewiseConstant& function) {
  return function.pieces.empty() ? Vector{} : function.pieces.front().value;
}

void read_particle(const case_file::TomlSection& section, ParticlesCase& c, GivenAtStart& given) {
  auto& p = c.particles;
  const bool in_fluid = c.setting.fluid.has_value();
  require_ids(section, "centre", p, 1);
  ParticleTable table;
  case_file::read_keys(section, particle_keys, table, c);
  const auto number = static_cast<std::int32_t>(p.count());
  if (table.given) {
    table.velocity = at_start(table.given->velocity);
    table.angular_velocity = at_start(table.given->angular_velocity);
    c.setting.given_motions[number] = *table.given;
  }
  if (!table.force.pieces.empty()) c.setting.forces[number] = std::move(table.force);
  if (!table.torque.pieces.empty()) c.setting.torques[number] = std::move(table.torque);
  for (std::size_t d = 0; d < static_cast<std::size_t>(p.dimension); ++d) {
    p.positions.push_back(table.centre[d]);
    p.velocities.push_back(table.velocity[d]);
  }
  if (table.shape && p.shapes.empty()) p.shapes = shapes_of(p);
  const Shape shape = table.shape_in(p.dimension);
  p.radii.push_back(shape.bounding_radius());
  p.masses.push_back(table.mass);
  if (!p.shapes.empty() || table.shape) p.shapes.push_back(shape);
  if (in_fluid && p.dimension == 2) {
    p.angles.push_back(table.angle);
    p.angular_velocities.push_back(table.angular_velocity[2]);
    p.inertias.push_back(table.inertia_in_plane());
  } else if (!in_fluid) {
    add_rotation_of_last(section, table, p);
  }
  add_missing_ids(p);
  given.velocities.push_back(section.has("velocity"));
  given.turns.push_back(section.has("angular_velocity"));
}

void file_keys(case_file::Keys& keys, std::string& file) {
  keys.required("file", case_file::file_name(file), {"a CSV file, see below"});
}

/// Reads the CSV file that [particles] names, relative to the folder of the case file.
void read_file_of_particles(const case_file::TomlSection& section, ParticlesCase& c,
                            ParticleLines& lines, GivenAtStart& given) {
  std::string name;
  case_file::read_keys(section, file_keys, name);
  c.particles_file = c.path.parent_path() / name;
  const bool in_fluid = c.setting.fluid.has_value();
  auto file = read_particles(c.particles_file, c.particles.dimension, may_lack_mass(c.setting));
  c.particles = std::move(file.particles);
  lines.in_file = std::move(file.lines);
  auto& p = c.particles;
  given.velocities = std::move(file.has_velocity);
  given.turns = std::move(file.has_angular_velocity);
  if (in_fluid && p.dimension == 2)
    for (std::size_t k = 0; k < p.count(); ++k)
      p.inertias.push_back(round_shape(2, p.radii[k]).inertia(p.masses[k]));
  if (!in_fluid && p.turn()) add_rotation(p);
}

struct ForceTable {
  std::vector<std::int32_t> particles;  // their numbers, from 0
  PiecewiseConstant value;              // the force on each of them [M L/T^2]
};

void force_by_id_keys(case_file::Keys& keys, ForceTable& force, const ParticlesCase& c,
                      const ParticleIds& ids) {
  keys.required("value", pieces(force.value, c.particles.dimension, c.end_time),
                {"the force, which is added to gravity"});
  keys.required("particles", case_file::custom("a list of ids", read_ids, force.particles, ids),
                {"particles on which it acts; one force for each particle"});
}

}  // namespace

ParticleLines read_particles_of_case(const case_file::TomlSection& root, ParticlesCase& c) {
  ParticleLines lines;
  GivenAtStart given;
  if (root.has("particles")) read_file_of_particles(root.section("particles"), c, lines, given);
  if (root.has("particle"))
    for (const auto& section : root.sections("particle")) {
      read_particle(section, c, given);
      lines.in_case.push_back(section.line());
    }
  if (root.has("arrangement")) read_arrangement(root.section("arrangement"), c);
  add_missing_shapes(c.particles);
  read_membranes(root, c, lines);
  read_sources(root, c);
  add_missing_shapes(c.particles);
  if (!c.setting.fluid && (c.setting.laws.friction || c.setting.lubrication || c.particles.turn()))
    add_rotation(c.particles);
  if (c.setting.lubrication) check_weights(root, c);
  if (c.setting.lubrication && c.setting.lubrication->inertia) set_velocities_of_flow(given, c);
  if (c.particles.count() > 0 || !c.setting.sources.empty()) return lines;
  if (!c.particles_file.empty())
    throw_bad_input({c.particles_file.string()},
                    "has no particle; it must have a row for each particle after the header line");
  throw_bad_input({c.path.string()},
                  "has no particle; name a file in [particles], or add a [[particle]], a "
                  "[[membrane]], an [arrangement], or a [[source]]");
}

void require_ids(const case_file::TomlSection& section, std::string_view key, const Particles& p,
                 std::size_t count) {
  section.require(count <= ids_left(p), key,
                  "needs {} of the ids above {}, the largest one so far; ids are at most {}", count,
                  largest_id(p), std::numeric_limits<std::int32_t>::max());
}

void read_forces_by_id(const case_file::TomlSection& root, ParticlesCase& c) {
  if (!root.has("force")) return;
  const ParticleIds ids(c);
  for (const auto& section : root.sections("force")) {
    ForceTable force;
    case_file::read_keys(section, force_by_id_keys, force, c, ids);
    for (const auto particle : force.particles) {
      const auto id = c.particles.id(index_of(particle));
      section.require(!c.setting.given_motions.contains(particle), "particles",
                      "contains particle {}, whose motion is given, so that a force has no effect; "
                      "it must be left out",
                      id);
      section.require(c.setting.forces.emplace(particle, force.value).second, "particles",
                      "contains particle {} a second time; each particle must have one force", id);
    }
  }
}

std::vector<case_file::KeyTable> particle_tables() {
  const ParticlesCase c;
  const ParticleIds ids(c);
  return {case_file::describe_keys("[particles]", file_keys),
          case_file::describe_keys("[[particle]]", particle_keys, c),
          case_file::describe_keys("particle.velocity_given", given_motion_keys, 2, 0),
          case_file::describe_keys("[[force]]", force_by_id_keys, c, ids)};
}

ParticleIds::ParticleIds(const ParticlesCase& c) : case_(c) {
  for (std::size_t k = 0; k < c.particles.count(); ++k)
    places_.emplace(c.particles.id(k), static_cast<std::int32_t>(k));
}

std::int32_t ParticleIds::number(const case_file::TomlSection& section, std::string_view key,
                                 double id, std::string_view verb) const {
  const bool whole = id == std::floor(id) && id <= std::numeric_limits<std::int32_t>::max();
  const auto found = whole ? places_.find(static_cast<std::int32_t>(id)) : places_.end();
  section.require(case_.particles.count() > 0, key, "{} {}, but the case has no particles", verb,
                  id);
  if (found == places_.end() && case_.particles.ids.empty())
    section.fail(
        key,
        "{} {}, which is not the number of a particle; the particles are numbered from 0 to {}",
        verb, id, case_.particles.count() - 1);
  section.require(found != places_.end(), key,
                  "{} {}, which is not the id of a particle; {} gives the ids", verb, id,
                  case_.particles_file.string());
  return found->second;
}

void read_ids(const case_file::TomlSection& section, std::string_view key,
              std::vector<std::int32_t>& place, const ParticleIds& ids) {
  for (const double id : section.numbers(key, kNotNegative))
    place.push_back(ids.number(section, key, id, "contains"));
}

}  // namespace viscontact::particles
