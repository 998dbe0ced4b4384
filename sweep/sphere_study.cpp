// identity_of() has everything that determines the rows; rows of another sweep are not kept.
#include "viscontact/sweep/sphere_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact::sweep {
namespace {

// The columns of each model, after "MODEL.", in the order of the file. add_model() repeats them.
constexpr std::array kModelColumns = {
    "minimal_gap",     "minimal_gap_time",     "film_from_gamma",
    "contact_from",    "contact_until",        "sup_gap_distance",
    "l1_gap_distance", "l1_velocity_distance", "film_ratio",
    "steps",           "solid_contact_from",   "solid_contact_velocity"};

/// The thinnest film that a contact model computes, or else the smallest gap [L].
double thinnest(const reduced_model::ModelComparison& model) {
  return model.film_from_gamma.value_or(model.minimal_gap);
}

/// The column, after "MODEL.", of the time at which a gap [L] is first reached.
std::string column_of_gap(double gap) { return "time_to_gap_" + format_number(gap); }

/// Adds the results of a model to the row. If there is no `reference` (null), the model has no
/// distances and no film_ratio. If the film of the reference is 0, the ratio is not finite, and its
/// field is empty.
void add_model(const reduced_model::ModelComparison& model,
               const reduced_model::ModelComparison* reference, RowResults& results) {
  const auto put = [&](std::string_view column, double value) {
    results.values[fmt::format("{}.{}", model.model, column)] = value;
  };
  put("minimal_gap", model.minimal_gap);
  put("minimal_gap_time", model.minimal_gap_time);
  if (model.film_from_gamma) put("film_from_gamma", *model.film_from_gamma);
  if (model.contact_interval) {
    put("contact_from", (*model.contact_interval)[0]);
    put("contact_until", (*model.contact_interval)[1]);
  }
  if (reference != nullptr) {
    put("sup_gap_distance", model.sup_gap_distance);
    put("l1_gap_distance", model.l1_gap_distance);
    put("l1_velocity_distance", model.l1_velocity_distance);
    put("film_ratio", thinnest(model) / thinnest(*reference));
  }
  results.numbers[model.model + ".steps"] = model.steps;
  for (const auto& of : model.gap_times)
    if (of.time) put(column_of_gap(of.gap), *of.time);
  if (const auto& touch = model.solid_contact_from) {
    put("solid_contact_from", touch->time);
    put("solid_contact_velocity", touch->velocity);
  }
}

void refuse_unread(const std::string& key) {
  constexpr std::array kNotOfAMotion = {"tabulation", "fit", "published", "sweep", "units"};
  if (std::ranges::find(kNotOfAMotion, key.substr(0, key.find('.'))) != kNotOfAMotion.end()) {
    std::vector<std::string_view> sections = {"fluid", "sphere", "motion"};
    std::ranges::copy(reduced_model::model_sections(), std::back_inserter(sections));
    const auto last = sections.back();
    sections.pop_back();
    throw Error(ErrorKind::kWrongUsage,
                "{} cannot be varied, because a sweep tabulates and fits nothing: it varies keys "
                "of [{}] and [{}]",
                key, fmt::join(sections, "], ["), last);
  }
  if (key.starts_with("motion.time_to_gap"))
    throw Error(ErrorKind::kWrongUsage,
                "{} cannot be varied, because its gaps name columns of the sweep; list all gaps in "
                "motion.time_to_gap",
                key);
  if (key == "motion.rows")
    throw Error(ErrorKind::kWrongUsage,
                "motion.rows cannot be varied, because it changes only files of trajectories, "
                "which a sweep does not write");
}

/// True if the motion of a model depends on a key. With gravity, all models depend on the weight
/// less the buoyancy; models with inertia depend on a mass that follows from a density.
bool motion_depends_on(const case_file::Case& c, const std::string& model, std::string_view key) {
  const bool sets_mass = key == "sphere.density" || (key == "sphere.radius" && c.density > 0);
  const bool sets_weight = sets_mass || key == "sphere.mass" || key == "fluid.density" ||
                           (key == "sphere.radius" && c.fluid_density > 0);
  if (c.gravity && sets_weight) return true;
  const auto choice = reduced_model::find_model(model);
  if (sets_mass && reduced_model::depends_on(choice, "sphere.mass")) return true;
  return key != "sphere.density" && key != "fluid.density" &&
         reduced_model::depends_on(choice, key);
}

void refuse_useless(const case_file::Case& c, const std::string& key,
                    const std::vector<std::string>& models) {
  if (std::ranges::none_of(models,
                           [&](const auto& model) { return motion_depends_on(c, model, key); }))
    throw Error(ErrorKind::kWrongUsage,
                "{} cannot be varied, because none of the models that are run depends on it ({}); "
                "leave it out, or add a model that depends on it",
                key, fmt::join(models, ", "));
}

std::string identity_of(const SpherePlan& plan) {
  std::string text = read_file(plan.case_path) + lubrication::write_fit(plan.fit);
  for (const auto& file : case_file::read_case(plan.case_path).force_files) text += read_file(file);
  for (const auto& v : plan.points.variations) {
    text += fmt::format("{}={}:{}:{}:{};", v.key, format_number(v.first), format_number(v.last),
                        v.logarithmic, v.count);
    for (const double value : v.values) text += format_number(value) + ",";
  }
  return fmt::format("{}{}{}{}{}{}{}", text, plan.points.samples,
                     plan.points.samples > 0 ? plan.points.seed : 0, fmt::join(plan.models, ","),
                     plan.reference, static_cast<int>(plan.outside.below),
                     static_cast<int>(plan.outside.above));
}

using SphereTemplate = case_file::CaseTemplate<case_file::Case>;

/// Throws Error(kBadInput) if the case is not valid, or if the fit cannot be scaled to it.
case_file::Case case_with(const SphereTemplate& cases, const SpherePlan& plan,
                          const std::vector<std::pair<std::string, double>>& numbers) {
  case_file::Case c = cases.with(numbers);
  (void)case_file::fit_for(c, plan.fit, plan.case_path);
  return c;
}

/// The models of the plan that do not fail. The reasons of the others are added to the failure.
std::vector<reduced_model::Trajectory> run_models(const SpherePlan& plan, const case_file::Case& c,
                                                  const StopToken& stop, RowResults& results) {
  std::vector<reduced_model::Trajectory> trajectories;
  const lubrication::LubricationForce force(case_file::fit_for(c, plan.fit, plan.case_path),
                                            plan.outside);
  reduced_model::Motion motion = case_file::required_motion(c);
  motion.stop = stop;
  for (const auto& model : plan.models)
    add_part(results, [&] {
      trajectories.push_back(
          reduced_model::simulate(reduced_model::find_model(model), motion, force));
    });
  return trajectories;
}

/// Adds the results to the row, compared with the model `reference` unless it is empty.
void add_comparison(const std::vector<reduced_model::Trajectory>& trajectories,
                    const std::string& reference, RowResults& results) {
  if (trajectories.empty()) return;
  const bool referred = std::ranges::find(trajectories, reference,
                                          &reduced_model::Trajectory::model) != trajectories.end();
  const auto comparison = reduced_model::compare_trajectories(
      trajectories, referred ? reference : trajectories.front().model);
  const auto& models = comparison.models;
  const auto* other =
      referred ? &*std::ranges::find(models, reference, &reduced_model::ModelComparison::model)
               : nullptr;
  for (const auto& model : models) add_model(model, other, results);
}

}  // namespace

