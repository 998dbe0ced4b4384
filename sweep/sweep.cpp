// Plans, checks and computes the rows of a sweep (sweep.hpp). Everything that determines the rows
// must go into identity_of, so that rows of another sweep are not kept.
#include "viscontact/sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>

#include "viscontact/common/equal_up_to_rounding.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact::sweep {
namespace {

constexpr std::array kModelColumns = {"minimal_gap",
                                      "minimal_gap_time",
                                      "film",
                                      "contact_from",
                                      "contact_until",
                                      "sup_gap_distance",
                                      "l1_gap_distance",
                                      "l1_velocity_distance",
                                      "film_ratio",
                                      "steps"};

double thinnest(const reduced_model::ModelComparison& model) {
  return model.recovered_minimal_gap.value_or(model.minimal_gap);
}

std::string model_fields(const reduced_model::ModelComparison& model,
                         const reduced_model::ModelComparison* reference) {
  std::string text = fmt::format(",{},{}", format_number(model.minimal_gap),
                                 format_number(model.minimal_gap_time));
  text += "," + (model.recovered_minimal_gap ? format_number(*model.recovered_minimal_gap) : "");
  for (const std::size_t i : {0U, 1U})
    text += "," + (model.contact_interval ? format_number((*model.contact_interval)[i]) : "");
  if (reference == nullptr) {
    text += ",,,,";
  } else {
    for (const double distance :
         {model.sup_gap_distance, model.l1_gap_distance, model.l1_velocity_distance})
      text += "," + format_number(distance);
    const double ratio = thinnest(model) / thinnest(*reference);
    text += "," + (std::isfinite(ratio) ? format_number(ratio) : "");
  }
  return text + fmt::format(",{}", model.steps);
}

template <class Names>
void refuse_doubles(const Names& names, std::string_view kind) {
  std::set<std::string> seen;
  for (const auto& name : names)
    if (!seen.insert(name).second)
      throw Error(ErrorKind::kWrongUsage, fmt::format("{} {} is given twice", kind, name));
}

/// Throws Error(kWrongUsage) if a key of a case changes no row, because a sweep does not read it or
/// none of the models depends on it. Does not throw if the key does not exist; the reader of the
/// case reports such a key.
void refuse_useless(const std::string& key, const std::vector<std::string>& models) {
  constexpr std::array kNotOfAMotion = {"tabulation", "fit", "published", "sweep"};
  if (std::ranges::find(kNotOfAMotion, key.substr(0, key.find('.'))) != kNotOfAMotion.end()) {
    std::vector<std::string_view> sections = {"fluid", "sphere", "motion"};
    std::ranges::copy(reduced_model::model_sections(), std::back_inserter(sections));
    const auto last = sections.back();
    sections.pop_back();
    throw Error(ErrorKind::kWrongUsage,
                fmt::format("{} cannot be varied, because a sweep tabulates and fits nothing: it "
                            "varies keys of [{}] and [{}]",
                            key, fmt::join(sections, "], ["), last));
  }
  if (std::ranges::none_of(models, [&](const auto& model) {
        return reduced_model::depends_on(reduced_model::find_model(model), key);
      }))
    throw Error(ErrorKind::kWrongUsage,
                fmt::format("{} cannot be varied, because none of the models that are run depends "
                            "on it ({}); leave it out, or add a model that depends on it",
                            key, fmt::join(models, ", ")));
}

/// Hash of everything that determines the rows of a sweep.
std::string identity_of(const SweepPlan& plan) {
  std::string text = read_file(plan.case_path) + lubrication::write_fit(plan.fit);
  // The files from which the case reads an external force.
  for (const auto& file : case_file::read_case(plan.case_path).force_files) text += read_file(file);
  for (const auto& v : plan.variations) {
    text += fmt::format("{}={}:{}:{}:{};", v.key, format_number(v.first), format_number(v.last),
                        v.logarithmic, v.count);
    for (const double value : v.values) text += format_number(value) + ",";
  }
  return sha256(fmt::format("{}{}{}{}{}{}{}", text, plan.samples, plan.samples > 0 ? plan.seed : 0,
                            fmt::join(plan.models, ","), plan.reference,
                            static_cast<int>(plan.outside.below),
                            static_cast<int>(plan.outside.above)));
}

}  // namespace

SweepPlan planned(const case_file::Case& c) {
  const case_file::SweepRequest request = c.sweep.value_or(case_file::SweepRequest{});
  const case_file::FitRequest fit = c.fit.value_or(case_file::FitRequest{});
  SweepPlan plan;
  plan.case_path = c.path;
  plan.outside = fit.outside;
  if (fit.file)
    plan.fit = lubrication::read_fit(*fit.file);
  else if (fit.exact)
    plan.fit = lubrication::exact_plane_fit(c.viscosity, c.radius);
  for (const auto& text : request.vary) {
    try {
      plan.variations.push_back(parse_variation(text));
    } catch (const Error& error) {
      throw_bad_input({c.path.string()}, fmt::format("sweep.vary: {}", error.what()));
    }
  }
  plan.samples = request.samples;
  plan.models = request.models;
  if (plan.models.empty())
    for (const auto& model : reduced_model::sweep_models()) plan.models.emplace_back(model.name);
  plan.reference = request.reference;
  return plan;
}

std::uint64_t sweep_size(const SweepPlan& plan) {
  return plan.samples > 0 ? plan.samples : grid_size(plan.variations);
}

