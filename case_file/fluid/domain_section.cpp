// Reads [domain] (domain_section.hpp). Lengths are in the unit of the case. A change must keep the
// keys and their defaults, because users have written cases with them.
#include "viscontact/case_file/fluid/domain_section.hpp"

#include <fmt/format.h>

#include <array>
#include <string>

#include "viscontact/case_file/vector_values.hpp"

namespace viscontact::case_file {
namespace {

particles::Domain read_disc(const TomlSection& disc) {
  particles::DiscDomain domain;
  if (disc.has("centre")) domain.centre = read_vector(disc, "centre", 2);
  domain.radius = disc.number("radius", kModeratelyPositive);
  disc.finish();
  return domain;
}

particles::Domain read_box(const TomlSection& box) {
  const auto from = read_vector(box, "from", 2), to = read_vector(box, "to", 2);
  particles::BoxDomain domain{{from[0], from[1]}, {to[0], to[1]}, {}};
  for (std::size_t d = 0; d < 2; ++d)
    if (!(to[d] - from[d] >= 1 / kLargestNumber))
      box.fail("to", fmt::format("contains {}; it must be greater than {}, the same coordinate of "
                                 "from",
                                 to[d], from[d]));
  if (box.has("periodic")) {
    const auto periodic = box.truths("periodic", 2);
    domain.periodic = {periodic[0], periodic[1]};
  }
  box.finish();
  return domain;
}

particles::Domain read_cylinder(const TomlSection& cylinder) {
  const particles::CylinderDomain domain{cylinder.number("radius", kModeratelyPositive),
                                         cylinder.number("height", kModeratelyPositive)};
  cylinder.finish();
  return domain;
}

/// A shape of a domain, and the dimension of the cases that it belongs to.
struct Shape {
  const char* name;
  int dimension;
  particles::Domain (*read)(const TomlSection& table);
};
constexpr std::array kShapes = {Shape{"disc", 2, read_disc}, Shape{"box", 2, read_box},
                                Shape{"cylinder", 1, read_cylinder}};

}  // namespace

particles::Domain read_domain(const TomlSection& section, int dimension) {
  const Shape* given = nullptr;
  for (const auto& shape : kShapes) {
    if (!section.has(shape.name)) continue;
    if (given != nullptr)
      section.fail(
          shape.name,
          fmt::format("must be left out, because {} is given; a case has one domain", given->name));
    given = &shape;
  }
  section.finish();
  if (given == nullptr)
    section.fail(dimension == 1 ? "cylinder" : "box",
                 "is missing; [domain] must have one of disc, box and cylinder");
  if (given->dimension != dimension)
    section.fail(
        given->name,
        fmt::format("belongs to a case with dimension {}, but space.dimension is {}; {}",
                    given->dimension == 1 ? "\"axisymmetric\"" : "2",
                    dimension == 1 ? "\"axisymmetric\"" : std::to_string(dimension),
                    dimension == 3   ? "in three dimensions [domain] must be left out"
                    : dimension == 1 ? "it must be a cylinder = { radius, height }"
                                     : "it must be a disc = { centre, radius } or a box = { from, "
                                       "to, periodic }"));
  return given->read(section.section(given->name));
}

}  // namespace viscontact::case_file
