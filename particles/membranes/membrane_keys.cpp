// Reads [[membrane]] of a case (particles/case/particles_sections.hpp), and makes the beads.
// Lengths and masses are in the units of the case.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/particles/case/particles_sections.hpp"
#include "viscontact/particles/membranes/membrane_shape.hpp"

namespace viscontact::particles {
namespace {

/// A vesicle of a reduced area above 0.999 is a circle that hardly anything deforms, and below 0.3
/// its two sides touch.
constexpr Allowed kReducedArea = {[](double v) { return v >= 0.3 && v <= 0.999; },
                                  "from 0.3 to 0.999"};

/// A table [[membrane]].
struct MembraneTable {
  Membrane membrane;
  Vector centre{};
  double reduced_area = 0;
  double angle = 0;
  double inner_viscosity = 0;
  double bead_radius = 0;  // 0: the default
};

void membrane_keys(case_file::Keys& keys, MembraneTable& table, const Fluid& fluid) {
  auto& membrane = table.membrane;
  keys.required("centre", vector(table.centre, 2), {"centre of the area inside at the start"});
  keys.required("perimeter", case_file::number(membrane.perimeter, kModeratelyPositive),
                {"length of the membrane, which is kept"});
  keys.required(
      "reduced_area", case_file::number(table.reduced_area, kReducedArea),
      {"4 pi area/perimeter^2; the area inside is kept. The membrane begins as an ellipse"});
  keys.required("bending_rigidity",
                case_file::number(membrane.bending_rigidity, kModeratelyPositive),
                {"kappa of the energy (kappa/2) times the integral of the squared curvature"});
  keys.optional("inner_viscosity", case_file::number(table.inner_viscosity, kModeratelyPositive),
                {"of the fluid inside", "`fluid.viscosity`"});
  keys.optional("angle", case_file::number(table.angle, kModerate),
                {"of the long axis of the ellipse at the start, in radians"});
  keys.optional("beads", case_file::count(membrane.beads, kLeastBeads, 400),
                {"particles on the membrane, at equal distances"});
  keys.optional("bead_radius", case_file::number(table.bead_radius, kModeratelyPositive),
                {"radius of the beads, with which they are drawn", "0.45 of their distance"});
  if (!keys.has("inner_viscosity")) table.inner_viscosity = fluid.viscosity;
  membrane.viscosity_ratio = table.inner_viscosity / fluid.viscosity;
  const double distance = membrane.perimeter / membrane.beads;
  keys.require(table.bead_radius <= distance / 2, "bead_radius",
               "is {}; it must be at most {}, half of the distance of neighbouring beads",
               table.bead_radius, distance / 2);
  if (table.bead_radius == 0) table.bead_radius = 0.45 * distance;
  membrane.area =
      table.reduced_area * membrane.perimeter * membrane.perimeter / (4 * std::numbers::pi);
}

/// Throws if the case has what cannot be computed together with membranes.
void check_case(const case_file::TomlSection& root, const case_file::TomlSection& first,
                const ParticlesCase& c) {
  const FilePosition at{c.path.string(), first.line()};
  if (!c.setting.fluid)
    throw_bad_input(at,
                    "section [[membrane]] belongs to a case with a fluid; the case must have "
                    "sections [fluid] and [domain]");
  if (c.particles.dimension != 2)
    throw_bad_input(at, "section [[membrane]] belongs to the plane; space.dimension must be 2");
  for (const auto* key :
       {"particles", "particle", "arrangement", "body", "hinge", "spring", "arm", "force", "plane"})
    if (root.has(key))
      throw_bad_input(at,
                      fmt::format("section [[membrane]] stands beside {}; a case with membranes "
                                  "must have no other particles, no planes, bodies, links and "
                                  "forces",
                                  key));
  const auto& fluid = *c.setting.fluid;
  const auto section = root.section("fluid");
  section.require(!fluid.has_inertia(), "density",
                  "is {}; it must be 0 or left out in a case with membranes, which move in Stokes "
                  "flow",
                  fluid.density);
  section.require(fluid.solver.empty(), "solver",
                  "is a program of your own, which does not know membranes; it must be left out");
  section.require(
      fluid.mesh == FluidMesh::kFitted, "mesh",
      "is 'fixed'; it must be \"fitted\" in a case with membranes, which the mesh follows");
  section.require(fluid.coupling == Coupling::kConstrained, "coupling",
                  "is 'splitting'; it must be \"constrained\" in a case with membranes");
  section.require(fluid.constraint == RigidConstraint::kPenalty, "constraint",
                  "is 'rigid'; it must be left out in a case with membranes, which has no rigid "
                  "particles");
  root.section("space").require(
      c.setting.gravity == Vector{}, "gravity",
      "has no effect on membranes, which have no mass; it must be 0 or left out");
  root.section("viscous_contact")
      .require(!c.setting.laws.restitution.is_on(), "restitution",
               "has no effect on membranes, which have no mass; it must be 0 or left out");
  const auto* box = std::get_if<BoxDomain>(&c.setting.domain);
  if (box != nullptr && box->periodic[1])
    throw_bad_input(at,
                    "section [[membrane]] stands in a box that is periodic along y; the box must "
                    "have walls below and above");
}

/// Centres of the beads of membrane `m`, two numbers for each.
std::span<const double> beads_of(const ParticlesCase& c, const Membrane& membrane) {
  return std::span(c.particles.positions)
      .subspan(2 * index_of(membrane.first), 2 * index_of(membrane.beads));
}

/// Throws if beads of the last membrane that are no neighbours overlap, or if it crosses or
/// contains another one or an image of it in the next period.
void check_place(const case_file::TomlSection& section, const ParticlesCase& c) {
  const auto& membranes = c.setting.fluid->membranes;
  const auto& membrane = membranes.back();
  const auto own = beads_of(c, membrane);
  const double r = c.particles.radii[index_of(membrane.first)];
  const auto count = index_of(membrane.beads);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 2; j < count; ++j)
      section.require(
          (i == 0 && j + 1 == count) ||
              std::hypot(own[2 * i] - own[2 * j], own[2 * i + 1] - own[2 * j + 1]) >= 2 * r,
          "reduced_area",
          "is so small that beads {} and {} overlap across the membrane; it must be larger, or the "
          "membrane must have more beads (or a smaller bead_radius)",
          i, j);
  const double period = periods_of(c.setting.domain)[0];
  for (std::size_t m = 0; m + 1 < membranes.size(); ++m) {
    const auto other = beads_of(c, membranes[m]);
    for (const double shift : {0.0, -period, period}) {
      std::vector<double> image(other.begin(), other.end());
      for (std::size_t i = 0; i < image.size(); i += 2) image[i] += shift;
      section.require(!do_meet(own, image), "centre",
                      "makes the membrane cross or contain membrane {}; membranes must be apart",
                      m);
    }
  }
}

}  // namespace

