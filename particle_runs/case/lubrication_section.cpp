// Reads [lubrication], and [viscous_contact] beside it.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "viscontact/common/error.hpp"
#include "viscontact/particle_runs/case/particles_sections.hpp"

namespace viscontact::particles {
namespace {

constexpr Allowed kRange = {[](double v) { return v >= 1e-3 && v <= 100; }, "from 1e-3 to 100"};
constexpr double kLargestRangeInBox = 2;  // beyond it other spheres are between those of a pair
constexpr Allowed kRelativeLength = {[](double v) { return v == 0 || (v >= 1e-12 && v <= 0.1); },
                                     "0, or from 1e-12 to 0.1"};
constexpr Allowed kDrag = {[](double v) { return v >= 1e-12 && v <= 1e6; }, "from 1e-12 to 1e6"};

/// The flow around the spheres, of which one number is given.
struct FlowKeys {
  std::optional<double> shear_rate, strain_rate;  // [1/T]
  std::optional<std::array<Vector, 3>> gradient;  // [1/T]
  std::optional<double> stress;                   // [M/(L T^2)]
};

/// Throws Error(kBadInput) unless there are three rows, and if the trace is not 0.
void read_gradient(const case_file::TomlSection& section, std::string_view key,
                   std::optional<std::array<Vector, 3>>& gradient) {
  const auto rows = section.rows(key, 3, kModerate);
  section.require(rows.size() == 3, key, "has {} rows; it must have 3, of du/dx, dv/dx and dw/dx",
                  rows.size());
  auto& entries = gradient.emplace();
  double trace = 0, largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    std::ranges::copy(rows[i], entries[i].begin());
    trace += entries[i][i];
    for (const double entry : entries[i]) largest = std::max(largest, std::abs(entry));
  }
  constexpr double kRounding = 1e-12;  // of numbers that users round
  section.require(std::abs(trace) <= kRounding * largest, key,
                  "has the trace {:.6g}; it must be 0, because the fluid is incompressible", trace);
}

void flow_keys(case_file::Keys& keys, FlowKeys& flow) {
  keys.optional("shear_rate", case_file::number(flow.shear_rate, kModerate),
                {"s: the velocity of the fluid is (s y, 0, 0)", "one of these keys is required"});
  keys.optional("strain_rate", case_file::number(flow.strain_rate, kModerate),
                {"s: the velocity of the fluid is (s x, -s y, 0). Not in a periodic box, whose "
                 "images it would carry away",
                 "likewise"});
  keys.optional(
      "gradient",
      case_file::custom("`[[..], [..], [..]]`, without a trace", read_gradient, flow.gradient),
      {"row i has the derivatives of component i of the velocity along x, y and z. In a periodic "
       "box only that of the first along y may differ from 0",
       "likewise"});
  keys.optional("stress", case_file::number(flow.stress, kModerate),
                {"mean shear stress of the suspension in a box, component xy: the flow is that of "
                 "`shear_rate`, and the rate a result. Only at the start, with `end_time = 0`",
                 "likewise"});
  const char* given = nullptr;
  for (const auto* key : {"shear_rate", "strain_rate", "gradient", "stress"}) {
    if (!keys.has(key)) continue;
    keys.require(given == nullptr, key, "must be left out, because {} is given",
                 given == nullptr ? "" : given);
    given = key;
  }
  keys.require(given != nullptr, "shear_rate",
               "is missing; a table of a flow must have one of shear_rate, strain_rate, gradient "
               "and stress");
}

/// Throws Error(kBadInput) if the flow would not move each image of the spheres in a periodic box
/// along its period, and if there is a stress without a box.
void check_flow(const case_file::TomlSection& section, const PairLubrication& pairs,
                const Domain& domain) {
  const char* key = section.has("gradient") ? "gradient" : "strain_rate";
  const bool has_box = !std::holds_alternative<std::monostate>(domain);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      section.require(!has_box || (i == 0 && j == 1) || pairs.gradient[i][j] == 0, key,
                      "makes the velocity along {} change along {}, which is not possible in a "
                      "periodic box; there only that along x may change, along y (shear_rate), or "
                      "the case must have no [domain]",
                      kAxes[i], kAxes[j]);
  section.require(has_box || !pairs.stress, "stress",
                  "is that of a suspension in a volume; the case must have a [domain] with a box");
}

void read_flow(const case_file::TomlSection& section, std::string_view key, PairLubrication& pairs,
               const Domain& domain) {
  FlowKeys flow;
  const auto table = section.section(key);
  case_file::read_keys(table, flow_keys, flow);
  if (flow.shear_rate) pairs.gradient[0][1] = *flow.shear_rate;
  if (flow.strain_rate) {
    pairs.gradient[0][0] = *flow.strain_rate;
    pairs.gradient[1][1] = -*flow.strain_rate;
  }
  if (flow.gradient) pairs.gradient = *flow.gradient;
  if (flow.stress) pairs.gradient[0][1] = 1;
  pairs.stress = flow.stress;
  check_flow(table, pairs, domain);
}

void read_truth(const case_file::TomlSection& section, std::string_view key, bool& place) {
  place = section.truth(key);
}

struct LubricationKeys {
  PairLubrication pairs;
  bool compares = false;
};

void lubrication_keys(case_file::Keys& keys, LubricationKeys& read, const Domain& domain) {
  auto& pairs = read.pairs;
  keys.required("viscosity", case_file::number(pairs.viscosity, kModeratelyPositive),
                {"dynamic viscosity of the fluid"});
  keys.optional("pairs",
                case_file::one_of(pairs.pairs, {{"tables", PairTerms::kTables},
                                                {"near_contact", PairTerms::kNearContact},
                                                {"none", PairTerms::kNone}}),
                {"the resistances of a pair: exact for two spheres, the terms 1/q and ln(1/q) of "
                 "the gap q, or none: drag and viscous contact alone"});
  keys.optional("range", case_file::number(pairs.range, kRange),
                {"largest gap of a pair, in mean radii of the pair; in a box at most 2"});
  keys.require(pairs.range <= kLargestRangeInBox || std::holds_alternative<std::monostate>(domain),
               "range",
               "is {}; in a box it must be at most {}, because other spheres are between those of "
               "a pair that is farther apart",
               pairs.range, kLargestRangeInBox);
  keys.optional(
      "regularisation", case_file::number(pairs.regularisation, kRelativeLength),
      {"delta, in mean radii: it is added to the gap in the resistances of a pair. 0: the "
       "impulse of the film is integrated exactly"});
  keys.optional("drag", case_file::number(pairs.drag, kDrag),
                {"multiple of the Stokes drag of the single spheres"});
  keys.optional("velocity", case_file::custom("a table, see below", read_flow, pairs, domain),
                {"the linear flow around the spheres", "at rest"});
  keys.optional("offset", case_file::number(pairs.offset, kModerate),
                {"displacement along x, at the start, of the periodic image across y"});
  keys.require(!keys.has("offset") || !std::holds_alternative<std::monostate>(domain), "offset",
               "has no effect without periods; it must be left out, or the case must have a "
               "[domain] with a box");
  keys.require(!keys.has("inertia"), "inertia",
               "is not computed for spheres with lubrication; the key must be left out");
  keys.optional(
      "compare", case_file::custom("`true` or `false`", read_truth, read.compares),
      {"whether the case is run a second time with `pairs = \"none\"`, and the page shows "
       "both ([suspensions.md](suspensions.md#comparison))",
       "`false`"});
  for (const auto* key : {"range", "regularisation", "compare"})
    keys.require(pairs.pairs != PairTerms::kNone || !keys.has(key), key,
                 "has no effect with pairs = \"none\"; it must be left out");
}

/// The sections of a case that cannot stand beside [lubrication], with the reason.
struct Refusal {
  const char* section;
  const char* reason;
};
constexpr auto kRefusals = std::to_array<Refusal>({
    {"fluid", "computes the flow around the particles"},
    {"probe", "measures the flow of a case with [fluid]"},
    {"membrane", "belongs to particles in the plane"},
    {"source", "adds particles while the case runs"},
    {"body", "joins particles"},
    {"hinge", "joins particles"},
    {"spring", "joins particles"},
    {"arm", "joins particles"},
    {"plane", "bounds the particles by a plane"},
});

/// The root of 2 E:E, with the symmetric part E of the gradient [1/T]; 0 if it is a result.
double rate_of(const PairLubrication& pairs) {
  double sum = 0;
  if (pairs.stress) return 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double strain = (pairs.gradient[i][j] + pairs.gradient[j][i]) / 2;
      sum += 2 * strain * strain;
    }
  return std::sqrt(sum);
}

