// Reads the case file of one sphere (case_file.hpp). Each function reads one section or key, checks
// it and applies defaults. Lengths, masses and times are in the units of the case.
#include "viscontact/case_file/case_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <system_error>
#include <utility>

#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/lubrication/terms.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact {
namespace {

constexpr Allowed kFraction = {[](double v) { return v > 0 && v < 1; }, "between 0 and 1"};
constexpr Allowed kOdeTolerance = {[](double v) { return v >= 1e-13 && v <= 1e-2; },
                                   "between 1e-13 and 1e-2"};

/// Calls `check`, which tests a value in another part of the program, and gives its error the key
/// and the line of this file.
template <class Check>
auto at_key(const TomlSection& section, std::string_view key, const Check& check) {
  try {
    return check();
  } catch (const Error& error) {
    section.fail(key, fmt::format("is not accepted: {}", error.what()));
  }
}

/// Reads `gaps` [L]: a list, or { from, to, count, spacing }. Returns them in rising order.
std::vector<double> read_gaps(const TomlSection& tabulation) {
  if (tabulation.is_array("gaps")) {
    auto gaps = tabulation.numbers("gaps", kPositive);
    std::ranges::sort(gaps);
    if (std::ranges::adjacent_find(gaps) != gaps.end())
      tabulation.fail("gaps", "contains the same gap twice; each gap must be there once");
    return gaps;
  }
  const auto grid = tabulation.section("gaps");
  const double from = grid.number("from", kPositive);
  const double to = grid.number("to", kPositive);
  const int count = grid.count("count", 2, 100000);
  const std::string spacing = grid.text("spacing");
  grid.finish();
  if (!(to > from))
    grid.fail("to", fmt::format("is {}; it must be greater than from, {}", to, from));
  if (spacing != "log" && spacing != "linear")
    grid.fail("spacing", fmt::format("is '{}'; it must be \"log\" or \"linear\"", spacing));
  std::vector<double> gaps;
  for (int i = 0; i < count; ++i) {
    const double w = static_cast<double>(i) / (count - 1);
    gaps.push_back(spacing == "log" ? from * std::pow(to / from, w) : std::lerp(from, to, w));
  }
  gaps.back() = to;
  if (std::ranges::adjacent_find(gaps, std::greater_equal()) != gaps.end())
    grid.fail("count", fmt::format("is {}; there are not so many different numbers of double "
                                   "precision from {} to {}",
                                   count, from, to));
  return gaps;
}

void read_geometry(const TomlSection& tabulation_section, Tabulation& tabulation) {
  if (!tabulation_section.has("geometry")) return;  // the default geometry is a plane
  const auto section = tabulation_section.section("geometry");
  tabulation.geometry = section.text("kind");
  const auto& geometry = at_key(
      section, "kind", [&]() -> auto& { return find_geometry(tabulation.geometry); });
  for (const auto& parameter : geometry.parameters) {
    const std::string key(parameter.key);
    tabulation.geometry_parameters.push_back(parameter.fallback && !section.has(key)
                                                 ? *parameter.fallback
                                                 : section.number(key, parameter.allowed));
  }
  section.finish();
}

/// Reads `container`: { radius, height } [L], which must contain the sphere and its neighbour at
/// every gap, or "unbounded".
void read_container(const TomlSection& section, const RequiredSpace& room, Tabulation& tabulation) {
  if (!find_geometry(tabulation.geometry).takes_container) {
    if (section.has("container"))
      section.fail("container", fmt::format("must be left out, because a {} is its own container",
                                            tabulation.geometry));
    return;
  }
  if (section.is_text("container")) {
    if (const auto text = section.text("container"); text != "unbounded")
      section.fail(
          "container",
          fmt::format(
              "is '{}'; it must be \"unbounded\" or a table {{ radius = ..., height = ... }}",
              text));
    return;
  }
  const auto table = section.section("container");
  const Container container{table.number("radius", kPositive), table.number("height", kPositive)};
  table.finish();
  if (!(container.radius > room.container_radius))
    table.fail("radius",
               fmt::format("is {}; it must be greater than {}, the radius of sphere and neighbour",
                           container.radius, room.container_radius));
  if (!(container.height > room.container_height))
    table.fail(
        "height",
        fmt::format("is {}; it must be greater than {}, what the largest gap, the sphere and "
                    "its neighbour need",
                    container.height, room.container_height));
  // In larger containers FreeFEM's mesh generator cannot make edges that are short enough for the
  // gap (graded_boundary.idp). A container of this size hardly differs from unbounded fluid.
  constexpr double kLargest = 2e5;
  for (const auto& [key, length] :
       {std::pair("radius", container.radius), std::pair("height", container.height)})
    if (length > kLargest * tabulation.radius)
      table.fail(key, fmt::format(
                          "is {}; it must be at most {} sphere radii, {}, or the container must be "
                          "\"unbounded\"",
                          length, kLargest, kLargest * tabulation.radius));
  tabulation.container = container;
}

Tabulation read_tabulation(const TomlSection& section, double viscosity, double radius) {
  Tabulation tabulation;
  tabulation.viscosity = viscosity;
  tabulation.radius = radius;
  tabulation.gaps = read_gaps(section);
  tabulation.reference_velocities = section.numbers("reference_velocities", kNotZero);
  auto velocities = tabulation.reference_velocities;
  std::ranges::sort(velocities);
  if (std::ranges::adjacent_find(velocities) != velocities.end())
    section.fail("reference_velocities",
                 "contains the same velocity twice; each velocity must be there once");
  tabulation.relative_accuracy = section.number("relative_accuracy", kFraction);
  read_geometry(section, tabulation);
  // At smaller gaps the matrices exceed double precision.
  constexpr double kSmallestGap = 1e-8;
  if (const double narrowest = tabulation.gaps.front(); narrowest < kSmallestGap * radius)
    section.fail("gaps",
                 fmt::format("goes down to {}; a gap must be at least {} sphere radii, which is {}",
                             narrowest, kSmallestGap, kSmallestGap * radius));
  const double widest = tabulation.gaps.back();
  const auto room =
      find_geometry(tabulation.geometry).room(radius, widest, tabulation.geometry_parameters);
  if (!(room.largest_gap > 0))
    section.fail("geometry", "leaves no room for the sphere; give it a larger radius");
  // largest_gap is the difference of two lengths. A gap that equals it up to rounding errors is
  // allowed.
  if (!(widest <= room.largest_gap * (1 + 1e-12)))
    section.fail("gaps", fmt::format("goes up to {}; in this {} a gap must be at most {}", widest,
                                     tabulation.geometry, room.largest_gap));
  read_container(section, room, tabulation);
  section.finish();
  return tabulation;
}

/// Returns the value that belongs to a word, from a list of all words that are allowed.
template <class Value>
Value one_of(const TomlSection& section, std::string_view key,
             std::initializer_list<std::pair<std::string_view, Value>> words) {
  const std::string word = section.text(key);
  std::string allowed;
  for (const auto& [name, value] : words) {
    if (name == word) return value;
    allowed += fmt::format("{}\"{}\"", allowed.empty() ? "" : " or ", name);
  }
  section.fail(key, fmt::format("is '{}'; it must be {}", word, allowed));
}

FitRequest read_fit_request(const TomlSection& section, const std::filesystem::path& case_folder) {
  FitRequest fit;
  if (section.has("file")) {
    fit.file = case_folder / section.text("file");
  } else if (section.has("exact")) {
    if (const auto wall = section.text("exact"); wall != "plane")
      section.fail("exact", fmt::format("is '{}'; it must be \"plane\"", wall));
    fit.exact = true;
  } else {
    auto& settings = fit.settings;
    const std::string basis_key = section.has("terms") ? "terms" : "basis";
    // The defaults are those of the command `fit`.
    const std::string basis = section.has(basis_key) ? section.text(basis_key) : "lecture";
    if (basis_key == "terms" && section.has("basis"))
      section.fail("basis", "must be left out where terms gives a basis of its own");
    settings.basis = at_key(section, basis_key, [&] {
      return basis_key == "terms" ? parse_terms(basis) : find_basis(basis);
    });
    if (section.has("weights")) {
      const std::string weights = section.text("weights");
      settings.weights = at_key(section, "weights", [&] { return parse_weights(weights); });
    }
    if (section.has("loss")) {
      const std::string loss = section.text("loss");
      settings.loss = at_key(section, "loss", [&] { return parse_loss(loss); });
    }
    if (section.has("fix")) {
      settings.hold_leading = true;
      if (!section.is_text("fix"))
        settings.leading_value = section.number("fix", kFinite);
      else if (section.text("fix") != "theory")
        section.fail(
            "fix", fmt::format("is '{}'; it must be \"theory\" or a number, the coefficient of 1/q",
                               section.text("fix")));
    }
  }
  if (section.has("below"))
    fit.below = one_of<BelowInterval>(section, "below",
                                      {{"lubrication_limit", BelowInterval::kLubricationLimit},
                                       {"theory_limit", BelowInterval::kTheoryLimit}});
  if (section.has("above"))
    fit.above =
        one_of<AboveInterval>(section, "above", {{"stokes_limit", AboveInterval::kStokesLimit}});
  section.finish();
  return fit;
}

/// Reads an entry of external_force with `until`: a piece of a force, which begins where the piece
/// before it ends.
ExternalForce::Piece read_piece(const TomlSection& entry) {
  ExternalForce::Piece piece{entry.number("until", kPositive), 0};
  if (entry.has("polynomial")) {
    if (entry.has("value"))
      entry.fail("value", "must be left out where polynomial gives it as the first coefficient");
    auto coefficients = entry.numbers("polynomial", kFinite);
    piece.value = coefficients.front();
    piece.higher.assign(coefficients.begin() + 1, coefficients.end());
  } else {
    piece.value = entry.number("value", kFinite);
  }
  return piece;
}

ExternalForce::Sinusoid read_sinusoid(const TomlSection& entry) {
  return {entry.number("amplitude", kFinite), entry.number("angular_frequency", kPositive),
          entry.has("phase") ? entry.number("phase", kFinite) : 0};
}

/// Path of a file that the case names: relative to the folder of the case or, if it is not there,
/// in that folder itself, where a run keeps its copies.
std::filesystem::path force_file(const std::filesystem::path& folder,
                                 const std::filesystem::path& file) {
  const auto copy = folder / file.filename();
  // Set for a name that no file can have; reading the file reports it.
  std::error_code ignored;
  return !std::filesystem::exists(folder / file, ignored) && std::filesystem::exists(copy, ignored)
             ? copy
             : folder / file;
}

/// Reads `external_force` [M L/T^2]. The entries with `until` follow each other and make one force.
/// Every other entry, a sinusoid or a file, is added to this force.
ExternalForce read_forces(const TomlSection& motion, double end_time,
                          const std::filesystem::path& case_folder,
                          std::vector<std::filesystem::path>& files) {
  std::vector<ExternalForce::Piece> pieces;
  std::vector<ExternalForce> summands;
  for (const auto& entry : motion.sections("external_force")) {
    if (entry.has("file")) {
      files.push_back(force_file(case_folder, entry.text("file")));
      summands.push_back(read_external_force(files.back(), end_time));
    } else if (entry.has("amplitude")) {
      summands.push_back(ExternalForce::sinusoidal(read_sinusoid(entry)));
    } else {
      pieces.push_back(read_piece(entry));
    }
    entry.finish();
  }
  if (!pieces.empty()) {
    summands.push_back(at_key(motion, "external_force", [&] { return ExternalForce(pieces); }));
    if (pieces.back().until < end_time)
      motion.fail("external_force", fmt::format("ends at {}; it must reach motion.end_time, {}",
                                                pieces.back().until, end_time));
  }
  ExternalForce force = summands.front();
  for (std::size_t i = 1; i < summands.size(); ++i) force += summands[i];
  return force;
}

double read_time_step(const TomlSection& section, double end_time) {
  const double step = section.number("time_step", kPositive);
  if (step > end_time)
    section.fail("time_step",
                 fmt::format("is {}; it must be a number > 0 and at most motion.end_time, {}", step,
                             end_time));
  return step;
}

/// Reads `models` of [motion]: the names of the models to run.
std::vector<std::string> read_models(const TomlSection& section) {
  if (!section.has("models")) return {};
  auto models = section.texts("models");
  for (const auto& model : models) at_key(section, "models", [&] { return find_model(model); });
  return models;
}

/// Reads `roughness`: its heights on sphere and plane [L], whose sum must be less than the radius.
std::array<double, 2> read_roughness(const TomlSection& contact, double radius) {
  const auto roughness = contact.numbers("roughness", kNotNegative);
  if (roughness.size() != 2)
    contact.fail("roughness",
                 fmt::format("contains {} number(s); it must be two numbers >= 0, the heights on "
                             "the sphere and on the plane",
                             roughness.size()));
  if (!(roughness[0] + roughness[1] < radius))
    contact.fail("roughness",
                 fmt::format("adds up to {}; it must be less than the sphere's radius, {}",
                             roughness[0] + roughness[1], radius));
  return {roughness[0], roughness[1]};
}

/// Reads the numerical settings of the models. Defaults: time steps of end_time/4000, as in the
/// lecture's case; smooth surfaces; a threshold gap of a tenth of the radius, or of the initial gap
/// if that is smaller. A section that exists is checked even if no model uses it.
void read_numerical_settings(const TomlSection& root, double radius, Motion& motion) {
  constexpr int kSteps = 4000;
  constexpr double kRelativeTolerance = 1e-9;
  motion.reference_time_step = motion.contact_time_step = motion.end_time / kSteps;
  motion.inertial_relative_tolerance = kRelativeTolerance;
  motion.threshold_gap = std::min(radius, motion.initial_gap) / 10;

  if (root.has("reference")) {
    const auto reference = root.section("reference");
    if (reference.has("time_step"))
      motion.reference_time_step = read_time_step(reference, motion.end_time);
    reference.finish();
  }
  if (root.has("inertial")) {
    const auto inertial = root.section("inertial");
    if (inertial.has("relative_tolerance"))
      motion.inertial_relative_tolerance = inertial.number("relative_tolerance", kOdeTolerance);
    inertial.finish();
  }
  if (!root.has("viscous_contact")) return;
  const auto contact = root.section("viscous_contact");
  if (contact.has("time_step")) motion.contact_time_step = read_time_step(contact, motion.end_time);
  if (contact.has("threshold_gap"))
    motion.threshold_gap = contact.number("threshold_gap", kPositive);
  if (contact.has("roughness")) motion.roughness = read_roughness(contact, radius);
  contact.finish();
}

Motion read_motion(const TomlSection& root, const TomlSection& section, double mass, double radius,
                   const std::filesystem::path& case_folder,
                   std::vector<std::filesystem::path>& force_files) {
  const double end_time = section.number("end_time", kPositive);
  Motion motion{mass, section.number("initial_gap", kPositive),
                section.number("initial_velocity", kFinite), end_time,
                read_forces(section, end_time, case_folder, force_files)};

  read_numerical_settings(root, radius, motion);

  if (section.has("rows")) motion.output_rows = section.count("rows", 2, 100'000'000);

  if (section.has("time_scale")) {
    const double scale = section.number("time_scale", kPositive);
    motion.external_force = motion.external_force.stretched(scale);
    for (double* time : {&motion.end_time, &motion.reference_time_step, &motion.contact_time_step})
      *time *= scale;
    for (const double time : {motion.end_time, motion.reference_time_step, motion.contact_time_step,
                              motion.end_time / scale})
      if (!std::isnormal(time))
        section.fail(
            "time_scale",
            fmt::format("is {}; every time multiplied by it must stay within the range of a double",
                        scale));
  }
  return motion;
}

template <class Part>
const Part& required(const std::optional<Part>& part, const Case& c, std::string_view section) {
  if (!part)
    throw_bad_input({c.path.string()},
                    fmt::format("has no section [{}], which this command needs", section));
  return *part;
}

SweepRequest read_sweep(const TomlSection& section) {
  SweepRequest sweep;
  sweep.vary = section.texts("vary");
  if (section.has("models")) {
    sweep.models = section.texts("models");
    for (const auto& model : sweep.models)
      at_key(section, "models", [&] { return find_model(model); });
  }
  const auto optional_text = [&](std::string_view key) {
    return section.has(key) ? section.text(key) : "";
  };
  sweep.reference = optional_text("reference");
  sweep.x = optional_text("x");
  sweep.y = optional_text("y");
  if (section.has("plot")) sweep.plot = section.texts("plot");
  constexpr Allowed kSamples = {[](double v) { return v >= 1 && v <= 1e12 && v == std::floor(v); },
                                "from 1 to 1e12 without a fraction"};
  if (section.has("samples"))
    sweep.samples = static_cast<std::uint64_t>(section.number("samples", kSamples));
  section.finish();
  return sweep;
}

Case read_case(const TomlSection& root, std::string text, const std::filesystem::path& path) {
  Case c;
  c.path = path;
  c.text = std::move(text);
  c.title = root.text("title");

  const auto fluid = root.section("fluid");
  c.viscosity = fluid.number("viscosity", kPositive);
  fluid.finish();
  const auto sphere = root.section("sphere");
  c.radius = sphere.number("radius", kPositive);
  // Only the motion depends on the mass.
  const double mass =
      root.has("motion") || sphere.has("mass") ? sphere.number("mass", kPositive) : 1;
  sphere.finish();

  if (root.has("tabulation"))
    c.tabulation = read_tabulation(root.section("tabulation"), c.viscosity, c.radius);
  if (root.has("fit")) c.fit = read_fit_request(root.section("fit"), path.parent_path());
  if (root.has("motion")) {
    const auto section = root.section("motion");
    c.motion = read_motion(root, section, mass, c.radius, path.parent_path(), c.force_files);
    c.models = read_models(section);
    section.finish();
  }
  if (root.has("published")) {
    const auto published = root.section("published");
    c.published =
        PublishedGap{published.number("minimal_gap", kPositive), published.text("source")};
    published.finish();
  }
  const bool other_wall = c.tabulation && !find_geometry(c.tabulation->geometry).has_exact_drag;
  if (other_wall && c.fit && c.fit->exact)
    root.section("fit").fail(
        "exact", fmt::format("is the drag near a plane; tabulation.geometry is {}, for which "
                             "the exact drag is not known",
                             c.tabulation->geometry));
  for (const auto& model : c.models)
    if (other_wall && find_model(model).exact_drag)
      root.section("motion").fail(
          "models", fmt::format("contains {}, which runs with the exact drag near a plane; "
                                "tabulation.geometry is {}",
                                model, c.tabulation->geometry));
  if (root.has("sweep")) c.sweep = read_sweep(root.section("sweep"));
  // Without [motion] these sections are not read, but they are allowed.
  for (const auto* key : {"reference", "inertial", "viscous_contact"}) (void)root.has(key);
  root.finish();
  return c;
}

}  // namespace