void read_membranes(const case_file::TomlSection& root, ParticlesCase& c, ParticleLines& lines) {
  if (!root.has("membrane")) return;
  const auto sections = root.sections("membrane");
  check_case(root, sections.front(), c);
  auto& p = c.particles;
  for (const auto& section : sections) {
    MembraneTable table;
    case_file::read_keys(section, membrane_keys, table, *c.setting.fluid);
    table.membrane.first = static_cast<std::int32_t>(p.count());
    const auto beads = ellipse_of(table.membrane, table.centre, table.angle);
    section.require(
        beads.has_value(), "reduced_area",
        "is {}, which {} beads cannot have; it must be larger, or the membrane must have "
        "more beads",
        table.reduced_area, table.membrane.beads);
    p.positions.insert(p.positions.end(), beads->begin(), beads->end());
    p.velocities.resize(p.positions.size());
    for (std::int32_t k = 0; k < table.membrane.beads; ++k) {
      p.radii.push_back(table.bead_radius);
      p.masses.push_back(0);
      p.angles.push_back(0);
      p.angular_velocities.push_back(0);
      p.inertias.push_back(0);
      lines.in_case.push_back(section.line());
    }
    c.setting.fluid->membranes.push_back(table.membrane);
    check_place(section, c);
  }
}

std::vector<case_file::KeyTable> membrane_tables() {
  return {case_file::describe_keys("[[membrane]]", membrane_keys, Fluid{})};
}

}  // namespace viscontact::particles