void repulsion_keys(case_file::Keys& keys, Repulsion& repulsion) {
  keys.required("amplitude", case_file::number(repulsion.amplitude, kModeratelyPositive),
                {"the force of two spheres of the radii a and b at the gap q is a b/(a + b) "
                 "`amplitude` exp(-q/`length`)"});
  keys.required("length", case_file::number(repulsion.length, kModeratelyPositive), {"see above"});
}

void read_repulsion(const case_file::TomlSection& section, std::string_view key,
                    std::optional<Repulsion>& repulsion) {
  case_file::read_keys(section.section(key), repulsion_keys, repulsion.emplace());
}

void check_domain(const case_file::TomlSection& root, const Domain& domain) {
  if (std::holds_alternative<std::monostate>(domain)) return;
  const auto* box = std::get_if<BoxDomain>(&domain);
  const auto section = root.section("domain").section("box");
  for (std::size_t d = 0; d < 3; ++d)
    section.require(box->periodic[d], "periodic",
                    "leaves walls across {}, and a case with [lubrication] has none; it must be "
                    "[true, true, true], or the case must have no [domain]",
                    kAxes[d]);
}

void refuse_solver(const case_file::TomlSection& root, const ParticlesCase& c) {
  if (!root.has("solver")) return;
  throw_bad_input({c.path.string(), root.section("solver").line(), "solver"},
                  "section [solver] has no effect beside [lubrication], whose steps have fixed "
                  "tolerances; the section must be left out");
}

}  // namespace

