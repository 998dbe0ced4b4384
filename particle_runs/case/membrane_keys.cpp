// Reads [[membrane]], and makes the beads of membranes that are not given by particles.
#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "viscontact/membranes/membrane_shape.hpp"
#include "viscontact/particle_runs/case/particles_sections.hpp"

namespace viscontact::particles {
namespace {

/// Range of the reduced area of a membrane that is made [1]. Above 0.999 a membrane is nearly a
/// circle, which hardly anything deforms; below 0.3 its two long sides touch.
constexpr Allowed kReducedArea = {[](double v) { return v >= 0.3 && v <= 0.999; },
                                  "from 0.3 to 0.999"};

/// The texts of the keys below say what each member means.
struct MembraneTable {
  Membrane membrane;
  Vector centre{}, velocity{};  // at the start [L], [L/T]
  std::int32_t beads = 48;
  // [1], [rad], [M/(L T)], [M]
  double reduced_area = 0, angle = 0, inner_viscosity = 0, bead_mass = 0;
  double bead_radius = 0;  // [L]; 0: the default
};

/// Keys of a membrane whose beads are made. A section with the key `particles`, which gives the
/// beads, must have none of these keys.
void shape_keys(case_file::Keys& keys, MembraneTable& table, bool in_fluid) {
  auto& membrane = table.membrane;
  const bool is_made = !keys.has("particles");
  const auto needs = [&](std::string_view key, const case_file::KeyValue& value,
                         std::string_view meaning) {
    keys.required_if(is_made, key, value, {meaning, "required without `particles`"});
  };
  for (const auto* key : {"centre", "perimeter", "reduced_area", "angle", "beads", "bead_radius",
                          "bead_mass", "velocity"})
    keys.require(is_made || !keys.has(key), key,
                 "must be left out, because the key particles gives the beads");
  needs("centre", vector(table.centre, 2), "centre of the area inside at the start");
  needs("perimeter", case_file::number(membrane.perimeter, kModeratelyPositive),
        "length of the membrane, which is kept");
  needs("reduced_area", case_file::number(table.reduced_area, kReducedArea),
        "4 pi area/perimeter^2 at the start. The membrane begins as an ellipse");
  keys.optional("angle", case_file::number(table.angle, kModerate),
                {"of the long axis of the ellipse at the start, in radians"});
  keys.optional("beads", case_file::count(table.beads, kLeastBeads, 400),
                {"particles on the membrane, at equal distances"});
  keys.optional("bead_radius", case_file::number(table.bead_radius, kModeratelyPositive),
                {"radius of the beads",
                 "0.45 of their distance in a fluid, 0.5 of it without one: the beads touch"});
  const double distance = membrane.perimeter / table.beads;
  keys.require(!is_made || table.bead_radius <= distance / 2, "bead_radius",
               "is {}; it must be at most {}, half of the distance of neighbouring beads",
               table.bead_radius, distance / 2);
  if (table.bead_radius == 0) table.bead_radius = (in_fluid ? 0.45 : 0.5) * distance;
  keys.require(!in_fluid || !keys.has("bead_mass"), "bead_mass",
               "has no effect in a fluid, where membranes have no mass; it must be left out");
  keys.required_if(is_made && !in_fluid, "bead_mass",
                   case_file::number(table.bead_mass, kModeratelyPositive),
                   {"mass of each bead, without a fluid only",
                    "required without `particles` and without a fluid"});
  keys.require(!in_fluid || !keys.has("velocity"), "velocity",
               "has no effect in a fluid, which moves the membrane; it must be left out");
  keys.optional("velocity", vector(table.velocity, 2),
                {"of all beads at the start, without a fluid only", "0"});
}

/// The bending rigidity is in [M L^3/T^2], or in a fluid, where it is that of a unit length of the
/// third dimension, in [M L^2/T^2]. The bending viscosity is in [M L^3/T].
void membrane_keys(case_file::Keys& keys, MembraneTable& table, const ParticlesCase& c,
                   const ParticleIds& ids) {
  const bool in_fluid = c.setting.fluid.has_value();
  auto& membrane = table.membrane;
  keys.optional("particles", case_file::custom("a list of ids", read_ids, membrane.beads, ids),
                {"the beads, in their order around the membrane, in place of a membrane that is "
                 "made; at least 4, in a fluid 12",
                 "made"});
  shape_keys(keys, table, in_fluid);
  keys.required("bending_rigidity",
                case_file::number(membrane.bending_rigidity, kModeratelyPositiveOr0),
                {"kappa of the energy (kappa/2) times the integral of the squared curvature",
                 {},
                 "from 1e-100 to 1e100, without a fluid also 0"});
  keys.require(!in_fluid || membrane.bending_rigidity > 0, "bending_rigidity",
               "is 0; in a fluid it must be > 0, because nothing else keeps the membrane smooth");
  keys.require(!in_fluid || !keys.has("bending_viscosity"), "bending_viscosity",
               "belongs to a membrane without a fluid; the fluid damps bending, and the key must "
               "be left out");
  keys.optional("bending_viscosity",
                case_file::number(membrane.bending_viscosity, kModeratelyPositiveOr0),
                {"moment over the rate of the curvature, without a fluid only: damps bending"});
  keys.optional("inner_area",
                case_file::one_of(membrane.keeps_area, {{"kept", true}, {"free", false}}),
                {"whether the area inside is kept; `\"free\"` without a fluid only"});
  keys.require(!in_fluid || membrane.keeps_area, "inner_area",
               "is 'free'; in a fluid it must be \"kept\", because the fluid inside is "
               "incompressible and does not pass through the membrane");
  keys.require(in_fluid || !keys.has("inner_viscosity"), "inner_viscosity",
               "belongs to a case with a fluid; it must be left out");
  keys.optional("inner_viscosity", case_file::number(table.inner_viscosity, kModeratelyPositive),
                {"of the fluid inside, from 1e-4 to 1e3 times that outside", "`fluid.viscosity`"});
  if (!in_fluid || !keys.reads()) return;
  const double outside = c.setting.fluid->viscosity;
  if (!keys.has("inner_viscosity")) table.inner_viscosity = outside;
  membrane.viscosity_ratio = table.inner_viscosity / outside;
}

/// Sets perimeter, area and distances of a membrane to those of its given particles. In a fluid the
/// beads are moved to equal distances along the curve through them; Error(kBadInput) is thrown if
/// one would move by more than 0.02 of this distance.
void take_shape(const case_file::TomlSection& section, ParticlesCase& c, Membrane& membrane) {
  c.particles.cell = cell_of(c.setting.domain);
  check_given_beads(section, c, membrane);
  if (!c.setting.fluid) {
    shape_polygon(membrane, c.particles);
    return;
  }
  // Positions in a file may be rounded. Therefore beads may be moved by this fraction of their
  // distance.
  constexpr double kRounded = 0.02;
  const double moved = shape_curve(membrane, c.particles);
  const double allowed = kRounded * membrane.perimeter / membrane.count();
  section.require(moved <= allowed, "particles",
                  "are not at equal distances along the membrane, as they must be in a fluid: a "
                  "bead would move by {:.3g}, and at most {:.3g} is allowed",
                  moved, allowed);
}

/// Makes the beads of a membrane, on an ellipse, and adds them to the particles of the case. Throws
/// Error(kBadInput) if so few beads cannot have the reduced area, or if too few ids are left.
void make_beads(const case_file::TomlSection& section, ParticlesCase& c, MembraneTable& table,
                ParticleLines& lines) {
  auto& p = c.particles;
  auto& membrane = table.membrane;
  const bool in_fluid = c.setting.fluid.has_value();
  membrane.set_beads(static_cast<std::int32_t>(p.count()), table.beads);
  membrane.area =
      table.reduced_area * membrane.perimeter * membrane.perimeter / (4 * std::numbers::pi);
  if (!in_fluid) membrane.lengths.assign(membrane.beads.size(), membrane.perimeter / table.beads);
  const auto places = ellipse_of(membrane, table.centre, table.angle);
  section.require(places.has_value(), "reduced_area",
                  "is {}, which {} beads cannot have; it must be {}, or the membrane must have "
                  "more beads",
                  table.reduced_area, table.beads, table.reduced_area > 0.9 ? "smaller" : "larger");
  require_ids(section, "beads", p, static_cast<std::size_t>(table.beads));
  p.positions.insert(p.positions.end(), places->begin(), places->end());
  // `in_case` has the line of each particle of a section [[particle]]. The discs of an
  // [arrangement], which come before the beads, have no line and get entries of 0.
  lines.in_case.resize(p.count() - lines.in_file.size());
  for (std::int32_t k = 0; k < table.beads; ++k) {
    p.velocities.insert(p.velocities.end(), {table.velocity[0], table.velocity[1]});
    p.radii.push_back(table.bead_radius);
    p.masses.push_back(table.bead_mass);
    lines.in_case.push_back(section.line());
    if (!in_fluid) continue;
    p.angles.push_back(0);
    p.angular_velocities.push_back(0);
    p.inertias.push_back(0);
  }
  add_missing_ids(p);
  add_missing_shapes(p);
}

}  // namespace

void read_membranes(const case_file::TomlSection& root, ParticlesCase& c, ParticleLines& lines) {
  if (!root.has("membrane")) return;
  const auto sections = root.sections("membrane");
  check_case_of_membranes(root, sections.front(), c);
  auto& membranes = c.setting.fluid ? c.setting.fluid->membranes : c.setting.links.membranes;
  const ParticleIds ids(c);
  for (const auto& section : sections) {
    MembraneTable table;
    case_file::read_keys(section, membrane_keys, table, c, ids);
    if (table.membrane.beads.empty())
      make_beads(section, c, table, lines);
    else
      take_shape(section, c, table.membrane);
    membranes.push_back(std::move(table.membrane));
    check_place(section, c);
    if (c.setting.fluid) check_in_fluid(section, c);
  }
  check_others(sections.front(), c);
  if (!c.setting.fluid) join_neighbours(membranes, c.particles);
}

std::vector<case_file::KeyTable> membrane_tables() {
  const ParticlesCase c;
  const ParticleIds ids(c);
  return {case_file::describe_keys("[[membrane]]", membrane_keys, c, ids)};
}

}  // namespace viscontact::particles
