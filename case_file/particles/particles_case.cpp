// Reads the case file of many particles (particles_case.hpp). Lengths, masses and times are in the
// units of the case. A change must keep the keys and their defaults, because users have written
// cases with them.
#include "viscontact/case_file/particles/particles_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>

#include "viscontact/case_file/fluid/domain_section.hpp"
#include "viscontact/case_file/fluid/fluid_section.hpp"
#include "viscontact/case_file/fluid/fluid_start.hpp"
#include "viscontact/case_file/fluid/solver_files.hpp"
#include "viscontact/case_file/particles/bodies_section.hpp"
#include "viscontact/case_file/particles/links_section.hpp"
#include "viscontact/case_file/particles/particle_tables.hpp"
#include "viscontact/case_file/particles/particles_start.hpp"
#include "viscontact/case_file/particles/particles_template.hpp"
#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/case_file/vector_values.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact::case_file {
namespace {

using particles::Vector;
using particles::operator*;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators

constexpr Allowed kNotPositive = {[](double v) { return v <= 0; }, "<= 0"};
constexpr Allowed kTolerance = {[](double v) { return v >= 1e-12 && v <= 0.1; },
                                "between 1e-12 and 0.1"};

/// Reads space.dimension; 1 stands for "axisymmetric".
int read_dimension(const TomlSection& space) {
  if (!space.is_text("dimension")) return space.count("dimension", 2, 3);
  if (const auto text = space.text("dimension"); text != "axisymmetric")
    space.fail("dimension", fmt::format("is '{}'; it must be 2, 3 or \"axisymmetric\"", text));
  return 1;
}

/// Reads the contact law. In a fluid its viscosity is that of the fluid, unless it is given.
void read_law(const TomlSection& section, const std::optional<particles::Fluid>& fluid,
              particles::FilmLaw& law) {
  if (section.has("gamma_min")) law.gamma_min = section.number("gamma_min", kNotPositive);
  if (section.has("viscosity")) law.viscosity = section.number("viscosity", kModeratelyPositive);
  if (section.has("roughness")) law.roughness = section.number("roughness", kModeratelyPositive);
  if (law.gamma_min && law.viscosity)
    section.fail(
        "viscosity",
        "must be left out, because gamma_min is given and would also follow from viscosity");
  if (fluid && law.gamma_min && law.roughness)
    section.fail("roughness",
                 "must be left out, because gamma_min is given and would also follow from the "
                 "roughness and the viscosity of the fluid");
  if (fluid && law.roughness && !law.viscosity) law.viscosity = fluid->viscosity;
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
  if (dimension == 1 && section.has("angular_velocity"))
    section.fail("angular_velocity", "must be left out, because a plane on an axis does not turn");
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

/// Throws an error for a plane that is not parallel to the periods of the domain. Such a plane
/// would bound the particles and not their images.
void check_periods_of_plane(const TomlSection& section, const particles::Plane& plane,
                            const particles::Domain& domain) {
  const auto periods = particles::periods_of(domain);
  for (std::size_t d = 0; d < periods.size(); ++d)
    if (periods[d] > 0 &&
        (plane.start.normal[d] != 0 || particles::norm(plane.angular_velocity) > 0))
      section.fail("normal", fmt::format("belongs to a plane that turns or is not parallel to the "
                                         "period of the domain along {}; a plane in a periodic "
                                         "domain must be parallel to its periods",
                                         d == 0 ? "x" : "y"));
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

/// Reads the key `restitution`, after the film and the fluid are known.
void read_restitution(const TomlSection& section, ParticlesCase& c) {
  constexpr Allowed kShare = {[](double v) { return v >= 0 && v <= 1; }, "from 0 to 1"};
  if (!section.has("restitution")) return;
  auto& laws = c.setting.laws;
  laws.restitution.coefficient = section.number("restitution", kShare);
  if (!laws.restitution.is_on()) return;
  if (c.setting.fluid)
    section.fail("restitution",
                 "is for particles without a fluid; a case with [fluid] must not have the key");
  if (!laws.film.gamma_min && !laws.film.roughness)
    section.fail("restitution",
                 "has no effect, because smooth particles never touch; viscous_contact must have "
                 "gamma_min (0: no film), or viscosity and roughness");
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
  read_law(contact, c.setting.fluid, c.setting.laws.film);
  read_restitution(contact, c);
  if (contact.has("scheme")) {
    const auto scheme = contact.text("scheme");
    if (scheme != "euler" && scheme != "leapfrog")
      contact.fail("scheme", fmt::format("is '{}'; it must be \"euler\" or \"leapfrog\"", scheme));
    if (scheme == "leapfrog" && c.setting.fluid)
      contact.fail(
          "scheme",
          "is 'leapfrog', which is for particles without a fluid; in a fluid the steps are "
          "of second order without it, and the key must be left out");
    if (scheme == "leapfrog") c.setting.scheme = particles::Scheme::kLeapfrog;
  }
  contact.finish();
}

void read_friction(const TomlSection& section, ParticlesCase& c) {
  if (c.setting.fluid)
    section.fail("coefficient",
                 "belongs to particles without a fluid; a case with [fluid] must have no section "
                 "[friction]");
  if (!c.setting.laws.film.gamma_min && !c.setting.laws.film.viscosity)
    section.fail("coefficient",
                 "has no effect, because smooth particles never touch; viscous_contact must have "
                 "gamma_min (0: no film), or viscosity and roughness");
  particles::FrictionLaw law;
  law.coefficient = section.number("coefficient", kModeratelyPositiveOr0);
  if (section.has("method")) {
    const auto method = section.text("method");
    if (method == "convex")
      law.method = particles::FrictionMethod::kConvex;
    else if (method != "fixed_point")
      section.fail("method",
                   fmt::format("is '{}'; it must be \"fixed_point\" or \"convex\"", method));
  }
  section.finish();
  c.setting.laws.friction = law;
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

/// Reads [domain] and [fluid]. Needs c.path and the dimension of the case.
void read_domain_and_fluid(const TomlSection& root, ParticlesCase& c) {
  const int dimension = c.particles.dimension;
  if (root.has("domain")) c.setting.domain = read_domain(root.section("domain"), dimension);
  if (!root.has("fluid")) {
    if (dimension == 1)
      root.section("space").fail(
          "dimension",
          "is \"axisymmetric\", which is for spheres in a fluid; the case must have "
          "sections [fluid] and [domain]");
    return;
  }
  const auto section = root.section("fluid");
  if (dimension == 3)
    root.section("space").fail("dimension",
                               "is 3; in a case with [fluid] it must be 2 or \"axisymmetric\"");
  if (!root.has("domain"))
    throw_bad_input({c.path.string(), section.line()},
                    "section [fluid] belongs to a case without a section [domain]; the case must "
                    "have one, because walls or periods must hold the fluid");
  c.setting.fluid = read_fluid(section, c.setting.domain);
  // Files of the command are relative to the case file, as all files of a case are.
  auto& command = c.setting.fluid->solver;
  command =
      with_absolute_files(std::move(command), std::filesystem::absolute(c.path).parent_path());
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
  const int dimension = read_dimension(space);
  c.particles.dimension = dimension;
  if (space.has("gravity")) c.setting.gravity = read_vector(space, "gravity", dimension);
  space.finish();

  read_domain_and_fluid(root, c);
  read_contact(root.section("viscous_contact"), c);
  if (root.has("friction")) read_friction(root.section("friction"), c);
  if (root.has("solver")) read_solver(root.section("solver"), c.setting.solver);
  c.frame_interval = c.end_time / 100;
  if (root.has("output")) {
    const auto output = root.section("output");
    if (output.has("every")) c.frame_interval = output.number("every", kModeratelyPositive);
    output.finish();
  }
  if (root.has("plane"))
    for (const auto& section : root.sections("plane")) {
      c.setting.planes.push_back(read_plane(section, dimension, c.end_time));
      check_periods_of_plane(section, c.setting.planes.back(), c.setting.domain);
    }

  const auto lines = read_particles_of_case(root, c);
  read_forces_by_id(root, c);
  read_bodies(root, c);
  read_links(root, c);
  if (c.setting.laws.restitution.is_on() &&
      !(c.setting.links.hinges.empty() && c.setting.links.arms.empty()))
    root.section("viscous_contact")
        .fail("restitution",
              "must be left out, because the case has hinges or arms, through which a blow would "
              "pass; bodies and springs may rebound");
  if (root.has("sweep")) c.sweep = read_particles_sweep(root.section("sweep"));
  root.finish();
  check_start(c, lines);
  if (c.setting.fluid) {
    if (!root.section("fluid").has("threshold_gap")) set_default_threshold_gap(c);
    check_fluid_start(root, c, lines);
  }
  return c;
}

}  // namespace viscontact::case_file