void check_beside_lubrication(const case_file::TomlSection& root, const ParticlesCase& c) {
  refuse_solver(root, c);
  root.section("space").require(c.particles.dimension == 3, "dimension",
                                "is {}; in a case with [lubrication] it must be 3",
                                root.section("space").shown("dimension"));
  for (const auto& [name, reason] : kRefusals) {
    if (!root.has(name)) continue;
    const int line = root.is_array_of_tables(name) ? root.sections(name).front().line()
                                                   : root.section(name).line();
    throw_bad_input({c.path.string(), line, name},
                    "section [{}] {}, which is not possible beside [lubrication]; the case must "
                    "have one of both sections",
                    name, reason);
  }
}

PairLubrication read_lubrication(const case_file::TomlSection& root, const Domain& domain,
                                 bool& compares) {
  check_domain(root, domain);
  LubricationKeys keys;
  case_file::read_keys(root.section("lubrication"), lubrication_keys, keys, domain);
  compares = keys.compares;
  return keys.pairs;
}

void check_range(const case_file::TomlSection& root, const ParticlesCase& c) {
  const double radius = std::ranges::max(c.particles.radii);
  // The largest distance of a pair; each pair has one image that is so near.
  const double distance = 2 * radius * (1 + c.setting.lubrication->range / 2);
  for (const double period : periods_of(c.setting.domain))
    if (period > 0 && !(period >= 2 * distance))
      root.section("domain").section("box").fail(
          "to",
          "makes the period {:.6g}, which is too short for the range of lubrication, {}, of the "
          "largest radius, {}; it must be at least {:.6g}, twice the largest distance of a pair",
          period, c.setting.lubrication->range, radius, 2 * distance);
}

void set_film_of_pairs(ParticlesCase& c) {
  const auto& pairs = *c.setting.lubrication;
  assert(pairs.pairs == PairTerms::kNone && c.particles.count() > 0);
  if (pairs.roughness == 0) return;
  auto& film = c.setting.laws.film;
  film.viscosity = pairs.viscosity;
  // The height of the roughness of each sphere; the solids touch at twice this gap.
  film.roughness = pairs.roughness * mean_radius(c.particles) / 2;
}

