// Reads the case file of one sphere (case_file.hpp); sections.hpp declares the readers of its long
// sections. Lengths, masses and times are in the units of the case. A change must keep the keys and
// their defaults, because users have written cases with them.
#include "viscontact/case_file/case_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <utility>

#include "viscontact/case_file/sections.hpp"
#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/lubrication/terms.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact::case_file {
namespace {

/// Returns the value of a key that must be one of the given words, each of which has a value.
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
    const auto walls = freefem_axi::geometries_with_exact_drag();
    if (const auto wall = section.text("exact"); find_named(walls, wall) == nullptr)
      section.fail("exact",
                   fmt::format("is '{}'; it must be \"{}\"", wall, names_of(walls, "\" or \"")));
    fit.exact = true;
  } else {
    auto& settings = fit.settings;
    const std::string basis_key = section.has("terms") ? "terms" : "basis";
    // The defaults are those of the command `fit`.
    const std::string basis = section.has(basis_key)
                                  ? section.text(basis_key)
                                  : std::string(lubrication::default_basis().name);
    if (basis_key == "terms" && section.has("basis"))
      section.fail("basis", "must be left out, because the key terms defines the basis");
    settings.basis = at_key(section, basis_key, [&] {
      return basis_key == "terms" ? lubrication::parse_terms(basis)
                                  : lubrication::find_basis(basis);
    });
    if (section.has("weights")) {
      const std::string weights = section.text("weights");
      settings.weights =
          at_key(section, "weights", [&] { return lubrication::parse_weights(weights); });
    }
    if (section.has("loss")) {
      const std::string loss = section.text("loss");
      settings.loss = at_key(section, "loss", [&] { return lubrication::parse_loss(loss); });
    }
    if (section.has("fix")) {
      settings.fix_leading = true;
      if (!section.is_text("fix"))
        settings.leading_value = section.number("fix", kFinite);
      else if (section.text("fix") != "theory")
        section.fail(
            "fix", fmt::format("is '{}'; it must be \"theory\" or a number, the coefficient of 1/q",
                               section.text("fix")));
    }
  }
  if (section.has("below"))
    fit.outside.below = one_of<lubrication::BelowInterval>(
        section, "below",
        {{"lubrication_limit", lubrication::BelowInterval::kLubricationLimit},
         {"theory_limit", lubrication::BelowInterval::kTheoryLimit}});
  if (section.has("above"))
    fit.outside.above = one_of<lubrication::AboveInterval>(
        section, "above", {{"stokes_limit", lubrication::AboveInterval::kStokesLimit}});
  section.finish();
  return fit;
}

template <class Part>
const Part& required(const std::optional<Part>& part, const Case& c, std::string_view section) {
  if (!part)
    throw_bad_input({c.path.string()},
                    fmt::format("has no section [{}], which this command needs", section));
  return *part;
}

/// Reads `models`: names of models; empty if the section has no such key.
std::vector<std::string> read_models(const TomlSection& section) {
  if (!section.has("models")) return {};
  auto models = section.texts("models");
  for (const auto& model : models)
    at_key(section, "models", [&] { return reduced_model::find_model(model); });
  return models;
}

SweepRequest read_sweep(const TomlSection& section) {
  SweepRequest sweep;
  sweep.vary = section.texts("vary");
  sweep.models = read_models(section);
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
  const bool other_wall =
      c.tabulation && !freefem_axi::find_geometry(c.tabulation->geometry).has_exact_drag;
  if (other_wall && c.fit && c.fit->exact)
    root.section("fit").fail(
        "exact", fmt::format("is the drag near a plane; tabulation.geometry is {}, for which "
                             "the exact drag is not known",
                             c.tabulation->geometry));
  for (const auto& model : c.models)
    if (other_wall && reduced_model::find_model(model).exact_drag)
      root.section("motion").fail(
          "models", fmt::format("contains {}, which runs with the exact drag near a plane; "
                                "tabulation.geometry is {}",
                                model, c.tabulation->geometry));
  if (root.has("sweep")) c.sweep = read_sweep(root.section("sweep"));
  // Without [motion] these sections are not read, but they are allowed.
  for (const auto& name : reduced_model::model_sections()) (void)root.has(name);
  root.finish();
  return c;
}

/// The text of a case, with an empty section for each section of models that it lacks, so that a
/// sweep can set the keys of these sections.
std::string with_model_sections(std::string text, const std::filesystem::path& path) {
  const auto root = TomlSection::parse(text, path.string());
  for (const auto& name : reduced_model::model_sections())
    if (!root.has(name)) text += fmt::format("\n[{}]\n", name);
  return text;
}

}  // namespace

Case read_case(const std::filesystem::path& path) {
  std::string text = read_file(path);
  const auto root = TomlSection::parse(text, path.string());
  return read_case(root, std::move(text), path);
}

CaseTemplate::CaseTemplate(const std::filesystem::path& path)
    : path_(path),
      text_(read_file(path)),
      root_(TomlSection::parse(with_model_sections(text_, path), path.string())) {}

Case CaseTemplate::with(std::span<const std::pair<std::string, double>> numbers) const {
  return read_case(root_.with_numbers(numbers), text_, path_);
}

const freefem_axi::Tabulation& required_tabulation(const Case& c) {
  return required(c.tabulation, c, "tabulation");
}
const FitRequest& required_fit(const Case& c) { return required(c.fit, c, "fit"); }
const reduced_model::Motion& required_motion(const Case& c) {
  return required(c.motion, c, "motion");
}

}  // namespace viscontact::case_file
