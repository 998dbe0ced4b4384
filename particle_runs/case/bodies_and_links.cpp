// Reads [[body]], [[hinge]], [[spring]] and [[arm]].
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "viscontact/particle_runs/case/particles_sections.hpp"
#include "viscontact/particles/domain/periods.hpp"
#include "viscontact/particles/links/links.hpp"
#include "viscontact/particles/shapes/shape_contacts.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"

namespace viscontact::particles {
namespace {

/// Throws Error(kBadInput) if one of `members` is named twice, belongs to another body or membrane,
/// or has a given motion. Also throws if it is not determined which periodic images of the members
/// make the body.
void check_members(const case_file::TomlSection& section, const std::vector<std::int32_t>& members,
                   const ParticlesCase& c) {
  for (auto member = members.begin(); member != members.end(); ++member) {
    const auto id = c.particles.id(index_of(*member));
    section.require(std::find(members.begin(), member, *member) == member, "particles",
                    "contains particle {} a second time", id);
    const auto body = c.particles.bodies.body_of(*member);
    section.require(
        body < 0, "particles",
        "contains particle {}, which belongs to body {}; a particle can belong to one body only",
        id, body);
    section.require(
        std::ranges::none_of(c.setting.links.membranes,
                             [&](const Membrane& membrane) { return membrane.has(*member); }),
        "particles", "contains particle {}, which is a bead of a membrane; beads belong to no body",
        id);
    section.require(
        !c.setting.given_motions.contains(*member), "particles",
        "contains particle {}, whose motion is given; a particle of a body must be free", id);
  }
  // In a periodic domain the images that make the body must not depend on the order of the members.
  if (const auto ambiguous = ambiguous_images(c.particles, members))
    section.fail("particles",
                 "do not determine which of their images make the body: along {} the largest "
                 "distance between neighbouring centres, {:.6g}, occurs more than once; it must "
                 "occur once, because the body ends there",
                 kAxes[ambiguous->axis], ambiguous->distance);
}

void check_fits(const case_file::TomlSection& section, const ParticlesCase& c) {
  const double diameter = particles::diameter(c.particles.bodies.bodies.back(), c.particles);
  for (const double period : c.particles.cell.lengths)
    section.require(
        !(period > 0) || diameter < period, "particles",
        "make a body of diameter {:.6g}; it must be smaller than the period of the domain, {:.6g}",
        diameter, period);
}

/// The particles of the case must have been read.
void body_keys(case_file::Keys& keys, RigidBodyRequest& body, const ParticlesCase& c,
               const ParticleIds& ids) {
  const auto& positive = c.setting.fluid ? kModeratelyPositiveOr0 : kModeratelyPositive;
  const std::string_view words = "from 1e-100 to 1e100, in a fluid also 0";
  keys.required("particles", case_file::custom("a list of ids", read_ids, body.members, ids),
                {"particles of the body, each of one body at most. They keep their places in the "
                 "body and do not touch each other, so that they may overlap ([in a "
                 "fluid](fluid.md#bodies-and-links) with conditions). Not on an axis"});
  if (keys.reads()) check_members(keys.section(), body.members, c);
  keys.optional("mass", case_file::number(body.mass, positive),
                {"the centre of mass is that of the particles, the mean of their centres if they "
                 "have no mass",
                 "sum of the masses of the particles", words});
  keys.require(c.particles.dimension != 3 || !keys.has("moment_of_inertia"), "moment_of_inertia",
               "must be left out, because the moments of inertia of a body in space follow from "
               "its particles");
  keys.optional(
      "moment_of_inertia", case_file::number(body.moment_of_inertia, positive),
      {"about the centre of mass, in 2D only",
       "that of the particles at their places, scaled with `mass` if that is given", words});
}

/// Without a value: the key is not in the table.
struct HingeTable {
  int body = -1;                                // number of the body; -1: a particle is named
  std::vector<std::int32_t> held;               // the particle, or the members of the body
  Vector at{};                                  // place of the hinge [L]
  std::optional<double> stiffness, rest_angle;  // of the spring [M L^2/T^2], [rad]
  std::optional<double> lowest, highest;        // angles of the stops [rad]
};

void read_body_of_hinge(const case_file::TomlSection& section, std::string_view key,
                        HingeTable& hinge, const ParticlesCase& c) {
  const auto& bodies = c.particles.bodies;
  section.require(!bodies.empty(), key, "names a body, but the case has no [[body]]");
  hinge.body = section.count(key, 0, static_cast<int>(bodies.count()) - 1);
  hinge.held = bodies.bodies[index_of(hinge.body)].members;
}

void read_particle_of_hinge(const case_file::TomlSection& section, std::string_view key,
                            HingeTable& hinge, const ParticlesCase& c, const ParticleIds& ids) {
  const auto particle = ids.number(section, key, section.number(key, kNotNegative), "is");
  const auto body = c.particles.bodies.body_of(particle);
  section.require(body < 0, key, "is {}, which belongs to body {}; the hinge must name the body",
                  c.particles.id(index_of(particle)), body);
  hinge.held = {particle};
}

/// A hinge holds a point of a body or of a particle at its place; in two dimensions it may have a
/// torsion spring, and stops for the angle.
void hinge_keys(case_file::Keys& keys, HingeTable& hinge, const ParticlesCase& c,
                const ParticleIds& ids) {
  keys.require(keys.has("body") != keys.has("particle"), "body",
               "or particle must be there, and not both: a hinge holds one of them");
  keys.optional("body", case_file::custom("number of a body", read_body_of_hinge, hinge, c),
                {"what the hinge holds", "or `particle`"});
  keys.optional("particle", case_file::custom("an id", read_particle_of_hinge, hinge, c, ids),
                {"what the hinge holds; the particle belongs to no body", "or `body`"});
  keys.required("at", vector(hinge.at, c.particles.dimension),
                {"a point inside the particle, or inside one of the body, which stays where it is. "
                 "Not on an axis"});
  keys.require(c.particles.dimension != 3 || !keys.has("stiffness"), "stiffness",
               "must be left out, because torsion springs are for discs");
  keys.optional("stiffness", case_file::number(hinge.stiffness, kModeratelyPositiveOr0),
                {"in 2D: of a torsion spring, torque = -`stiffness` (angle - `rest_angle`)", "0"});
  keys.require(keys.has("stiffness") || !keys.has("rest_angle"), "rest_angle",
               "has no effect without a stiffness of the torsion spring");
  keys.optional(
      "rest_angle", case_file::number(hinge.rest_angle, kModerate),
      {"with `stiffness`; the angle of a body is 0 at the start", "the angle at the start"});
  for (const auto* key : {"lowest_angle", "highest_angle"})
    keys.require(c.particles.dimension != 3 || !keys.has(key), key,
                 "must be left out, because stops are for discs");
  keys.optional(
      "lowest_angle", case_file::number(hinge.lowest, kModerate),
      {"in 2D: a [stop](particles.md#rigid-bodies-and-links), below which the angle does not fall",
       "none"});
  keys.optional("highest_angle", case_file::number(hinge.highest, kModerate),
                {"in 2D: a stop, above which the angle does not rise", "none"});
  keys.require(!hinge.lowest || !hinge.highest || *hinge.lowest < *hinge.highest, "lowest_angle",
               "is {}; it must be smaller than the highest_angle, {}", hinge.lowest.value_or(0),
               hinge.highest.value_or(0));
}

/// Throws Error(kBadInput) for a wrong key, and if the place of the hinge is outside the particle
/// or body that it holds, if the motion of this particle is given, or if the angle at the start is
/// beyond a stop.
Hinge read_hinge(const case_file::TomlSection& section, const ParticlesCase& c,
                 const ParticleIds& ids) {
  const auto& p = c.particles;
  HingeTable table;
  case_file::read_keys(section, hinge_keys, table, c, ids);
  const bool is_body = table.body >= 0;
  const auto holder = std::ranges::find_if(table.held, [&](std::int32_t k) {
    const auto& at = table.at;
    if (!p.is_round(index_of(k)))
      return p.placed_shape(index_of(k)).distance_to({at[0], at[1]}) <= 0;
    return norm(at - p.position(index_of(k))) <= p.radii[index_of(k)];
  });
  section.require(holder != table.held.end(), "at",
                  "is {}, which is outside {}; it must be inside {}", section.shown("at"),
                  is_body ? "all particles of the body" : "the particle",
                  is_body ? "one of them" : "the particle");
  section.require(!c.setting.given_motions.contains(*holder), "particle",
                  "names a particle whose motion is given; a hinge holds only free ones");
  Hinge hinge;
  hinge.at = table.at;
  hinge.body = table.body;
  hinge.point.particle = *holder;
  const double angle = p.angles.empty() || is_body ? 0 : p.angles[index_of(*holder)];
  // In a periodic domain the hinge holds the image of the body that is nearest to it.
  const Vector arm = nearest_image(
      cell_of(c.setting.domain), hinge.at - (is_body ? p.bodies.bodies[index_of(hinge.body)].centre
                                                     : p.position(index_of(*holder))));
  // The offset is turned back to the orientation in which the angle of the particle is 0.
  hinge.point.offset = p.dimension == 3 ? arm : displacement_at(arm, {0, 0, -angle}, arm, 2);
  hinge.stiffness = table.stiffness.value_or(0);
  hinge.rest_angle = table.rest_angle.value_or(angle);
  hinge.lowest_angle = table.lowest.value_or(hinge.lowest_angle);
  hinge.highest_angle = table.highest.value_or(hinge.highest_angle);
  section.require(angle >= hinge.lowest_angle, "lowest_angle",
                  "is {}; it must be at most the angle at the start, {}", hinge.lowest_angle,
                  angle);
  section.require(angle <= hinge.highest_angle, "highest_angle",
                  "is {}; it must be at least the angle at the start, {}", hinge.highest_angle,
                  angle);
  return hinge;
}

/// Reads the ids of the two particles of a spring or arm. Throws Error(kBadInput) unless they are
/// two different particles that do not belong to one body and do not both have a given motion.
void read_ends(const case_file::TomlSection& section, std::string_view key,
               std::array<std::int32_t, 2>& place, const ParticlesCase& c, const ParticleIds& ids) {
  std::vector<std::int32_t> ends;
  read_ids(section, key, ends, ids);
  section.require(ends.size() == 2 && ends[0] != ends[1], key,
                  "is {}; it must contain the ids of two different particles", section.shown(key));
  const auto id = [&](std::int32_t k) { return c.particles.id(index_of(k)); };
  section.require(
      !c.particles.bodies.are_one(ends[0], ends[1]), key,
      "names particles {} and {}, which both belong to body {} and keep their distance anyway",
      id(ends[0]), id(ends[1]), c.particles.bodies.body_of(ends[0]));
  section.require(
      !c.setting.given_motions.contains(ends[0]) || !c.setting.given_motions.contains(ends[1]), key,
      "names two particles whose motions are given; at least one must be free");
  place = {ends[0], ends[1]};
}

/// Distance [L] of the centres of two particles, or their nearest images, at the start.
double distance_at_start(const ParticlesCase& c, std::int32_t first, std::int32_t second) {
  return norm(nearest_image(cell_of(c.setting.domain), c.particles.position(index_of(second)) -
                                                           c.particles.position(index_of(first))));
}

void spring_keys(case_file::Keys& keys, Spring& spring, const ParticlesCase& c,
                 const ParticleIds& ids) {
  std::array<std::int32_t, 2> ends{};
  keys.required("between", case_file::custom("ids of two particles", read_ends, ends, c, ids),
                {"whose centres the spring joins; not of one body"});
  keys.required("stiffness", case_file::number(spring.stiffness, kModeratelyPositive),
                {"stiffness of the spring"});
  spring.first = ends[0];
  spring.second = ends[1];
  if (keys.reads()) spring.length = distance_at_start(c, ends[0], ends[1]);
  keys.optional("length", case_file::number(spring.length, kModeratelyPositiveOr0),
                {"length without force", "the distance at the start"});
}

/// Throws Error(kBadInput) unless the first time is 0, times increase and lengths are > 0.
void read_points_of_length(const case_file::TomlSection& length, std::string_view key,
                           PiecewiseLinearLength& pieces) {
  for (const auto& row : length.rows(key, 2, kModeratelyPositiveOr0)) {
    length.require(pieces.points.empty() ? row[0] == 0 : row[0] > pieces.points.back()[0], key,
                   "contains the time {}; the first time must be 0 and each other time later than "
                   "the one before it",
                   row[0]);
    length.require(row[1] > 0, key, "contains the length {}; it must be > 0", row[1]);
    pieces.points.push_back({row[0], row[1]});
  }
}

void pieces_of_length_keys(case_file::Keys& keys, PiecewiseLinearLength& pieces) {
  keys.required("pieces",
                case_file::custom("`[ [time, length], ... ]`", read_points_of_length, pieces),
                {"linear between times that rise from 0, and constant after the last one"});
  const bool has_period =
      keys.optional("period", case_file::number(pieces.period, kModeratelyPositive),
                    {"at least the last time of `pieces`: they repeat, and from the last time to "
                     "the end of a period the length goes linearly back to the first one",
                     "none"});
  if (!has_period) return;
  const auto last = pieces.points.back();
  keys.require(last[0] <= pieces.period, "period",
               "is {}; it must be at least the last time of the pieces, {}", pieces.period,
               last[0]);
  if (last[0] != pieces.period) return;
  // The last point is the first point of the next period, and is dropped.
  keys.require(last[1] == pieces.points.front()[1], "pieces",
               "ends with the length {} at the end of the period; it must be {}, with which the "
               "next period begins",
               last[1], pieces.points.front()[1]);
  pieces.points.pop_back();
}

void wave_of_length_keys(case_file::Keys& keys, SinusoidalLength& wave) {
  keys.required("mean", case_file::number(wave.mean, kModeratelyPositive),
                {"the length is `mean` + `amplitude` sin(`angular_frequency` t + `phase`)"});
  keys.required("amplitude", case_file::number(wave.amplitude, kModerate), {"smaller than `mean`"});
  keys.required("angular_frequency", case_file::number(wave.angular_frequency, kModerate),
                {"belongs to `mean`"});
  keys.optional("phase", case_file::number(wave.phase, kModerate),
                {"belongs to `mean`, in radians"});
  keys.require(std::abs(wave.amplitude) < wave.mean, "amplitude",
               "is {}; it must be smaller than the mean length, {}", wave.amplitude, wave.mean);
}

/// Reads a number [L], or a table of one of these two kinds.
void read_length_of_arm(const case_file::TomlSection& section, std::string_view key,
                        ArmLength& length) {
  if (!section.is_table(key)) {
    length = PiecewiseLinearLength{{{0, section.number(key, kModeratelyPositive)}}};
    return;
  }
  const auto table = section.section(key);
  if (table.has("pieces"))
    case_file::read_keys(table, pieces_of_length_keys, length.emplace<PiecewiseLinearLength>());
  else
    case_file::read_keys(table, wave_of_length_keys, length.emplace<SinusoidalLength>());
}

void arm_of_particles_keys(case_file::Keys& keys, Arm& arm, const ParticlesCase& c,
                           const ParticleIds& ids) {
  std::array<std::int32_t, 2> ends{};
  keys.required(
      "between", case_file::custom("ids of two particles", read_ends, ends, c, ids),
      {"whose centres the arm keeps at a distance; not of one body, and one arm for each pair"});
  arm.first = ends[0];
  arm.second = ends[1];
  keys.required(
      "length",
      case_file::custom(
          "a number, `{ pieces, period }` or `{ mean, amplitude, angular_frequency, phase }`",
          read_length_of_arm, arm.length),
      {"the distance, which at time 0 is that of the particles"});
}

std::string arm_in_words(const ParticlesCase& c, const Arm& arm) {
  return fmt::format("between particles {} and {}", c.particles.id(index_of(arm.first)),
                     c.particles.id(index_of(arm.second)));
}

/// The times [T], in increasing order up to `end`, at which conditions between several arms are
/// checked: the decisive_times() of all arms (links.hpp), between which each length is nearly
/// linear.
std::vector<double> times_of(std::span<const Arm* const> arms, double end) {
  std::vector<double> times;
  for (const auto* arm : arms) {
    const auto own = decisive_times(arm->length, end);
    times.insert(times.end(), own.begin(), own.end());
  }
  std::ranges::sort(times);
  return times;
}

void check_arm(const case_file::TomlSection& section, const Arm& arm, const ParticlesCase& c) {
  // Users may give places with six digits only; the first step corrects the distance.
  constexpr double kRounded = 1e-6;
  const double length = length_at(arm.length, 0);
  const double distance = distance_at_start(c, arm.first, arm.second);
  section.require(std::abs(length - distance) <= kRounded * distance, "length",
                  "is {} at the start, but the centres of particles {} and {} are {:.9g} apart; it "
                  "must begin with their distance",
                  length, c.particles.id(index_of(arm.first)), c.particles.id(index_of(arm.second)),
                  distance);
  const double touching =
      c.particles.radii[index_of(arm.first)] + c.particles.radii[index_of(arm.second)];
  const std::array of = {&arm};
  for (const double time : times_of(of, c.end_time)) {
    const double here = length_at(arm.length, time);
    section.require(here >= touching * (1 - kRounded), "length",
                    "is {:.9g} at time {:.9g}, where its particles would overlap; it must be at "
                    "least the sum of their radii, {}",
                    here, time, touching);
  }
}

/// Throws Error(kBadInput) if arm `sides[0]` is at any time longer than the arms `sides[1]` and
/// `sides[2]` together. `sections` are the tables of all arms.
void check_triangle(std::span<const case_file::TomlSection> sections, const ParticlesCase& c,
                    std::array<std::size_t, 3> sides) {
  const auto& arms = c.setting.links.arms;
  const std::array of = {&arms[sides[0]], &arms[sides[1]], &arms[sides[2]]};
  // If all three particles are on a line, rounding errors of about 1e-16 could exceed the bound.
  constexpr double kRounding = 1e-9;
  for (const double time : times_of(of, c.end_time)) {
    const auto length = [&](std::size_t side) { return length_at(of[side]->length, time); };
    sections[sides[0]].require(length(0) <= (1 + kRounding) * (length(1) + length(2)), "length",
                               "is {:.9g} at time {:.9g}, more than the sum {:.9g} of the arms {} "
                               "and {}; these three arms cannot meet in a triangle",
                               length(0), time, length(1) + length(2), arm_in_words(c, *of[1]),
                               arm_in_words(c, *of[2]));
  }
}

/// Throws Error(kBadInput) if two arms join the same particles, for the faults of check_arm(), and
/// if three arms cannot meet in a triangle.
void check_arms(std::span<const case_file::TomlSection> sections, const ParticlesCase& c) {
  assert(sections.size() == c.setting.links.arms.size());
  const auto& arms = c.setting.links.arms;
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> between;
  for (std::size_t k = 0; k < arms.size(); ++k) {
    const auto [first, second] = std::minmax(arms[k].first, arms[k].second);
    sections[k].require(between.emplace(std::pair(first, second), k).second, "between",
                        "names the same particles as an arm before it; there must be one arm {}",
                        arm_in_words(c, arms[k]));
    check_arm(sections[k], arms[k], c);
  }
  // All triangles of arms: each arm with each particle that arms connect with both of its ends.
  std::map<std::int32_t, std::vector<std::int32_t>> neighbours;
  for (const auto& arm : arms) {
    neighbours[arm.first].push_back(arm.second);
    neighbours[arm.second].push_back(arm.first);
  }
  for (std::size_t k = 0; k < arms.size(); ++k)
    for (const auto third : neighbours[arms[k].first]) {
      const auto other = between.find(std::minmax(arms[k].second, third));
      if (third == arms[k].second || other == between.end()) continue;
      check_triangle(sections, c,
                     {k, between.at(std::minmax(arms[k].first, third)), other->second});
    }
}

}  // namespace

void read_bodies(const case_file::TomlSection& root, ParticlesCase& c) {
  if (!root.has("body")) return;
  if (c.particles.dimension == 1)
    root.sections("body").front().fail("particles",
                                       "belong to a body on an axis; spheres on an axis are held "
                                       "together by an [[arm]] of constant length");
  c.particles.cell = cell_of(c.setting);
  const ParticleIds ids(c);
  for (const auto& section : root.sections("body")) {
    RigidBodyRequest body;
    case_file::read_keys(section, body_keys, body, c, ids);
    if (!c.setting.fluid) add_rotation(c.particles);
    add_rigid_body(c.particles, body);
    check_fits(section, c);
  }
}

void read_links(const case_file::TomlSection& root, ParticlesCase& c) {
  const ParticleIds ids(c);
  auto& links = c.setting.links;
  if (root.has("hinge")) {
    if (c.particles.dimension == 1)
      root.sections("hinge").front().fail(
          "at", "belongs to a hinge on an axis, where nothing turns; fixed = true holds a sphere");
    if (!c.setting.fluid) add_rotation(c.particles);
    for (const auto& section : root.sections("hinge"))
      links.hinges.push_back(read_hinge(section, c, ids));
  }
  if (root.has("spring"))
    for (const auto& section : root.sections("spring"))
      case_file::read_keys(section, spring_keys, links.springs.emplace_back(), c, ids);
  if (root.has("arm")) {
    const auto sections = root.sections("arm");
    for (const auto& section : sections)
      case_file::read_keys(section, arm_of_particles_keys, links.arms.emplace_back(), c, ids);
    check_arms(sections, c);
  }
  if (!links.empty() && !c.setting.fluid) add_rotation(c.particles);
}

std::vector<case_file::KeyTable> body_and_link_tables() {
  const ParticlesCase c;
  const ParticleIds ids(c);
  auto length = case_file::describe_keys("arm.length", pieces_of_length_keys);
  const auto wave = case_file::describe_keys("", wave_of_length_keys);
  length.rows.insert(length.rows.end(), wave.rows.begin(), wave.rows.end());
  return {case_file::describe_keys("[[body]]", body_keys, c, ids),
          case_file::describe_keys("[[hinge]]", hinge_keys, c, ids),
          case_file::describe_keys("[[spring]]", spring_keys, c, ids),
          case_file::describe_keys("[[arm]]", arm_of_particles_keys, c, ids), length};
}

}  // namespace viscontact::particles