SpherePlan planned_sphere(const case_file::Case& c) {
  const case_file::SweepRequest request = c.sweep.value_or(case_file::SweepRequest{});
  const case_file::FitRequest fit = c.fit.value_or(case_file::FitRequest{});
  SpherePlan plan;
  plan.case_path = c.path;
  plan.outside = fit.outside;
  if (fit.file)
    plan.fit = lubrication::read_fit(*fit.file);
  else if (fit.exact)
    plan.fit = lubrication::exact_plane_fit(c.viscosity, c.radius);
  plan.points = points_of_case(request.vary, c.path, request.vary_line);
  plan.points.samples = request.samples;
  plan.models = request.models;
  if (plan.models.empty())
    for (const auto& model : reduced_model::sweep_models()) plan.models.emplace_back(model.name);
  plan.reference = request.reference;
  return plan;
}

Study sphere_study(SpherePlan plan, const std::string& version) {
  const SphereTemplate cases(plan.case_path);
  if (plan.fit.basis.empty())
    throw Error(ErrorKind::kWrongUsage, "the sweep has no fit of the drag");
  if (plan.reference.empty()) plan.reference = reduced_model::reference_of(plan.models);
  refuse_doubles(plan.models, "the model");
  for (const auto& model : plan.models) (void)reduced_model::find_model(model);
  check_keys(plan.points, refuse_unread);
  if (std::ranges::find(plan.models, plan.reference) == plan.models.end())
    throw Error(ErrorKind::kWrongUsage,
                "the reference model '{}' is not one of the models that are run; they are: {}",
                plan.reference, fmt::join(plan.models, ", "));
  case_file::Case last;
  check_ends(plan.points, [&](const auto& numbers) {
    last = case_with(cases, plan, numbers);
    (void)case_file::required_motion(last);
  });
  check_keys(plan.points, [&](const std::string& key) { refuse_useless(last, key, plan.models); });
  Study study;
  study.points = plan.points;
  for (const auto& model : plan.models)
    for (const auto* column : kModelColumns)
      study.results.push_back(fmt::format("{}.{}", model, column));
  for (const auto& model : plan.models)
    for (const double gap : case_file::required_motion(last).gaps_to_reach)
      study.results.push_back(fmt::format("{}.{}", model, column_of_gap(gap)));
  study.comments = head_of("sweep", cases.text(), plan.points, identity_of(plan), version,
                           case_file::read_case(plan.case_path).units);
  study.comments["fit"] = sha256(lubrication::write_fit(plan.fit));
  study.comments["reference"] = plan.reference;
  study.comments["revision of the models"] = std::to_string(reduced_model::kModelsRevision);
  study.run = [cases, plan = std::move(plan)](std::uint64_t index, const StopToken& stop) {
    RowResults results;
    add_part(results, [&] {
      const auto c = at_point(plan.points, index,
                              [&](const auto& numbers) { return case_with(cases, plan, numbers); });
      add_comparison(run_models(plan, c, stop, results), plan.reference, results);
    });
    return results;
  };
  return study;
}

}  // namespace viscontact::sweep