std::vector<std::string> sweep_columns(const SweepPlan& plan) {
  std::vector<std::string> columns;
  for (const auto& variation : plan.variations) columns.push_back(variation.key);
  for (const auto& model : plan.models)
    for (const auto* column : kModelColumns) columns.push_back(fmt::format("{}.{}", model, column));
  columns.emplace_back("failure");
  return columns;
}

Sweep::Sweep(SweepPlan plan) : plan_(std::move(plan)), case_(plan_.case_path) {
  if (plan_.variations.empty()) throw Error(ErrorKind::kWrongUsage, "the sweep varies no key");
  if (plan_.fit.basis.empty())
    throw Error(ErrorKind::kWrongUsage, "the sweep has no fit of the drag");
  if (plan_.reference.empty()) plan_.reference = reduced_model::reference_of(plan_.models);
  std::vector<std::string> keys;
  for (const auto& variation : plan_.variations) keys.push_back(variation.key);
  refuse_doubles(keys, "the key");
  refuse_doubles(plan_.models, "the model");
  for (const auto& model : plan_.models) (void)reduced_model::find_model(model);
  for (const auto& key : keys) refuse_useless(key, plan_.models);
  if (std::ranges::find(plan_.models, plan_.reference) == plan_.models.end())
    throw Error(
        ErrorKind::kWrongUsage,
        fmt::format("the reference model '{}' is not one of the models that are run; they are: {}",
                    plan_.reference, fmt::join(plan_.models, ", ")));
  for (const std::uint64_t index : {std::uint64_t{0}, sweep_size(plan_) - 1})
    (void)case_file::required_motion(case_at(index));
}

std::vector<std::pair<std::string, double>> Sweep::point(std::uint64_t index) const {
  return plan_.samples > 0 ? random_point(plan_.variations, index, plan_.seed)
                           : grid_point(plan_.variations, index);
}

case_file::Case Sweep::case_at(std::uint64_t index) const {
  const auto numbers = point(index);
  try {
    case_file::Case c = case_.with(numbers);
    if (!lubrication::is_exact_plane(plan_.fit) &&
        !equal_up_to_rounding(c.radius, plan_.fit.radius))
      throw_bad_input(
          {plan_.case_path.string()},
          fmt::format("sphere.radius is {} and the fit's radius is {}; a fit is valid for "
                      "one radius only, and only the exact drag allows other radii",
                      c.radius, plan_.fit.radius));
    return c;
  } catch (const Error& error) {
    std::string values;
    for (const auto& [key, value] : numbers) values += fmt::format(" {} = {}", key, value);
    throw Error(error.kind(), fmt::format("{} (at the point{})", error.what(), values));
  }
}

std::string Sweep::key_fields(std::uint64_t index) const {
  std::string text;
  for (const auto& [key, value] : point(index))
    text += (text.empty() ? "" : ",") + format_number(value);
  return text;
}

std::string Sweep::row(std::uint64_t index, const StopToken& stop) const {
  std::string text = key_fields(index);
  std::vector<reduced_model::Trajectory> trajectories;
  std::string failure;
  try {
    const case_file::Case c = case_at(index);
    const lubrication::Fit fit = lubrication::is_exact_plane(plan_.fit)
                                     ? lubrication::exact_plane_fit(c.viscosity, c.radius)
                                     : lubrication::with_viscosity(plan_.fit, c.viscosity);
    const lubrication::LubricationForce force(fit, plan_.outside);
    reduced_model::Motion motion = case_file::required_motion(c);
    motion.stop = stop;
    for (const auto& model : plan_.models) {
      try {
        trajectories.push_back(
            reduced_model::simulate(reduced_model::find_model(model), motion, force));
      } catch (const Error& error) {
        if (error.kind() == ErrorKind::kInterrupted) throw;
        failure += fmt::format("{}{}", failure.empty() ? "" : " | ", error.what());
      }
    }
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInterrupted) throw;
    failure = error.what();
  }
  const auto of_model = [](const reduced_model::Comparison& comparison, std::string_view name) {
    return &*std::ranges::find(comparison.models, name, &reduced_model::ModelComparison::model);
  };
  const auto has = [&](std::string_view name) {
    return std::ranges::find(trajectories, name, &reduced_model::Trajectory::model) !=
           trajectories.end();
  };
  const bool referred = has(plan_.reference);
  std::optional<reduced_model::Comparison> comparison;
  if (!trajectories.empty())
    comparison = reduced_model::compare_trajectories(
        trajectories, referred ? plan_.reference : trajectories.front().model);
  for (const auto& model : plan_.models)
    text += has(model) ? model_fields(*of_model(*comparison, model),
                                      referred ? of_model(*comparison, plan_.reference) : nullptr)
                       : std::string(kModelColumns.size(), ',');
  return fmt::format("{},{}\n", text, as_field(failure));
}

Rows rows_of(const Sweep& sweep, const std::string& version) {
  const auto& plan = sweep.plan();
  return {.size = sweep_size(plan),
          .columns = sweep_columns(plan),
          .keys = plan.variations.size(),
          .comments = {{"viscontact", "sweep"},
                       {"case", sha256(read_file(plan.case_path))},
                       {"fit", sha256(lubrication::write_fit(plan.fit))},
                       {"reference", plan.reference},
                       {"revision of the models", std::to_string(reduced_model::kModelsRevision)},
                       {"rows", std::to_string(sweep_size(plan))},
                       {"sweep", identity_of(plan)},
                       {"version of Viscontact", version}},
          .key_fields = [&sweep](std::uint64_t index) { return sweep.key_fields(index); },
          .row = [&sweep](std::uint64_t index,
                          const StopToken& stop) { return sweep.row(index, stop); }};
}

}  // namespace viscontact::sweep
