// Reads and checks hinges, springs and arms (links_section.hpp).
#include "viscontact/case_file/particles/links_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "viscontact/case_file/particles/arm_checks.hpp"
#include "viscontact/case_file/particles/particle_ids.hpp"
#include "viscontact/case_file/vector_values.hpp"
#include "viscontact/particles/bodies/body_step.hpp"
#include "viscontact/particles/domain/periods.hpp"

namespace viscontact::case_file {
namespace {

using particles::index_of;
using particles::Vector;
using particles::operator-;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators
using particles::operator*;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators

/// Reads `body` or `particle` of a hinge, and returns the particles of which one must hold the
/// hinge.
std::vector<std::int32_t> read_held(const TomlSection& section, const ParticlesCase& c,
                                    const ParticleIds& ids, particles::Hinge& hinge) {
  const auto& bodies = c.particles.bodies;
  if (section.has("body") == section.has("particle"))
    section.fail("body", "or particle must be there, and not both: a hinge holds one of them");
  if (section.has("body")) {
    if (bodies.empty()) section.fail("body", "names a body, but the case has no [[body]]");
    hinge.body = section.count("body", 0, static_cast<int>(bodies.count()) - 1);
    return bodies.bodies[index_of(hinge.body)].members;
  }
  const auto particle = ids.number(section, "particle");
  if (const auto body = bodies.body_of(particle); body >= 0)
    section.fail("particle", fmt::format("is {}, which belongs to body {}; the hinge must name the "
                                         "body",
                                         c.particles.id(index_of(particle)), body));
  return {particle};
}

particles::Hinge read_hinge(const TomlSection& section, const ParticlesCase& c,
                            const ParticleIds& ids) {
  const auto& p = c.particles;
  particles::Hinge hinge;
  const auto held = read_held(section, c, ids, hinge);
  hinge.at = read_vector(section, "at", p.dimension);
  const auto holder = std::ranges::find_if(held, [&](std::int32_t k) {
    return particles::norm(hinge.at - p.position(index_of(k))) <= p.radii[index_of(k)];
  });
  if (holder == held.end())
    section.fail(
        "at", fmt::format("is {}, which is outside {}; it must be inside {}", section.shown("at"),
                          hinge.body < 0 ? "the particle" : "all particles of the body",
                          hinge.body < 0 ? "the particle" : "one of them"));
  if (c.setting.given_motions.contains(*holder))
    section.fail("particle",
                 "names a particle whose motion is given; a hinge holds only free ones");
  hinge.point.particle = *holder;
  const double angle = p.angles.empty() || hinge.body >= 0 ? 0 : p.angles[index_of(*holder)];
  // The body is at the image of its centre that is nearest to the hinge.
  const Vector arm = particles::nearest_image(
      particles::cell_of(c.setting.domain),
      hinge.at - (hinge.body < 0 ? p.position(index_of(*holder))
                                 : p.bodies.bodies[index_of(hinge.body)].centre));
  // The offset is that of the particle at the angle 0.
  hinge.point.offset =
      particles::displacement_at(arm, {0, 0, -angle}, arm, p.dimension == 3 ? 3 : 2);
  if (p.dimension == 3) hinge.point.offset = arm;
  hinge.rest_angle = angle;
  if (section.has("stiffness")) {
    if (p.dimension == 3)
      section.fail("stiffness", "must be left out, because torsion springs are for discs");
    hinge.stiffness = section.number("stiffness", kModeratelyPositiveOr0);
    if (section.has("rest_angle")) hinge.rest_angle = section.number("rest_angle", kModerate);
  } else if (section.has("rest_angle")) {
    section.fail("rest_angle", "has no effect without a stiffness of the torsion spring");
  }
  section.finish();
  return hinge;
}

/// Reads `between` of a spring or arm.
std::array<std::int32_t, 2> read_ends(const TomlSection& section, const ParticlesCase& c,
                                      const ParticleIds& ids) {
  const auto ends = ids.pair(section, "between");
  const auto id = [&](std::int32_t k) { return c.particles.id(index_of(k)); };
  if (c.particles.bodies.are_one(ends[0], ends[1]))
    section.fail("between",
                 fmt::format("names particles {} and {}, which both belong to body {} "
                             "and keep their distance anyway",
                             id(ends[0]), id(ends[1]), c.particles.bodies.body_of(ends[0])));
  if (c.setting.given_motions.contains(ends[0]) && c.setting.given_motions.contains(ends[1]))
    section.fail("between",
                 "names two particles whose motions are given; at least one must be "
                 "free");
  return ends;
}

particles::Spring read_spring(const TomlSection& section, const ParticlesCase& c,
                              const ParticleIds& ids) {
  const auto [first, second] = read_ends(section, c, ids);
  particles::Spring spring{first, second};
  spring.stiffness = section.number("stiffness", kModeratelyPositive);
  spring.length = section.has("length") ? section.number("length", kModeratelyPositiveOr0)
                                        : distance_at_start(c, first, second);
  section.finish();
  return spring;
}

}  // namespace

void read_links(const TomlSection& root, ParticlesCase& c) {
  const ParticleIds ids(c);
  auto& links = c.setting.links;
  if (root.has("hinge")) {
    if (c.particles.dimension == 1)
      root.sections("hinge").front().fail("at",
                                          "belongs to a hinge on an axis, where nothing "
                                          "turns; fixed = true holds a sphere");
    if (!c.setting.fluid) particles::add_rotation(c.particles);
    for (const auto& section : root.sections("hinge"))
      links.hinges.push_back(read_hinge(section, c, ids));
  }
  if (root.has("spring"))
    for (const auto& section : root.sections("spring"))
      links.springs.push_back(read_spring(section, c, ids));
  if (root.has("arm")) {
    std::vector<TomlSection> sections;
    for (const auto& section : root.sections("arm")) {
      const auto [first, second] = read_ends(section, c, ids);
      links.arms.push_back({first, second, read_arm_length(section)});
      section.finish();
      sections.push_back(section);
    }
    check_arms(sections, c);
  }
  if (!links.empty() && !c.setting.fluid) particles::add_rotation(c.particles);
}

}  // namespace viscontact::case_file
