// The keys of the case of one sphere, and the checks of their values.
#include "viscontact/case_file/case_file.hpp"

#include <cassert>
#include <cmath>
#include <system_error>
#include <utility>

#include "viscontact/case_file/shared_sections.hpp"
#include "viscontact/common/equal_up_to_rounding.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/lubrication/scaling.hpp"
#include "viscontact/lubrication/terms.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact::case_file {
namespace {

namespace fs = std::filesystem;
using lubrication::AboveInterval;
using lubrication::BelowInterval;
using reduced_model::ExternalForce;
using reduced_model::Motion;

/// The key `fix`, which fixes the coefficient of 1/q in the force, with the gap q. The value of the
/// key is the coefficient [M L^2/T^2], or "theory" for that of lubrication theory.
void read_fix(const TomlSection& section, std::string_view key, fitting::FitSettings& settings) {
  settings.fix_leading = true;
  if (!section.is_text(key))
    settings.leading_value = section.number(key, kFinite);
  else
    section.require(section.text(key) == "theory", key,
                    "is '{}'; it must be \"theory\" or a number, the coefficient of 1/q",
                    section.text(key));
}

/// The keys of [fit]: a fit file, relative to `folder` (the folder of the case), or the exact drag,
/// or else the settings of a fit of the table; and what replaces the fit outside its interval.
/// Throws Error(kBadInput) for `terms` together with `basis`.
void fit_keys(Keys& keys, FitRequest& fit, const fs::path& folder) {
  const auto read_file_name = [&](const TomlSection& section, std::string_view key) {
    fit.file = folder / section.file_name(key);
  };
  const auto read_exact = [&](const TomlSection& section, std::string_view key) {
    const auto walls = freefem_axi::geometries_with_exact_drag();
    const auto wall = section.text(key);
    section.require(find_named(walls, wall) != nullptr, key, "is '{}'; it must be \"{}\"", wall,
                    names_of(walls, "\" or \""));
    fit.exact = true;
  };
  auto& settings = fit.settings;
  if (!keys.optional(
          "file", custom("a file", read_file_name),
          {.meaning = "fit file, which is used unchanged, in place of a fit of the table",
           .example = "\"fit.json\""}) &&
      !keys.optional("exact", custom("`\"plane\"`", read_exact),
                     {.meaning = "the exact drag near a plane in a half-space, in place of a fit",
                      .example = "\"plane\""})) {
    // A key that is left out has the same default as the option of the command `fit`.
    const bool has_terms = keys.optional(
        "terms", parsed("such as `\"1/q, ln q, 1\"`", settings.basis, lubrication::parse_terms),
        {.meaning = "your own list of the terms that are fitted, in one text, in place of `basis`",
         .example = "\"1/q, ln q, 1\""});
    keys.require(!(has_terms && keys.has("basis")), "basis",
                 "must be left out, because the key terms defines the basis");
    if (!has_terms)
      keys.optional(
          "basis",
          parsed("name of a [basis](theory.md#2-the-fit)", settings.basis, lubrication::find_basis),
          {"the terms that are fitted; lecture is a/q + b + c q + d q² + e q³",
           "`\"lecture\"`",
           {},
           "\"lecture\""});
    keys.optional(
        "weights",
        parsed("`\"relative\"`, `\"absolute\"`", settings.weights, lubrication::parse_weights),
        {"which residuals are minimised", "`\"relative\"`", {}, "\"relative\""});
    keys.optional(
        "loss",
        parsed("`\"none\"`, `\"huber\"`, `\"cauchy\"`", settings.loss, lubrication::parse_loss),
        {"robust losses are for tables with wrong rows", "`\"none\"`", {}, "\"huber\""});
    keys.optional("fix", custom("`\"theory\"`, or a number", read_fix, settings),
                  {"fixes the coefficient of 1/q in the force at the first velocity: at theory's "
                   "value, or at the number",
                   "it is fitted",
                   {},
                   "\"theory\""});
  }
  keys.optional(
      "below",
      one_of(fit.outside.below, {{"lubrication_limit", BelowInterval::kLubricationLimit},
                                 {"theory_limit", BelowInterval::kTheoryLimit}}),
      {"the drag at gaps below the interval of the fit", "an error", {}, "\"lubrication_limit\""});
  keys.optional("above", one_of(fit.outside.above, {{"stokes_limit", AboveInterval::kStokesLimit}}),
                {"the drag at gaps above the interval of the fit, [up to a second "
                 "wall](physics.md#3-the-fit-fitting) if there is one",
                 "an error",
                 {},
                 "\"stokes_limit\""});
}

/// A piece of the external force: `until` [T], and `value` [M L/T^2] or a polynomial of the time
/// since the end of the piece before. Throws Error(kBadInput) if the case gives both, or none.
void piece_keys(Keys& keys, ExternalForce::Piece& piece) {
  keys.required("until", number(piece.until, kPositive),
                {"end of a piece of the force; the pieces follow each other from time 0"});
  const auto read_polynomial = [&](const TomlSection& section, std::string_view key) {
    const auto coefficients = section.numbers(key, kFinite);
    piece.value = coefficients.front();
    piece.higher.assign(coefficients.begin() + 1, coefficients.end());
  };
  const bool is_polynomial = keys.optional(
      "polynomial", custom("`[c0, c1, ...]`", read_polynomial),
      {"the piece is c0 + c1 tau + c2 tau² + ..., where tau is the time since it began"});
  keys.require(!(is_polynomial && keys.has("value")), "value",
               "must be left out, because the first coefficient of polynomial gives it");
  if (!is_polynomial)
    keys.required("value", number(piece.value, kFinite),
                  {"the constant force of the piece", "required without `polynomial`"});
}

/// A force with amplitude [M L/T^2], angular frequency [1/T] and phase in radians.
void sinusoid_keys(Keys& keys, ExternalForce::Sinusoid& sinusoid) {
  keys.required("amplitude", number(sinusoid.amplitude, kFinite),
                {"the force is `amplitude` sin(`angular_frequency` t + `phase`)"});
  keys.required("angular_frequency", number(sinusoid.angular_frequency, kPositive),
                {"belongs to `amplitude`"});
  keys.optional("phase", number(sinusoid.phase, kFinite), {"belongs to `amplitude`, in radians"});
}

void force_file_keys(Keys& keys, std::string& file) {
  keys.required("file", file_name(file), {"CSV file with the columns `time,force`"});
}

/// The path of a file that the case names relative to `folder`, the folder of the case. If there is
/// no such file, but `folder` itself contains a file of the same name, returns the path of that
/// file, because a run copies the case and the files that it names into one folder.
fs::path force_file(const fs::path& folder, const fs::path& file) {
  const auto copy = folder / file.filename();
  // exists() fails for a text that cannot be the name of a file; reading the file reports it.
  std::error_code ignored;
  return !fs::exists(folder / file, ignored) && fs::exists(copy, ignored) ? copy : folder / file;
}

/// The entries with `until` follow each other and make one force [M L/T^2]. Every other entry, a
/// sinusoid or a file, is added to it. Throws Error(kBadInput) if those with `until` end early.
void read_forces(const TomlSection& section, std::string_view key, Motion& motion, Case& c) {
  const double end_time = motion.end_time;
  std::vector<ExternalForce::Piece> pieces;
  std::vector<ExternalForce> summands;
  for (const auto& entry : section.sections(key)) {
    if (entry.has("file")) {
      std::string file;
      read_keys(entry, force_file_keys, file);
      c.force_files.push_back(force_file(c.path.parent_path(), file));
      summands.push_back(reduced_model::read_external_force(c.force_files.back(), end_time));
    } else if (entry.has("amplitude")) {
      ExternalForce::Sinusoid sinusoid;
      read_keys(entry, sinusoid_keys, sinusoid);
      summands.push_back(ExternalForce::sinusoidal(sinusoid));
    } else {
      read_keys(entry, piece_keys, pieces.emplace_back());
    }
  }
  if (!pieces.empty()) {
    summands.push_back(at_key(section, key, [&] { return ExternalForce(pieces); }));
    section.require(pieces.back().until >= end_time, key,
                    "ends at {}; it must reach motion.end_time, {}", pieces.back().until, end_time);
  }
  for (const auto& summand : summands) motion.external_force += summand;
}

/// The gaps are > 0 and differ.
void read_gaps_to_reach(const TomlSection& section, std::string_view key, Motion& motion) {
  motion.gaps_to_reach = section.numbers(key, kPositive);
  auto sorted = motion.gaps_to_reach;
  std::ranges::sort(sorted);
  const auto twice = std::ranges::adjacent_find(sorted);
  section.require(twice == sorted.end(), key, "has the gap {} twice; each gap may occur once",
                  twice == sorted.end() ? 0 : *twice);
}

/// A list of names of models.
auto models(std::vector<std::string>& place) {
  return custom("a list of names", [&](const TomlSection& section, std::string_view key) {
    place = section.texts(key);
    for (const auto& model : place)
      at_key(section, key, [&] { return reduced_model::find_model(model); });
  });
}

/// `time_scale` [1], > 0, keeps its value if the case does not give it. Throws Error(kBadInput) if
/// the weight is not finite.
void motion_keys(Keys& keys, Case& c, Motion& motion, double& time_scale) {
  keys.required("end_time", number(motion.end_time, kPositive),
                {.meaning = "end of the motion", .example = "4.0"});
  keys.required("initial_gap", number(motion.initial_gap, kPositive),
                {.meaning = "gap q at time 0", .example = "1.0"});
  keys.required(
      "initial_velocity", number(motion.initial_velocity, kFinite),
      {.meaning = "velocity u at time 0; positive: away from the wall", .example = "0.0"});
  const auto read_gravity = [&c, &motion](const TomlSection& section, std::string_view key) {
    c.gravity = section.number(key, kFinite);
    const double weight =
        mass_less_displaced_fluid(motion.mass, c.fluid_density, c.radius) * *c.gravity;
    section.require(std::isfinite(weight), key, "makes the weight {}, which is not finite", weight);
    motion.external_force += ExternalForce({{motion.end_time, weight}});
  };
  keys.optional("gravity", custom("a number", read_gravity),
                {"acceleration along the normal, negative towards the wall; the [weight less "
                 "buoyancy](physics.md#4-motion-of-one-sphere-reduced_model), (4.15), is added to "
                 "the external force",
                 "none",
                 {},
                 "-9.81"});
  keys.required_if(
      !keys.has("gravity"), "external_force", custom("a list of tables", read_forces, motion, c),
      {"the external force is the sum of these forces, which must last until `end_time`",
       "required without `gravity`",
       {},
       "[ { until = 2.0, value = -200.0 }, { until = 4.0, value = 200.0 } ]"});
  keys.optional("time_to_gap", custom("list of numbers > 0", read_gaps_to_reach, motion),
                {"gaps for each of which `compare` says when a model [first reaches "
                 "it](file-formats.md#time-to-a-gap)",
                 "none",
                 {},
                 "[1e-3, 1e-5]"});
  keys.optional("models", models(c.models),
                {"the models that are run",
                 "the first six of `viscontact simulate --help`",
                 {},
                 "[\"inertial\", \"viscous_contact\"]"});
  // The first and the last row are always written. A file of 1e8 rows has about 12 GB.
  keys.optional("rows", count(motion.output_rows, 2, 100'000'000),
                {"about how many rows a trajectory file has",
                 "[all](file-formats.md#fewer-rows)",
                 {},
                 "1000"});
  keys.optional(
      "time_scale", number(time_scale, kPositive),
      {"multiplies every time of `[motion]` and the time steps, and stretches the external force "
       "with them: f_ext(t/`time_scale`). The angular frequencies, the coefficients of polynomials "
       "and the times of files are those of the unscaled time"});
}

/// The heights of the roughness of sphere and plane [L]. Throws Error(kBadInput) unless they are
/// two numbers >= 0 whose sum is less than `radius`.
void read_roughness(const TomlSection& section, std::string_view key, const double& radius,
                    std::array<double, 2>& place) {
  const auto heights = section.numbers(key, kNotNegative);
  section.require(heights.size() == 2, key,
                  "contains {} number(s); it must be two numbers >= 0, the heights on the sphere "
                  "and on the plane",
                  heights.size());
  section.require(heights[0] + heights[1] < radius, key,
                  "adds up to {}; it must be less than the sphere's radius, {}",
                  heights[0] + heights[1], radius);
  place = {heights[0], heights[1]};
}

/// Those parameters of models that belong to `section`, and in one section the roughness, which is
/// a property of the surfaces and no parameter of a model. Each parameter of the motion has its
/// default already (set_default_parameters). Throws Error(kBadInput) for a time step that is longer
/// than the motion, or a coefficient of restitution without roughness.
void model_keys(Keys& keys, Case& c, Motion& motion, std::string_view section) {
  const double radius = c.radius;
  for (const auto& parameter : reduced_model::model_parameters()) {
    if (parameter.section() != section) continue;
    double value = motion.parameter(parameter);
    const bool is_given = keys.optional(parameter.name(), number(value, parameter.allowed),
                                        {parameter.description, parameter.fallback_words});
    keys.require(!is_given || !parameter.is_time_step || value <= motion.end_time, parameter.name(),
                 "is {}; it must be a number > 0 and at most motion.end_time, {}", value,
                 motion.end_time);
    motion.set(parameter, value);
  }
  if (section == reduced_model::section_of(reduced_model::kRoughnessKey))
    keys.optional(reduced_model::name_of(reduced_model::kRoughnessKey),
                  custom("`[r1, r2]`, two numbers >= 0", read_roughness, radius, motion.roughness),
                  {"heights of the roughness of sphere and wall; their sum is less than the radius",
                   "`[0, 0]`, smooth",
                   {},
                   "[0.0, 0.0]"});
  if (section == reduced_model::kRestitution.section())
    keys.require(motion.restitution() == 0 || motion.roughness[0] + motion.roughness[1] > 0,
                 reduced_model::kRestitution.name(),
                 "is {}; it is the coefficient of solids that touch, which needs a roughness whose "
                 "heights together are > 0",
                 motion.restitution());
}

/// Sets the defaults for this motion and this radius [L]. All defaults are computed before the
/// first one is set, so that none depends on another one.
void set_default_parameters(Motion& motion, double radius) {
  assert(radius > 0);
  const auto parameters = reduced_model::model_parameters();
  std::vector<double> values;
  for (const auto& parameter : parameters) values.push_back(parameter.fallback(motion, radius));
  for (std::size_t i = 0; i < values.size(); ++i) motion.set(parameters[i], values[i]);
}

/// Multiplies all times by `scale`. Throws Error(kBadInput) if one is then no normal double.
void stretch(const TomlSection& section, double scale, Motion& motion) {
  assert(scale > 0);
  bool representable = std::isnormal(motion.end_time);
  const auto stretched = [&](double time) {
    representable = representable && std::isnormal(time * scale);
    return time * scale;
  };
  motion.external_force = motion.external_force.stretched(scale);
  motion.end_time = stretched(motion.end_time);
  for (const auto& parameter : reduced_model::model_parameters())
    if (parameter.is_time_step) motion.set(parameter, stretched(motion.parameter(parameter)));
  section.require(representable, "time_scale",
                  "is {}; every time multiplied by it must stay within the range of a double",
                  scale);
}

/// Without a force, because the forces of the case are added to it.
Motion empty_motion() { return {0, 0, 0, 0, ExternalForce({{1, 0}})}; }

/// A section with parameters of models is checked even if no model uses it.
Motion read_motion(const TomlSection& root, double mass, Case& c) {
  const auto section = root.section("motion");
  auto motion = empty_motion();
  motion.mass = mass;
  double time_scale = 1;
  read_keys(section, motion_keys, c, motion, time_scale);
  set_default_parameters(motion, c.radius);
  for (const auto& name : reduced_model::model_sections())
    if (root.has(name)) read_keys(root.section(name), model_keys, c, motion, name);
  if (section.has("time_scale")) stretch(section, time_scale, motion);
  return motion;
}

void published_keys(Keys& keys, PublishedGap& published) {
  keys.required("minimal_gap", number(published.minimal_gap, kPositive),
                {"a published value, for the report"});
  keys.required("source", text(published.source), {"where it was published"});
}

void sweep_keys(Keys& keys, SweepRequest& sweep) {
  keys.required("vary", texts(sweep.vary), {"`KEY=RANGE` each, as on the command line"});
  keys.optional("models", models(sweep.models), {"the models that are run", "that of the command"});
  keys.optional("reference", text(sweep.reference),
                {"the model that others are compared with", "that of the command"});
  points_and_plot_keys(keys, sweep);
}

/// Refuses the exact drag near a plane for other geometries.
void check_exact_drag(const TomlSection& root, const Case& c) {
  if (!c.tabulation || freefem_axi::find_geometry(c.tabulation->geometry).has_exact_drag) return;
  if (c.fit)
    root.section("fit").require(!c.fit->exact, "exact",
                                "is the drag near a plane; tabulation.geometry is {}, for which "
                                "the exact drag is not known",
                                c.tabulation->geometry);
  for (const auto& model : c.models)
    root.section("motion").require(
        !reduced_model::find_model(model).exact_drag, "models",
        "contains {}, which runs with the exact drag near a plane; tabulation.geometry is {}",
        model, c.tabulation->geometry);
}

/// Throws Error(kBadInput), which names the section, if the case does not have this part.
template <class Part>
const Part& required(const std::optional<Part>& part, const Case& c, std::string_view section) {
  if (!part)
    throw_bad_input({c.path.string(), 0, std::string(section)},
                    "has no section [{}], which this command needs", section);
  return *part;
}

}  // namespace