void lubricated_contact_keys(case_file::Keys& keys, ParticlesCase& c) {
  PairLubrication unread;
  auto& pairs = c.setting.lubrication ? *c.setting.lubrication : unread;
  for (const auto* key : {"gamma_min", "viscosity"})
    keys.require(!keys.has(key), key,
                 "must be left out, because it follows from lubrication.viscosity and roughness");
  for (const auto* key : {"restitution", "scheme"})
    keys.require(!keys.has(key), key, "is not possible with [lubrication]; it must be left out");
  const double rate = rate_of(pairs);
  const auto in_time = [&](double& time, std::string_view key, std::string_view in_strain,
                           const case_file::Help& help, const case_file::Help& help_in_strain,
                           const Allowed& allowed, bool is_required) {
    keys.required_if(is_required && !keys.has(in_strain), key, case_file::number(time, allowed),
                     help);
    double strain = 0;
    if (!keys.optional(in_strain, case_file::number(strain, allowed), help_in_strain)) return;
    keys.require(!keys.has(key), in_strain, "must be left out, because {} is given", key);
    keys.require(rate > 0, in_strain,
                 "needs a flow of a given rate, whose strain it is; lubrication.velocity must have "
                 "one, or the case {} in place of this key",
                 key);
    if (keys.reads()) time = strain / rate;
  };
  in_time(c.end_time, "end_time", "end_strain",
          {"end of the simulation. 0: no step is made, and the results are the velocities and the "
           "stress at the start",
           "required without `end_strain`"},
          {"in place of `end_time`, with a flow: the time over which the strain grows to this "
           "number. The rate of strain is the root of 2 E:E, with the symmetric part E of the "
           "velocity gradient: in a shear `shear_rate`, with `strain_rate` twice this rate",
           "from `end_time`"},
          kModeratelyPositiveOr0, true);
  keys.require(!pairs.stress || c.end_time == 0, "end_time",
               "is {}; it must be 0 with lubrication.velocity.stress, because steps need a given "
               "rate: the velocities and the rate at the start are computed",
               c.end_time);
  double& step = c.setting.time_step;
  const bool has_steps = c.end_time > 0 || !keys.reads();
  in_time(step, "time_step", "strain_step",
          {"at most `end_time`", "required without `strain_step`, unless `end_time` is 0"},
          {"in place of `time_step`, as `end_strain`", "from `time_step`"}, kModeratelyPositive,
          has_steps);
  if (!has_steps && step == 0) step = rate > 0 ? 1 / rate : 1;
  const char* step_key = keys.has("strain_step") ? "strain_step" : "time_step";
  // Times that come from strains have rounding errors.
  if (has_steps && step > c.end_time && step <= c.end_time * (1 + 1e-9)) step = c.end_time;
  keys.require(!has_steps || step <= c.end_time, step_key,
               "makes steps of the time {:.6g}; it must be at most the end, at the time {:.6g}",
               step, c.end_time);
  constexpr double kMostSteps = 1e9;  // more steps probably come from a wrong unit of time
  keys.require(c.end_time / step <= kMostSteps, step_key,
               "makes {:.3g} steps to the end; at most {:.0e} are allowed", c.end_time / step,
               kMostSteps);
  keys.optional("roughness", case_file::number(pairs.roughness, kRelativeLength),
                {"gap at which the solids touch, in mean radii of the pair"});
  keys.optional("repulsion",
                case_file::custom("`{ amplitude, length }`", read_repulsion, pairs.repulsion),
                {"a force that pushes close spheres apart", "none"});
}

std::vector<case_file::KeyTable> lubrication_tables() {
  return {case_file::describe_keys("[lubrication]", lubrication_keys, Domain{}),
          case_file::describe_keys("lubrication.velocity", flow_keys),
          case_file::describe_keys("[viscous_contact] with [lubrication]", lubricated_contact_keys),
          case_file::describe_keys("viscous_contact.repulsion", repulsion_keys)};
}

}  // namespace viscontact::particles
