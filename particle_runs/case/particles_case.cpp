// Reads [space], [viscous_contact], [friction], [solver], [output], [[plane]] and [sweep].
#include "viscontact/particle_runs/case/particles_case.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/particle_runs/case/particles_sections.hpp"
#include "viscontact/particle_runs/io/contact_file.hpp"
#include "viscontact/particles/domain/bounded_region.hpp"
#include "viscontact/particles/setting/chords.hpp"

namespace viscontact::particles {
namespace {

namespace fs = std::filesystem;

constexpr Allowed kNotPositive = {[](double v) { return v <= 0; }, "<= 0"};
constexpr Allowed kTolerance = {[](double v) { return v >= 1e-12 && v <= 0.1; },
                                "from 1e-12 to 0.1"};
constexpr Allowed kShare = {[](double v) { return v >= 0 && v <= 1; }, "from 0 to 1"};

/// Reads 2, 3, or "axisymmetric", which becomes 1.
void read_dimension(const case_file::TomlSection& space, std::string_view key, int& dimension) {
  constexpr const char* kAllowed = "it must be 2, 3 or \"axisymmetric\"";
  space.require(space.has(key), key, "is missing; {}", kAllowed);
  if (space.is_text(key)) {
    space.require(space.text(key) == "axisymmetric", key, "is '{}'; {}", space.text(key), kAllowed);
    dimension = 1;
    return;
  }
  const auto shown = space.shown(key);
  space.require(shown == "2" || shown == "3", key, "is {}; {}", shown, kAllowed);
  dimension = space.count(key, 2, 3);  // refuses 2.0
}

void space_keys(case_file::Keys& keys, ParticlesCase& c) {
  keys.required(
      "dimension",
      case_file::custom("2, 3 or `\"axisymmetric\"`", read_dimension, c.particles.dimension),
      {"discs; spheres, without a fluid; or [spheres on the axis](#spheres-on-an-axis) of a "
       "cylinder with fluid"});
  keys.optional("gravity", vector(c.setting.gravity, c.particles.dimension),
                {"acceleration of all particles", "0"});
}

/// Keys of the fluid film between particles: either gamma_min, or viscosity and roughness, from
/// which gamma_min follows. In a fluid the film has the viscosity of the fluid, unless the key
/// `viscosity` is given.
void film_keys(case_file::Keys& keys, FilmLaw& law, const std::optional<Fluid>& fluid) {
  keys.optional("gamma_min", case_file::number(law.gamma_min, kNotPositive),
                {"for every pair, an impulse (of discs in a fluid an impulse per length); 0: no "
                 "film, plain inelastic contact"});
  keys.optional("viscosity", case_file::number(law.viscosity, kModeratelyPositive),
                {"of the film, with `roughness`", "none; in a fluid that of the fluid"});
  keys.optional("roughness", case_file::number(law.roughness, kModeratelyPositive),
                {"height on every particle and plane, with `viscosity`"});
  keys.require(!law.gamma_min || !law.viscosity, "viscosity",
               "must be left out, because gamma_min is given and would also follow from viscosity");
  keys.require(!fluid || !law.gamma_min || !law.roughness, "roughness",
               "must be left out, because gamma_min is given and would also follow from the "
               "roughness and the viscosity of the fluid");
  if (fluid && law.roughness && !law.viscosity) law.viscosity = fluid->viscosity;
  keys.require(law.viscosity.has_value() == law.roughness.has_value(),
               law.viscosity ? "roughness" : "viscosity",
               "is missing; a case with a {} needs both viscosity and roughness, from which "
               "gamma_min follows",
               law.viscosity ? "viscosity" : "roughness");
}

constexpr const char* kNoSolidContact =
    "has no effect, because smooth particles never touch; viscous_contact must have gamma_min (0: "
    "no film), or viscosity and roughness";

void contact_keys(case_file::Keys& keys, ParticlesCase& c) {
  auto& laws = c.setting.laws;
  auto& film = laws.film;
  auto& restitution = laws.restitution;
  double& step = c.setting.time_step;
  keys.required("end_time", case_file::number(c.end_time, kModeratelyPositive),
                {"end of the simulation"});
  keys.required("time_step", case_file::number(step, kModeratelyPositive), {"at most `end_time`"});
  keys.require(step <= c.end_time, "time_step", "is {}; it must be at most end_time, {}", step,
               c.end_time);
  constexpr double kMostSteps = 1e9;  // more steps probably come from a wrong unit of time
  keys.require(c.end_time / step <= kMostSteps, "time_step",
               "is {}, which makes {:.3g} steps to end_time; at most {:.0e} are allowed", step,
               c.end_time / step, kMostSteps);
  film_keys(keys, film, c.setting.fluid);
  keys.optional("fluid_density", case_file::number(c.fluid_density, kModeratelyPositive),
                {"density of the fluid, for the [Reynolds "
                 "number](physics.md#4-motion-of-one-sphere-reduced_model) of the particles only"});
  keys.require(!keys.has("fluid_density") || c.setting.fluid || film.viscosity, "fluid_density",
               "has no effect, because the case has no viscosity; it must be left out");
  keys.require(!keys.has("fluid_density") || !c.setting.fluid || !c.setting.fluid->has_inertia(),
               "fluid_density", "must be left out, because fluid.density gives it");
  keys.optional("restitution", case_file::number(restitution.coefficient, kShare),
                {"the coefficient e_d of [restitution](physics.md#5-many-particles-particles), "
                 "(5.15) and in a fluid (6.11), of the solids. A case with it has no arms; without "
                 "a fluid it has no hinges, ellipses and plates, and in a fluid no bodies and "
                 "springs. It must give `gamma_min`, or `viscosity` and `roughness`"});
  keys.require(!restitution.is_on() || film.gamma_min || film.roughness, "restitution", "{}",
               kNoSolidContact);
  keys.optional(
      "scheme",
      case_file::one_of(c.setting.scheme,
                        {{"euler", Scheme::kEuler}, {"leapfrog", Scheme::kLeapfrog}}),
      {"without a fluid; with `\"leapfrog\"` positions are of [second "
       "order](physics.md#5-many-particles-particles) away from impacts and of contacts that last "
       "while their normal turns, where they are of first order. `final_particles.csv` then has "
       "the velocities at the end (of particles without contacts and links), the frames and tables "
       "those half a step before. Steps near a jump of a force are shorter"});
  keys.require(c.setting.scheme == Scheme::kEuler || !c.setting.fluid, "scheme",
               "is 'leapfrog', which is for particles without a fluid; in a fluid the steps are of "
               "second order without it, and the key must be left out");
}

/// The former word for "coulomb".
constexpr std::string_view kFormerMethod = "fixed_point";

void friction_keys(case_file::Keys& keys, FrictionLaw& law) {
  keys.required("coefficient", case_file::number(law.coefficient, kModeratelyPositiveOr0),
                {"mu_s of [solid contact](particles.md#friction)"});
  keys.optional("method",
                case_file::one_of(law.method,
                                  {{"coulomb", FrictionMethod::kCoulomb},
                                   {"convex", FrictionMethod::kConvex},
                                   {kFormerMethod, FrictionMethod::kCoulomb}},
                                  2),
                {"Coulomb's law, or, without a fluid, a convex problem, in which dry contacts that "
                 "slide open by h mu_s abs(v_t)"});
}

/// Throws Error(kBadInput) for spheres on an axis in a fluid, if no solids can touch in this case,
/// or if the case has a fluid and the method is "convex".
void read_friction(const case_file::TomlSection& section, ParticlesCase& c) {
  auto& setting = c.setting;
  const int dimension = c.particles.dimension;
  if (const auto& pairs = setting.lubrication) {
    section.require(pairs->roughness > 0 || pairs->pairs != PairTerms::kNone, "coefficient",
                    "has no effect, because the film of viscous contact keeps smooth spheres "
                    "apart; viscous_contact.roughness must be > 0");
    section.require(pairs->roughness > 0 ||
                        (pairs->pairs == PairTerms::kNearContact && pairs->regularisation > 0),
                    "coefficient",
                    "has no effect, because smooth spheres with a film never touch; "
                    "viscous_contact.roughness must be > 0, or lubrication.pairs \"near_contact\" "
                    "with a regularisation > 0");
  }
  section.require(!setting.fluid || dimension == 2, "coefficient",
                  "belongs to particles that turn; spheres on the axis of a fluid do not slide on "
                  "each other, and the case must have no section [friction]");
  section.require(setting.lubrication || setting.laws.film.gamma_min || setting.laws.film.viscosity,
                  "coefficient", "{}", kNoSolidContact);
  case_file::read_keys(section, friction_keys, setting.laws.friction.emplace());
  section.require((!setting.fluid && !setting.lubrication) ||
                      setting.laws.friction->method == FrictionMethod::kCoulomb,
                  "method",
                  "is 'convex', which is for particles without a fluid; in a fluid, and with "
                  "[lubrication], it must be \"coulomb\", or the key must be left out");
  if (section.has("method") && section.text("method") == kFormerMethod)
    c.warnings.emplace_back(
        "friction.method is \"fixed_point\", the former word for \"coulomb\"; write \"coulomb\"");
}

/// Throws Error(kBadInput) if a case with friction in a fluid also has restitution or membranes.
void check_friction_in_fluid(const case_file::TomlSection& section, const Setting& setting) {
  if (!setting.fluid) return;
  section.require(!setting.laws.restitution.is_on(), "coefficient",
                  "must not be there, because the case has a fluid and viscous_contact.restitution "
                  "> 0; in a fluid solids either rub or rebound, and the section [friction] or the "
                  "key restitution must be left out");
  section.require(setting.fluid->membranes.empty(), "coefficient",
                  "must not be there, because the case has membranes in a fluid, whose contacts "
                  "have no friction; the section [friction] must be left out");
}

void solver_keys(case_file::Keys& keys, ParticlesCase& c) {
  auto& settings = c.setting.solver;
  const bool is_chosen =
      keys.optional("accuracy",
                    case_file::one_of(settings.accuracy,
                                      {{"full", Accuracy::kFull}, {"packing", Accuracy::kPacking}}),
                    {"`\"packing\"`, without a fluid, sets `tolerance` to 1e-4 and "
                     "`impulse_tolerance` to 1e-3 if "
                     "the case does not, and counts the [mean load](particles.md#packings) of a "
                     "set as an impulse at "
                     "work"});
  if (is_chosen && settings.accuracy == Accuracy::kPacking) {
    keys.require(!c.setting.fluid, "accuracy",
                 "is 'packing', which is for particles without a fluid; in a fluid the key must be "
                 "left out");
    settings = SolverSettings::for_packings();
  }
  keys.optional("tolerance", case_file::number(settings.tolerance, kTolerance),
                {"tolerance of the gaps, divided by the mean radius"});
  keys.optional("impulse_tolerance", case_file::number(settings.impulse_tolerance, kTolerance),
                {"tolerance of each impulse, divided by the [impulses at "
                 "work](particles.md#the-projection)"});
  keys.optional("max_iterations",
                case_file::count(settings.max_iterations, 1, std::numeric_limits<int>::max()),
                {"for each step; in a fluid for each [solution of its "
                 "contacts](fluid.md#contact)",
                 {},
                 "whole number >= 1"});
}

void output_keys(case_file::Keys& keys, ParticlesCase& c) {
  keys.optional("every", case_file::number(c.frame_interval, kModeratelyPositive),
                {"time between frames", "a hundredth of `end_time`"});
  c.average_from_given =
      keys.optional("average_from", case_file::number(c.average_from, kNotNegative),
                    {"time at which the means over time in run.json and in sweeps begin; with it, "
                     "run.json also has the means of contact forces"});
  keys.require(c.average_from < c.end_time || c.average_from == 0, "average_from",
               "is {}; it must be earlier than end_time, {}", c.average_from, c.end_time);
  keys.optional("tables", case_file::texts(c.tables),
                {"tables with rows for each frame: `\"motion\"`, `\"contacts\"`, `\"walls\"`, "
                 "`\"stress\"` ([file-formats.md](file-formats.md#tables-over-time)); in a fluid "
                 "the first two are always written",
                 "none", "a list of names"});
  for (const auto& name : c.tables) {
    keys.require(std::ranges::find(kAskedTables, name) != kAskedTables.end(), "tables",
                 "has '{}'; the tables are {}", name, fmt::join(kAskedTables, ", "));
  }
  keys.optional(
      "step_columns", case_file::texts(c.step_columns),
      {"further columns of `steps.csv`: `\"solver_stages\"`, the methods of the contact "
       "solver that ran ([file-formats.md](file-formats.md#the-folder-of-many-particles))",
       "none", "a list of names"});
  for (const auto& name : c.step_columns)
    keys.require(std::ranges::find(kStepColumns, name) != kStepColumns.end(), "step_columns",
                 "has '{}'; the columns are {}", name, fmt::join(kStepColumns, ", "));
}

constexpr int kInPlane = 2;  // with it pieces_of_turn() reads one number

/// Reads a number along the normal of a plane, or pieces of time with such numbers, as component 0
/// of vectors.
void read_load(const case_file::TomlSection& section, std::string_view key,
               PiecewiseConstant& place, const double& end_time) {
  section.require(
      !section.is_array(key) || section.is_array_of_tables(key), key,
      "is a list; it must be one number, > 0 towards the particles, or a list of pieces "
      "{{ until, value }}");
  pieces_of_turn(place, kInPlane, end_time).read(section, key);
  for (auto& piece : place.pieces) piece.value = {piece.value[2], 0, 0};
}

/// Length [L] or area [L^2] of the part of a plane in the domain. Throws Error(kBadInput) unless
/// the domain is a box and the plane parallel to sides of it, so that the size does not change
/// while the plane moves.
double size_in_domain(const case_file::TomlSection& section, const Plane& plane,
                      const Domain& domain) {
  const auto* box = std::get_if<BoxDomain>(&domain);
  section.require(box != nullptr, "pressure",
                  "needs the length or area of the plane, which only a [domain] with a box gives; "
                  "the plane must have the key force in its place");
  std::size_t along = 3;
  for (std::size_t d = 0; d < 3; ++d)
    if (std::abs(plane.start.normal[d]) == 1) along = d;
  section.require(along < 3, "pressure",
                  "belongs to a plane that is parallel to two sides of the box, because the part "
                  "of another plane in the box changes while it moves; this plane must have the "
                  "key force in its place");
  double size = 1;
  for (std::size_t d = 0; d < box->dimension(); ++d)
    if (d != along) size *= box->to[d] - box->from[d];
  return size;
}

/// Keys of the load of a plane: a pressure [M/(L T^2)] (with discs [M/T^2]) or a force, and the
/// mass.
void load_keys(case_file::Keys& keys, Plane& plane, const ParticlesCase& c) {
  PlaneLoad load;
  const bool has_pressure = keys.optional(
      "pressure", case_file::custom("a number, or pieces", read_load, load.force, c.end_time),
      {"without a fluid: the plane [moves along its normal](particles.md#planes-under-a-load), and "
       "this pressure on its length (discs) or area (spheres) in the box pushes it towards the "
       "particles"});
  keys.require(!has_pressure || !keys.has("force"), "force",
               "must be left out, because pressure gives the force on this plane");
  const bool has_force = keys.optional(
      "force", case_file::custom("a number, or pieces", read_load, load.force, c.end_time),
      {"in place of `pressure`: force along the normal, > 0 towards the particles"});
  const bool has_load = has_pressure || has_force;
  keys.require(has_load || !keys.has("mass"), "mass",
               "has no effect, because the plane has neither pressure nor force; it must be left "
               "out");
  keys.required_if(has_load, "mass", case_file::number(load.mass, kModeratelyPositive),
                   {"inertia of a plane with `pressure` or `force`, on which gravity does not act",
                    "required with `pressure` or `force`"});
  if (!has_load) return;
  const auto& section = keys.section();
  const std::string_view key = has_pressure ? "pressure" : "force";
  section.require(!c.setting.fluid, key,
                  "belongs to a plane without a fluid; in a case with [fluid] a plane moves with "
                  "its velocity");
  section.require(
      !c.setting.laws.restitution.is_on(), key,
      "must be left out, because the case has viscous_contact.restitution, and impacts on "
      "a plane that moves under a load are not computed");
  section.require(norm(plane.angular_velocity) == 0, "angular_velocity",
                  "must be left out, because a plane with {} does not turn", key);
  constexpr double kRounding = 1e-12;  // above the rounding errors of a unit normal
  for (const auto& piece : plane.velocity.pieces)
    section.require(std::abs(dot(piece.value, plane.start.normal)) <= kRounding * norm(piece.value),
                    "velocity",
                    "has a component along the normal, along which {} moves this plane; it must be "
                    "parallel to the plane",
                    key);
  if (has_pressure) {
    const double size = size_in_domain(section, plane, c.setting.domain);
    for (auto& piece : load.force.pieces) piece.value = size * piece.value;
  }
  plane.load = std::move(load);
}

/// The normal becomes a unit vector.
void plane_keys(case_file::Keys& keys, Plane& plane, const ParticlesCase& c) {
  const int dimension = c.particles.dimension;
  Vector normal{};
  keys.required("point", vector(plane.start.point, dimension), {"a point of the plane"});
  keys.required("normal", vector(normal, dimension),
                {"points to the side of the particles; its length is arbitrary, but not 0"});
  const double length = norm(normal);
  keys.require(length > 1e-100, "normal",  // 1/length must be finite
               "is 0; it must be a vector that points into the free side of the plane");
  plane.start.normal = (1 / length) * normal;
  keys.optional("velocity", pieces(plane.velocity, dimension, c.end_time), {"of the plane", "0"});
  keys.require(dimension != 1 || !keys.has("angular_velocity"), "angular_velocity",
               "must be left out, because a plane on an axis does not turn");
  const bool turns = keys.optional("angular_velocity", turn(plane.angular_velocity, dimension),
                                   {"in 2D counter-clockwise", "0"});
  keys.require(turns || !keys.has("pivot"), "pivot",
               "must be left out, because this plane has no angular_velocity");
  plane.pivot = plane.start.point;
  keys.optional(
      "pivot", vector(plane.pivot, dimension),
      {"only with `angular_velocity`: the centre of rotation, which moves with the velocity",
       "`point`"});
  load_keys(keys, plane, c);
}

/// A plane that is not parallel to the periods of the domain would bound the particles but not
/// their periodic images.
void check_periods_of_plane(const case_file::TomlSection& section, const Plane& plane,
                            const Domain& domain) {
  const auto periods = periods_of(domain);
  for (std::size_t d = 0; d < periods.size(); ++d)
    section.require(
        periods[d] == 0 || (plane.start.normal[d] == 0 && norm(plane.angular_velocity) == 0),
        "normal",
        "belongs to a plane that turns or is not parallel to the period of the domain along {}; a "
        "plane in a periodic domain must be parallel to its periods",
        kAxes[d]);
}

void particles_sweep_keys(case_file::Keys& keys, case_file::SweepRequest& sweep) {
  keys.optional("vary", case_file::texts(sweep.vary), {"`KEY=RANGE` each, as on the command line"});
  keys.optional("draws", case_file::number(sweep.draws, case_file::kWholeNumber),
                {"number of random arrangements at each point", "that of the case"});
  case_file::points_and_plot_keys(keys, sweep);
}

/// c.path and the dimension of the case must be set before. Throws Error(kBadInput) if the
/// dimension does not fit, or if there is a fluid without a domain.
void read_domain_and_fluid(const case_file::TomlSection& root, ParticlesCase& c) {
  const int dimension = c.particles.dimension;
  if (root.has("domain")) c.setting.domain = read_domain(root.section("domain"), dimension);
  if (!root.has("fluid")) {
    root.section("space").require(dimension != 1, "dimension",
                                  "is \"axisymmetric\", which is for spheres in a fluid; the case "
                                  "must have sections [fluid] and [domain]");
    return;
  }
  const auto section = root.section("fluid");
  root.section("space").require(dimension != 3, "dimension",
                                "is 3; in a case with [fluid] it must be 2 or \"axisymmetric\"");
  if (!root.has("domain"))
    throw_bad_input({c.path.string(), section.line(), "fluid"},
                    "section [fluid] belongs to a case without a section [domain]; the case must "
                    "have one, because walls or periods must hold the fluid");
  c.setting.fluid = read_fluid(section, c.setting.domain);
  // Names of files in the command `solver` are relative to the folder of the case file, as all
  // names of files in a case are.
  auto& command = c.setting.fluid->solver;
  command = with_absolute_files(std::move(command), fs::absolute(c.path).parent_path());
}

}  // namespace

void read_root(const case_file::TomlSection& root, ParticlesCase& c) {
  // Each section finds what it needs of the sections before it.
  case_file::read_title_and_units(root, c, true);
  case_file::read_keys(root.section("space"), space_keys, c);
  if (root.has("lubrication")) check_beside_lubrication(root, c);
  read_domain_and_fluid(root, c);
  read_probes(root, c.setting.domain, c.setting.fluid);
  if (root.has("lubrication")) read_lubrication(root, c);
  case_file::read_keys(root.section("viscous_contact"),
                       c.setting.lubrication ? lubricated_contact_keys : contact_keys, c);
  if (c.setting.lubrication) check_pieces_of_flow(root, c);
  if (root.has("friction")) read_friction(root.section("friction"), c);
  if (root.has("solver")) case_file::read_keys(root.section("solver"), solver_keys, c);
  c.frame_interval = c.end_time > 0 ? c.end_time / 100 : c.setting.time_step;
  if (root.has("output")) case_file::read_keys(root.section("output"), output_keys, c);
  if (root.has("plane"))
    for (const auto& section : root.sections("plane")) {
      case_file::read_keys(section, plane_keys, c.setting.planes.emplace_back(), c);
      check_periods_of_plane(section, c.setting.planes.back(), c.setting.domain);
      if (c.setting.lubrication) check_plane_in_flow(section, c.setting.planes.back(), c);
    }
  if (std::ranges::find(c.tables, "walls") != c.tables.end())
    root.section("output").require(!obstacles_of(c.setting).empty(), "tables",
                                   "has 'walls', but the case has no walls and no planes");
  if (std::ranges::find(c.tables, "stress") != c.tables.end())
    root.section("output").require(
        size_of_region(c.setting.domain, positions_of(c.setting.planes, 0), c.particles.dimension) >
            0,
        "tables", "has 'stress', which needs a [domain], or planes that bound a region");

  if (c.setting.lubrication && c.setting.lubrication->offset != 0)
    root.section("lubrication")
        .require(!root.has("arrangement"), "offset",
                 "must be left out, because an [arrangement] places spheres between images that "
                 "are not displaced; only particles that are given may have an offset");
  const auto lines = read_particles_of_case(root, c);
  read_forces_by_id(root, c);
  read_bodies(root, c);
  if (c.setting.fluid && c.particles.dimension == 2)
    c.setting.fluid->cut_areas = cut_areas_of(*c.setting.fluid, c.particles);
  read_links(root, c);
  if (root.has("friction")) check_friction_in_fluid(root.section("friction"), c.setting);
  root.section("viscous_contact")
      .require(!c.setting.laws.restitution.is_on() || !c.setting.fluid ||
                   (c.particles.bodies.empty() && c.setting.links.springs.empty() &&
                    c.setting.links.arms.empty()),
               "restitution",
               "must be left out, because the case has a fluid and also bodies, springs or arms; "
               "in a fluid only single particles, also on hinges, may rebound");
  root.section("viscous_contact")
      .require(!c.setting.laws.restitution.is_on() || !c.setting.fluid ||
                   !c.setting.fluid->has_inertia() ||
                   c.setting.fluid->coupling == Coupling::kConstrained,
               "restitution",
               "must be left out, because the fluid has a density and fluid.coupling is "
               "\"splitting\": the momentum of the fluid around a particle would not rebound");
  root.section("viscous_contact")
      .require(
          !c.setting.laws.restitution.is_on() || c.setting.fluid.has_value() ||
              (c.setting.links.hinges.empty() && c.setting.links.arms.empty()),
          "restitution",
          "must be left out, because the case has hinges or arms, through which an impact would "
          "pass; bodies and springs may rebound");
  if (root.has("sweep"))
    case_file::read_keys(root.section("sweep"), particles_sweep_keys, c.sweep.emplace());
  root.finish();
  if (c.setting.lubrication) check_range(root, c);
  check_start(c, lines);
  if (c.setting.lubrication && c.setting.lubrication->pairs == PairTerms::kNone)
    set_film_of_pairs(c);
  if (c.setting.fluid) {
    if (!root.section("fluid").has("threshold_gap")) set_default_threshold_gap(c);
    check_fluid_start(root, c, lines);
  }
}

std::vector<fs::path> files_of(const ParticlesCase& c) {
  auto files = c.fit_files;
  if (!c.particles_file.empty()) files.insert(files.begin(), c.particles_file);
  return files;
}

ParticlesCase read_particles_case(const fs::path& path) {
  return case_file::read_case_file<ParticlesCase>(path);
}

std::vector<case_file::KeyTable> tables_of_particles_case() {
  const ParticlesCase c;
  std::vector<case_file::KeyTable> tables = {
      case_file::describe_keys("[space]", space_keys),
      case_file::describe_keys("[viscous_contact] of particles", contact_keys),
      case_file::describe_keys("[friction]", friction_keys),
      case_file::describe_keys("[solver]", solver_keys),
      case_file::describe_keys("[output]", output_keys),
      case_file::describe_keys("[[plane]]", plane_keys, c),
      case_file::describe_keys("[sweep] of particles", particles_sweep_keys)};
  for (auto& more :
       {domain_and_fluid_tables(), lubrication_tables(), particle_tables(), arrangement_tables(),
        source_tables(), membrane_tables(), body_and_link_tables()})
    tables.insert(tables.end(), more.begin(), more.end());
  return tables;
}

std::string text_for_any_folder(const case_file::TomlSection& root, const fs::path& path) {
  std::vector<std::pair<std::string, std::string>> paths;
  const auto folder = fs::absolute(path).parent_path();
  if (root.has("particles")) {
    const auto section = root.section("particles");
    if (section.is_text("file"))
      paths.emplace_back("particles.file",
                         (folder / section.text("file")).lexically_normal().string());
  }
  if (root.has("lubrication") && root.section("lubrication").has("fits"))
    paths.emplace_back(
        "lubrication.fits",
        (folder / root.section("lubrication").text("fits")).lexically_normal().string());
  if (root.has("fluid") && root.section("fluid").has("solver")) {
    const auto command = with_absolute_files(root.section("fluid").texts("solver"), folder);
    for (std::size_t word = 0; word < command.size(); ++word)
      paths.emplace_back(fmt::format("fluid.solver[{}]", word), command[word]);
  }
  return root.with_texts(paths).as_toml();
}

}  // namespace viscontact::particles
