// Reads and checks rigid bodies (bodies_section.hpp).
#include "viscontact/case_file/particles/bodies_section.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "viscontact/case_file/particles/particle_ids.hpp"
#include "viscontact/case_file/vector_values.hpp"
#include "viscontact/particles/domain/periods.hpp"

namespace viscontact::case_file {
namespace {

void check_members(const TomlSection& section, const std::vector<std::int32_t>& members,
                   const ParticlesCase& c) {
  for (std::size_t m = 0; m < members.size(); ++m) {
    const auto k = particles::index_of(members[m]);
    const auto id = c.particles.id(k);
    if (std::find(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(m), members[m]) !=
        members.begin() + static_cast<std::ptrdiff_t>(m))
      section.fail("particles", fmt::format("contains particle {} a second time", id));
    if (const auto body = c.particles.bodies.body_of(members[m]); body >= 0)
      section.fail("particles",
                   fmt::format("contains particle {}, which belongs to body {}; a particle can "
                               "belong to one body only",
                               id, body));
    if (c.setting.given_motions.contains(members[m]))
      section.fail("particles", fmt::format("contains particle {}, whose motion is given; a "
                                            "particle of a body must be free",
                                            id));
  }
}

/// In a periodic domain the particles must determine the body, whatever their order.
void check_images(const TomlSection& section, const std::vector<std::int32_t>& members,
                  const ParticlesCase& c) {
  if (const auto ambiguous = particles::ambiguous_images(c.particles, members))
    section.fail("particles",
                 fmt::format("do not determine which of their images make the body: along {} the "
                             "largest distance between neighbouring centres, {:.6g}, occurs more "
                             "than once; it must occur once, because the body ends there",
                             ambiguous->axis == 0 ? "x" : "y", ambiguous->distance));
}

/// In a periodic domain a body must not touch itself across the period.
void check_fits(const TomlSection& section, const ParticlesCase& c) {
  const double diameter = particles::diameter(c.particles.bodies.bodies.back(), c.particles);
  for (const double period : c.particles.cell.lengths)
    if (period > 0 && !(diameter < period))
      section.fail("particles",
                   fmt::format("make a body of diameter {:.6g}; it must be smaller than the period "
                               "of the domain, {:.6g}",
                               diameter, period));
}

}  // namespace

void read_bodies(const TomlSection& root, ParticlesCase& c) {
  if (!root.has("body")) return;
  const int dimension = c.particles.dimension;
  if (dimension == 1)
    root.sections("body").front().fail(
        "particles",
        "belong to a body on an axis; spheres on an axis are held together by an "
        "[[arm]] of constant length");
  c.particles.cell = particles::cell_of(c.setting);
  const ParticleIds ids(c);
  const bool in_fluid = c.setting.fluid.has_value();
  const auto& positive = in_fluid ? kModeratelyPositiveOr0 : kModeratelyPositive;
  for (const auto& section : root.sections("body")) {
    particles::RigidBodyRequest body;
    body.members = ids.numbers(section, "particles");
    check_members(section, body.members, c);
    check_images(section, body.members, c);
    if (section.has("mass")) body.mass = section.number("mass", positive);
    if (section.has("moment_of_inertia")) {
      if (dimension == 3)
        section.fail("moment_of_inertia",
                     "must be left out, because the moments of inertia of a body in space follow "
                     "from its particles");
      body.moment_of_inertia = section.number("moment_of_inertia", positive);
    }
    section.finish();
    if (!in_fluid) particles::add_rotation(c.particles);
    particles::add_rigid_body(c.particles, body);
    check_fits(section, c);
  }
}

std::string body_in_words(const ParticlesCase& c, std::int32_t particle) {
  const auto body = particle < 0 ? -1 : c.particles.bodies.body_of(particle);
  return body < 0 ? "" : fmt::format(", of body {}", body);
}

}  // namespace viscontact::case_file