CaseKind kind_of_case(const fs::path& path) {
  std::error_code none;  // read_toml_file() says what is wrong
  if (fs::is_fifo(path, none))
    throw_bad_input({path.string()},
                    "is a pipe, which can be read only once; save the case in a file first");
  const auto root = read_toml_file(path).root;
  if (root.has("space")) return CaseKind::kParticles;
  if (root.has("swimmer")) return CaseKind::kSwimmer;
  return root.has("rolling") ? CaseKind::kRolling : CaseKind::kSphere;
}

void read_root(const TomlSection& root, Case& c) {
  read_title_and_units(root, c, true);
  read_keys(root.section("fluid"), fluid_keys, c.viscosity, c.fluid_density);
  double mass = 1;  // without [motion] nothing depends on the mass
  const bool needs_mass = root.has("motion");
  read_keys(root.section("sphere"), sphere_keys, c.radius, c.density, mass, needs_mass);
  if (root.has("tabulation"))
    c.tabulation = read_tabulation(root.section("tabulation"), c.viscosity, c.radius);
  if (root.has("fit"))
    read_keys(root.section("fit"), fit_keys, c.fit.emplace(), c.path.parent_path());
  if (root.has("motion")) {
    c.motion = read_motion(root, mass, c);
    c.motion->fluid_density = c.fluid_density;
  }
  if (root.has("published"))
    read_keys(root.section("published"), published_keys, c.published.emplace());
  check_exact_drag(root, c);
  if (root.has("sweep")) read_keys(root.section("sweep"), sweep_keys, c.sweep.emplace());
  // has() makes finish() accept these sections, which a case without [motion] may have, too.
  for (const auto& name : reduced_model::model_sections()) (void)root.has(name);
  root.finish();
}