Case read_case(const std::filesystem::path& path) {
  std::string text = read_file(path);
  const auto root = TomlSection::parse(text, path.string());
  return read_case(root, std::move(text), path);
}

namespace {

/// The text of a case, with empty sections added for those that it lacks, so that their keys can be
/// set.
std::string with_numerical_settings(std::string text, const std::filesystem::path& path) {
  const auto root = TomlSection::parse(text, path.string());
  for (const auto* section : {"reference", "inertial", "viscous_contact"})
    if (!root.has(section)) text += fmt::format("\n[{}]\n", section);
  return text;
}

}  // namespace

CaseTemplate::CaseTemplate(const std::filesystem::path& path)
    : path_(path),
      text_(read_file(path)),
      root_(TomlSection::parse(with_numerical_settings(text_, path), path.string())) {}

Case CaseTemplate::with(std::span<const std::pair<std::string, double>> numbers) const {
  return read_case(root_.with_numbers(numbers), text_, path_);
}

const Tabulation& required_tabulation(const Case& c) {
  return required(c.tabulation, c, "tabulation");
}
const FitRequest& required_fit(const Case& c) { return required(c.fit, c, "fit"); }
const Motion& required_motion(const Case& c) { return required(c.motion, c, "motion"); }

}  // namespace viscontact
