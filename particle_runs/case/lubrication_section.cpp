// Reads [lubrication], and [viscous_contact] beside it.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "viscontact/common/error.hpp"
#include "viscontact/motions/fitted_pairs.hpp"
#include "viscontact/particle_runs/case/particles_sections.hpp"
#include "viscontact/particles/setting/lubrication_faults.hpp"
#include "viscontact/particles/setting/plane_beside_flow.hpp"
#include "viscontact/suspensions/cell/lattice_fault.hpp"
#include "viscontact/suspensions/cell/strained_lattice.hpp"

namespace viscontact::particles {
namespace {

constexpr Allowed kRange = {[](double v) { return v >= 1e-3 && v <= 100; }, "from 1e-3 to 100"};
constexpr double kLargestRangeInBox = 2;  // beyond it other spheres are between those of a pair
constexpr Allowed kRelativeLength = {[](double v) { return v == 0 || (v >= 1e-12 && v <= 0.1); },
                                     "0, or from 1e-12 to 0.1"};
constexpr Allowed kDrag = {[](double v) { return v >= 1e-12 && v <= 1e6; }, "from 1e-12 to 1e6"};

/// A number or a gradient that may change in time: one piece if it is constant.
template <class Value>
struct InTime {
  struct Piece {
    double until = 0;  // [T]
    Value value{};
  };
  std::vector<Piece> pieces;  // the last one holds for ever
  std::optional<Wave> wave;   // in place of pieces