lubrication::Fit fit_for(const Case& c, lubrication::Fit fit, const fs::path& file) {
  const double radius = fit.radius;
  fit = lubrication::scaled_to(std::move(fit), c.viscosity, c.radius);
  if (!c.tabulation || is_exact_plane(fit) || equal_up_to_rounding(radius, c.radius)) return fit;
  const auto check = [&](std::string_view key, const std::string& of_fit,
                         const std::string& of_case) {
    if (!of_fit.empty() && !lubrication::same_words(of_fit, of_case))
      throw_bad_input({file.string(), 0, std::string(key)},
                      "the {} of the fit, scaled from the radius {} to {}, is '{}'; that of the "
                      "case is '{}'. Both must be equal in radii",
                      key, radius, c.radius, of_fit, of_case);
  };
  check("geometry", fit.geometry, geometry_in_words(*c.tabulation));
  check("container", fit.container, container_in_words(*c.tabulation));
  return fit;
}

template <>
std::vector<std::string_view> sections_with_defaults<Case>() {
  const auto sections = reduced_model::model_sections();
  return {sections.begin(), sections.end()};
}

Case read_case(const fs::path& path) { return read_case_file<Case>(path); }

std::vector<KeyTable> tables_of_sphere_case() {
  // docs/case-file.md shows the default of a model's parameter as its example. It can depend on the
  // motion and the radius, which get here the examples of their own keys.
  auto motion = empty_motion();
  motion.end_time = 4;
  motion.initial_gap = 1;
  set_default_parameters(motion, 1);
  double mass = 0, density = 0, time_scale = 1;
  std::vector<KeyTable> tables = {describe_keys("[fluid]", fluid_keys, density),
                                  describe_keys("[sphere]", sphere_keys, density, mass, true)};
  for (auto& table : tables_of_tabulation()) tables.push_back(std::move(table));
  tables.push_back(describe_keys("[fit]", fit_keys, {}));
  tables.push_back(describe_keys("[motion]", motion_keys, motion, time_scale));
  tables.push_back(describe_keys("motion.external_force", piece_keys));
  for (const auto& more : {describe_keys("", sinusoid_keys), describe_keys("", force_file_keys)})
    tables.back().rows.insert(tables.back().rows.end(), more.rows.begin(), more.rows.end());
  for (const auto& name : reduced_model::model_sections())
    tables.push_back(describe_keys(fmt::format("[{}]", name), model_keys, motion, name));
  tables.push_back(table_of_units());
  tables.push_back(describe_keys("[sweep]", sweep_keys));
  tables.push_back(describe_keys("[published]", published_keys));
  return tables;
}

const freefem_axi::Tabulation& required_tabulation(const Case& c) {
  return required(c.tabulation, c, "tabulation");
}
const FitRequest& required_fit(const Case& c) { return required(c.fit, c, "fit"); }
const reduced_model::Motion& required_motion(const Case& c) {
  return required(c.motion, c, "motion");
}

}  // namespace viscontact::case_file