  bool is_given() const { return wave || !pieces.empty(); }
};

/// The flow around the spheres, of which one is given.
struct FlowKeys {
  InTime<double> shear_rate, strain_rate;  // [1/T]
  InTime<Gradient> gradient;               // [1/T]
  InTime<double> stress;                   // [M/(L T^2)]
};

/// Throws Error(kBadInput) unless there are three rows, and if the trace is not 0.
void read_gradient(const case_file::TomlSection& section, std::string_view key,
                   Gradient& gradient) {
  const auto rows = section.rows(key, 3, kModerate);
  section.require(rows.size() == 3, key, "has {} rows; it must have 3, of du/dx, dv/dx and dw/dx",
                  rows.size());
  double trace = 0, largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    std::ranges::copy(rows[i], gradient[i].begin());
    trace += gradient[i][i];
    for (const double entry : gradient[i]) largest = std::max(largest, std::abs(entry));
  }
  constexpr double kRounding = 1e-12;  // of numbers that users round
  section.require(std::abs(trace) <= kRounding * largest, key,
                  "has the trace {:.6g}; it must be 0, because the fluid is incompressible", trace);
}

void read_value(const case_file::TomlSection& section, std::string_view key, double& value) {
  value = section.number(key, kModerate);
}
void read_value(const case_file::TomlSection& section, std::string_view key, Gradient& value) {
  read_gradient(section, key, value);
}

void wave_keys(case_file::Keys& keys, Wave& wave) {
  keys.required("amplitude", case_file::number(wave.amplitude, kModerate),
                {"the value is `mean` + `amplitude` sin(`angular_frequency` t + `phase`)"});
  keys.required("angular_frequency", case_file::number(wave.angular_frequency, kModeratelyPositive),
                {"2 pi over the period"});
  keys.optional("mean", case_file::number(wave.mean, kModerate), {"the mean over a period"});
  keys.optional("phase", case_file::number(wave.phase, kModerate), {"in radians"});
}

/// Reads a constant, a list of tables { until, value }, or a wave, which a gradient cannot be.
template <class Value>
void read_in_time(const case_file::TomlSection& section, std::string_view key,
                  InTime<Value>& place) {
  if constexpr (std::is_same_v<Value, double>)
    if (section.is_table(key)) {
      case_file::read_keys(section.section(key), wave_keys, place.wave.emplace());
      return;
    }
  if (!section.is_array_of_tables(key)) {
    read_value(section, key, place.pieces.emplace_back().value);
    return;
  }
  double before = 0;
  for (const auto& entry : section.sections(key)) {
    auto& piece = place.pieces.emplace_back();
    piece.until = entry.number("until", kPositive);
    entry.require(piece.until > before, "until",
                  "is {}; it must be greater than {}, where the piece before ends", piece.until,
                  before);
    read_value(entry, "value", piece.value);
    entry.finish();
    before = piece.until;
  }
}

void flow_keys(case_file::Keys& keys, FlowKeys& flow) {
  constexpr std::string_view kNumber = "a number, pieces or a wave";
  keys.optional("shear_rate", case_file::custom(kNumber, read_in_time<double>, flow.shear_rate),
                {"s: the velocity of the fluid is (s y, 0, 0)", "one of these keys is required"});
  keys.optional("strain_rate", case_file::custom(kNumber, read_in_time<double>, flow.strain_rate),
                {"s: the velocity of the fluid is (s x, -s y, 0)", "likewise"});
  keys.optional("gradient",
                case_file::custom("`[[..], [..], [..]]`, without a trace, or pieces",
                                  read_in_time<Gradient>, flow.gradient),
                {"row i has the derivatives of component i of the velocity along x, y and z. In a "
                 "box with three periods see [strained cells](suspensions.md#strained-cells); "
                 "beside walls and planes it must be a shear along them",
                 "likewise"});
  keys.optional("stress", case_file::custom(kNumber, read_in_time<double>, flow.stress),
                {"mean shear stress of the suspension in a box, component xy: the flow is that of "
                 "`shear_rate`, and the rate a result of each step",
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

/// The key of the flow that a fault is about.
std::string_view key_in(const case_file::TomlSection& flow, std::string_view key) {
  return flow.has("gradient") ? "gradient" : key;
}

/// Throws Error(kBadInput) if the flow would not move each image of the spheres in a periodic box
/// along its period, and if there is a stress without a box.
void check_flow(const case_file::TomlSection& section, const PairLubrication& pairs,
                const Domain& domain) {
  if (const auto fault = fault_of_flow(pairs, domain))
    section.fail(key_in(section, fault->key), fault->message);
  const auto walls = obstacles_of(domain);
  for (const auto& wall : walls)
    if (const auto fault = fault_of_plane(wall, pairs, true))
      section.fail(section.has("strain_rate") ? "strain_rate" : key_in(section, "shear_rate"),
                   "goes through a wall of the box or changes along it; it must be a shear along "
                   "all walls, which move with it, or the fluid at rest");
  if (const auto fault = fault_of_stress(pairs, !walls.empty()))
    section.fail(fault->key, fault->message);
  const bool has_box = !std::holds_alternative<std::monostate>(domain);
  section.require(has_box || !pairs.stress, "stress",
                  "is that of a suspension in a volume; the case must have a [domain] with a box");
}

/// Sets the flow of the pieces or of the wave of `given`. `set` sets that of a value; of the value
/// 1 it is that of a wave.
template <class Value, class Set>
void set_flow(const InTime<Value>& given, PairLubrication& pairs, const Set& set) {
  if (!given.is_given()) return;
  if constexpr (std::is_same_v<Value, double>)
    if (given.wave) {
      FlowPiece flow;
      set(flow, 1.0);
      pairs.gradient = flow.gradient;
      pairs.stress = flow.stress;
      pairs.wave = given.wave;
      return;
    }
  for (const auto& piece : given.pieces) {
    auto& flow = pairs.pieces.emplace_back();
    flow.until = piece.until;
    set(flow, piece.value);
  }
  pairs.gradient = pairs.pieces.front().gradient;
  pairs.stress = pairs.pieces.front().stress;
  if (pairs.pieces.size() == 1) pairs.pieces.clear();
}

void read_flow(const case_file::TomlSection& section, std::string_view key, PairLubrication& pairs,
               const Domain& domain) {
  FlowKeys keys;
  const auto table = section.section(key);
  case_file::read_keys(table, flow_keys, keys);
  set_flow(keys.shear_rate, pairs, [](FlowPiece& flow, double s) { flow.gradient[0][1] = s; });
  set_flow(keys.strain_rate, pairs, [](FlowPiece& flow, double s) {
    flow.gradient[0][0] = s;
    flow.gradient[1][1] = -s;
  });
  set_flow(keys.gradient, pairs,
           [](FlowPiece& flow, const Gradient& gradient) { flow.gradient = gradient; });
  set_flow(keys.stress, pairs, [](FlowPiece& flow, double stress) {
    flow.gradient[0][1] = 1;
    flow.stress = stress;
  });
  check_flow(table, pairs, domain);
}

void read_truth(const case_file::TomlSection& section, std::string_view key, bool& place) {
  place = section.truth(key);
}

/// True if the images of the particles across the period y may be displaced along x.
bool has_images_across(const Domain& domain) {
  const auto periods = periods_of(domain);
  return periods[0] > 0 && periods[1] > 0;
}

/// Whether some box with three periods is turned for its flow.
bool has_turn(const PairLubrication& pairs, const Domain& domain) {
  using suspensions::StrainedLattice;
  return strains_cell(pairs, domain) &&
         StrainedLattice::kind_of(path_of(pairs).direction) != StrainedLattice::Kind::kAsTheBox;
}

struct LubricationKeys {
  PairLubrication pairs;
  std::string fits;  // a folder
  bool compares = false;
};

/// The keys of the flow, of the box in it, and of the inertia, which some flows do not allow.
void keys_of_flow(case_file::Keys& keys, PairLubrication& pairs, const Domain& domain) {
  keys.optional("velocity", case_file::custom("a table, see below", read_flow, pairs, domain),
                {"the linear flow around the spheres", "at rest"});
  keys.optional("offset", case_file::number(pairs.offset, kModerate),
                {"displacement along x, at the start, of the periodic image across y"});
  keys.require(!keys.has("offset") || has_images_across(domain), "offset",
               "has no effect without periods along x and y; it must be left out, or the case must "
               "have a [domain] with such a box");
  keys.require(!keys.has("offset") || !strains_cell(pairs, domain), "offset",
               "belongs to a shear along x that changes along y; it must be left out");
  keys.optional("turned", case_file::custom("`true` or `false`", read_truth, pairs.turns_box),
                {"whether a periodic box, with its spheres, is turned at the start so that an "
                 "extension can go on for ever ([suspensions.md](suspensions.md#strained-cells))",
                 "`true`"});
  keys.require(!keys.has("turned") || has_turn(pairs, domain), "turned",
               "has no effect, because no turn of a box with three periods keeps images apart in "
               "this flow, or none is needed; it must be left out");
  keys.optional("inertia", case_file::custom("`true` or `false`", read_truth, pairs.inertia),
                {"whether the spheres have inertia, and not the fluid: they then need masses, and "
                 "may have velocities at the start",
                 "`false`"});
  const auto fault = fault_of_inertia(pairs, domain);
  keys.require(!fault, "inertia", "{}", fault ? fault->message : "");
}

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
  keys_of_flow(keys, pairs, domain);
  keys.optional(
      "compare", case_file::custom("`true` or `false`", read_truth, read.compares),
      {"whether the case is run a second time with `pairs = \"none\"`, and the page shows "
       "both ([suspensions.md](suspensions.md#comparison))",
       "`false`"});
  keys.optional(
      "fits", case_file::file_name(read.fits),
      {"with `pairs = \"tables\"`: an own [fit](suspensions.md#own-fits), or a folder with such "
       "files "
       "`*.json`, which take the place of the shipped tables at the ratios of radii and the "
       "gaps that they have",
       "the shipped tables"});
  keys.require(pairs.pairs == PairTerms::kTables || !keys.has("fits"), "fits",
               "belongs to pairs = \"tables\"; it must be left out");
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
});

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

void read_lubrication(const case_file::TomlSection& root, ParticlesCase& c) {
  LubricationKeys keys;
  const auto section = root.section("lubrication");
  case_file::read_keys(section, lubrication_keys, keys, c.setting.domain);
  c.compares = keys.compares;
  if (!keys.fits.empty())
    case_file::at_key(section, "fits", [&] {
      c.fit_files = motions::fit_files_in(c.path.parent_path() / keys.fits);
      keys.pairs.fits =
          std::make_shared<motions::FittedPairs>(motions::read_fitted_pairs(c.fit_files));
    });
  c.setting.lubrication = std::move(keys.pairs);
}

void check_plane_in_flow(const case_file::TomlSection& section, const Plane& plane,
                         const ParticlesCase& c) {
  const auto& pairs = *c.setting.lubrication;
  const auto require_none = [&](const std::optional<SettingFault>& fault) {
    if (fault) section.fail(fault->key, fault->message);
  };
  require_none(fault_of_planes(pairs, c.setting.domain));
  require_none(fault_of_plane(plane, pairs, false));
  double t = 0;
  do {
    const auto flow = pairs.flow_at(t);
    auto gradient = flow.gradient;
    // A plane in a wave is where the fluid always rests.
    for (auto& row : gradient) row = (pairs.wave ? pairs.wave->largest() : 1) * row;
    require_none(fault_of_motion(plane, gradient, t, t));
    // The last piece of the flow holds for ever.
    t = std::min(plane.velocity.next_end(t), flow.until > t ? flow.until : c.end_time);
  } while (t < c.end_time);
}

void check_pieces_of_flow(const case_file::TomlSection& root, const ParticlesCase& c) {
  const auto section = root.section("lubrication");
  if (!section.has("velocity")) return;
  const auto flow = section.section("velocity");
  for (const auto* key : {"shear_rate", "strain_rate", "gradient", "stress"}) {
    if (!flow.has(key) || !flow.is_array_of_tables(key)) continue;
    double before = 0;
    for (const auto& piece : flow.sections(key)) {
      const double until = piece.number("until", kPositive);
      const auto fault = fault_of_piece(until - before, c.setting.time_step);
      if (fault && c.end_time > 0) piece.fail(fault->key, fault->message);
      before = until;
    }
    flow.require(before >= c.end_time * (1 - 1e-9), key,  // 1e-9 is far above rounding errors
                 "ends at {}; it must reach the end of the case, at the time {}", before,
                 c.end_time);
  }
}

void check_weights(const case_file::TomlSection& root, const ParticlesCase& c) {
  root.section("space").require(
      c.setting.gravity == Vector{} ||
          std::ranges::any_of(c.particles.masses, [](double mass) { return mass > 0; }),
      "gravity",
      "has no effect, because no sphere has a mass or density; it must be 0 or left out, or "
      "spheres "
      "must have one");
}

void set_velocities_of_flow(const GivenAtStart& given, ParticlesCase& c) {
  const auto& pairs = *c.setting.lubrication;
  const double rate = pairs.factor(0, 0);
  const auto g = pairs.flow_at(0).gradient;
  const Vector turn{(g[2][1] - g[1][2]) / 2, (g[0][2] - g[2][0]) / 2, (g[1][0] - g[0][1]) / 2};
  auto& p = c.particles;
  for (std::size_t k = 0; k < p.count(); ++k)
    for (std::size_t d = 0; d < 3; ++d) {
      if (k >= given.velocities.size() || !given.velocities[k])
        p.velocities[3 * k + d] = rate * dot(g[d], p.position(k));
      if (k >= given.turns.size() || !given.turns[k])
        p.angular_velocities[3 * k + d] = rate * turn[d];
    }
}

namespace {

/// Throws Error(kBadInput) if the box cannot be turned for its flow, or if its faces would come too
/// near for pairs of the length `pair_length` [L].
void check_strained_box(const case_file::TomlSection& root, ParticlesCase& c, double pair_length) {
  using suspensions::StrainedLattice;
  auto& pairs = *c.setting.lubrication;
  if (!has_turn(pairs, c.setting.domain) || !pairs.turns_box) return;
  const auto lubrication = root.section("lubrication");
  if (c.end_time == 0) {
    lubrication.require(!lubrication.has("turned"), "turned",
                        "is true, and the case ends at the time 0; the box is not turned for an "
                        "instant, and the key must be left out");
    pairs.turns_box = false;
    return;
  }
  const auto [direction, sign, lowest] = path_of(pairs);
  const auto lengths = periods_of(c.setting.domain);
  const auto [shortest, longest] = std::ranges::minmax(lengths);
  constexpr double kRounding = 1e-12;
  const auto kind = StrainedLattice::kind_of(direction);
  const auto box = root.section("domain").section("box");
  box.require(kind != StrainedLattice::Kind::kCubic || longest - shortest <= kRounding * longest,
              "to",
              "makes edges from {:.6g} to {:.6g}; an extension along three axes turns the box and "
              "needs a cube, or lubrication.turned must be false, with which the strain is limited",
              shortest, longest);
  const StrainedLattice lattice(lengths, direction, true);
  const auto flow = lubrication.section("velocity");
  const auto fault = suspensions::fault_of_lattice(lattice, pair_length, lowest);
  if (!fault) return;
  if (box.has(fault->key)) box.fail(fault->key, fault->message);
  flow.fail(key_in(flow, fault->key), fault->message);
}

}  // namespace

void check_range(const case_file::TomlSection& root, ParticlesCase& c) {
  const double radius = std::ranges::max(c.particles.radii);
  const double pair_length = 2 * radius * (1 + c.setting.lubrication->range / 2);
  if (const auto fault = fault_of_periods(c.setting.domain, pair_length))
    root.section("domain").section("box").fail(fault->key, fault->message);
  check_strained_box(root, c, pair_length);
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

namespace {

/// The end and the step, as times or as strains of the flow.
void time_keys(case_file::Keys& keys, const PairLubrication& pairs, ParticlesCase& c) {
  const double rate = largest_rate_of_strain(pairs);
  const auto in_time = [&](double& time, std::string_view key, std::string_view in_strain,
                           const case_file::Help& help, const case_file::Help& help_in_strain,
                           const Allowed& allowed, bool is_required, const auto& time_of) {
    keys.required_if(is_required && !keys.has(in_strain), key, case_file::number(time, allowed),
                     help);
    double strain = 0;
    if (!keys.optional(in_strain, case_file::number(strain, allowed), help_in_strain)) return;
    keys.require(!keys.has(key), in_strain, "must be left out, because {} is given", key);
    keys.require(rate > 0, in_strain,
                 "needs a flow of a given rate, whose strain it is; lubrication.velocity must have "
                 "one, or the case {} in place of this key",
                 key);
    if (!keys.reads()) return;
    time = time_of(strain);
    keys.require(std::isfinite(time), in_strain,
                 "is {}, which the strain does not reach, because the flow stops before; the case "
                 "must have {} in place of this key",
                 strain, key);
  };
  in_time(c.end_time, "end_time", "end_strain",
          {"end of the simulation. 0: no step is made, no box is turned, and the results are the "
           "velocities and the stress at the start",
           "required without `end_strain`"},
          {"in place of `end_time`, with a flow: the time over which the strain grows to this "
           "number. The rate of strain is the root of 2 E:E, with the symmetric part E of the "
           "velocity gradient: in a shear the magnitude of `shear_rate`, with `strain_rate` twice "
           "this magnitude. In both directions of a flow the strain grows",
           "from `end_time`"},
          kModeratelyPositiveOr0, true,
          [&](double strain) { return time_of_strain(pairs, strain); });
  double& step = c.setting.time_step;
  const bool has_steps = c.end_time > 0 || !keys.reads();
  in_time(step, "time_step", "strain_step",
          {"at most `end_time`", "required without `strain_step`, unless `end_time` is 0"},
          {"in place of `time_step`, as `end_strain`; in a flow whose rate changes the strain of a "
           "step at the largest rate",
           "from `time_step`"},
          kModeratelyPositive, has_steps, [&](double strain) { return strain / rate; });
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
}

}  // namespace

void lubricated_contact_keys(case_file::Keys& keys, ParticlesCase& c) {
  PairLubrication unread;
  auto& pairs = c.setting.lubrication ? *c.setting.lubrication : unread;
  for (const auto* key : {"gamma_min", "viscosity"})
    keys.require(!keys.has(key), key,
                 "must be left out, because it follows from lubrication.viscosity and roughness");
  for (const auto* key : {"restitution", "scheme"})
    keys.require(!keys.has(key), key, "is not possible with [lubrication]; it must be left out");
  time_keys(keys, pairs, c);
  keys.optional("roughness", case_file::number(pairs.roughness, kRelativeLength),
                {"gap at which the solids touch, in mean radii of the pair"});
  keys.optional("repulsion",
                case_file::custom("`{ amplitude, length }`", read_repulsion, pairs.repulsion),
                {"a force that pushes close spheres apart", "none"});
}

std::vector<case_file::KeyTable> lubrication_tables() {
  return {case_file::describe_keys("[lubrication]", lubrication_keys, Domain{}),
          case_file::describe_keys("lubrication.velocity", flow_keys),
          case_file::describe_keys("lubrication.velocity.shear_rate", wave_keys),
          case_file::describe_keys("[viscous_contact] with [lubrication]", lubricated_contact_keys),
          case_file::describe_keys("viscous_contact.repulsion", repulsion_keys)};
}

}  // namespace viscontact::particles
