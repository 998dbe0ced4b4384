// Each row of the sweep computes the motions of its case anew, with the same fit.
#include "viscontact/rolling/case/rolling_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/rolling/rolling_motion.hpp"

namespace viscontact::rolling {
namespace {

// The columns of each model, after "MODEL.", which add_rolling_end() fills.
constexpr std::array kRollingColumns = {"gap",   "smallest_gap", "position",
                                        "angle", "velocity",     "angular_velocity",
                                        "slip",  "contact",      "contact_time"};

/// Throws Error(kWrongUsage) unless one fit serves all values of the key.
void check_rolling_key(const std::string& key) {
  constexpr std::array kOther = {"fluid.viscosity", "fluid.density",  "sphere.radius",
                                 "sphere.mass",     "sphere.density", "sphere.moment_of_inertia"};
  if (key.starts_with("rolling.") || std::ranges::find(kOther, key) != kOther.end()) return;
  throw Error(ErrorKind::kWrongUsage,
              "{} cannot be varied with one fit; keys of [rolling], {} can, and `viscontact "
              "rolling` makes the fit of another sphere",
              key, fmt::join(kOther, ", "));
}

void check_rolling_model(const std::string& model) {
  const auto& all = rolling_models();
  if (find_named(all, model) == nullptr)
    throw Error(ErrorKind::kWrongUsage, "'{}' is no model of a rolling sphere; the models are: {}",
                model, names_of(all));
}

/// Throws Error(kWrongUsage) if none of the models depends on the key.
void refuse_useless(const RollingCase& c, const std::string& key,
                    const std::vector<std::string>& models) {
  const bool is_of_solids = key == "rolling.roughness" || key == "rolling.friction";
  const bool is_of_integrator = key == "rolling.relative_tolerance";
  if (key == "fluid.density" && !c.has_gravity)
    throw Error(
        ErrorKind::kWrongUsage,
        "fluid.density cannot be varied, because no motion depends on it without rolling.gravity");
  if (std::ranges::all_of(models, [&](const auto& model) {
        return (is_of_solids && model == "smooth") ||
               (is_of_integrator && model == "viscous_contact");
      }))
    throw Error(ErrorKind::kWrongUsage,
                "{} cannot be varied, because none of the models that are run depends on it ({}); "
                "leave it out, or add a model that depends on it",
                key, fmt::join(models, ", "));
}

void add_rolling_end(const std::string& model, const RollingEnd& end, sweep::RowResults& results) {
  const auto put = [&](const char* column, double value) {
    results.values[fmt::format("{}.{}", model, column)] = value;
  };
  put("gap", end.last.gap);
  put("smallest_gap", end.smallest_gap);
  put("position", end.last.position);
  put("angle", end.last.angle);
  put("velocity", end.last.velocity);
  put("angular_velocity", end.last.angular_velocity);
  put("slip", end.slip);
  results.numbers[model + ".contact"] = static_cast<std::uint64_t>(end.last.contact);
  if (end.contact_time) put("contact_time", *end.contact_time);
}

/// Adds the results of all models of the plan to the row of the case `c`. The message of a model
/// that fails becomes the failure of the row.
void roll_models(const RollingPlan& plan, RollingCase c, const motions::PairFit& fit,
                 const StopToken& stop, sweep::RowResults& results) {
  c.motion.stop = stop;
  const auto fit_here = fit_for(c, fit, plan.fit_path);
  const auto run = [&](const std::string& name) {
    return with_place("model " + name,
                      [&] { return find_named(rolling_models(), name)->run(c.motion, fit_here); });
  };
  for (const auto& name : plan.models)
    sweep::add_part(results,
                    [&] { add_rolling_end(name, end_of(run(name), c.motion, c.radius), results); });
}

}  // namespace

RollingPlan planned_rolling(const RollingCase& c) {
  const auto request = c.sweep.value_or(case_file::SweepRequest{});
  RollingPlan plan;
  plan.case_path = c.path;
  if (c.fit) plan.fit_path = *c.fit;
  plan.points = sweep::points_of_case(request.vary, c.path, request.vary_line);
  plan.points.samples = request.samples;
  return plan;
}

sweep::Study rolling_study(RollingPlan plan, const std::string& version) {
  const case_file::CaseTemplate<RollingCase> cases(plan.case_path);
  if (plan.models.empty()) plan.models = cases.with({}).models;
  sweep::check_keys(plan.points, check_rolling_key);
  for (const auto& model : plan.models) check_rolling_model(model);
  sweep::refuse_doubles(plan.models, "the model");
  const auto fit = motions::read_pair_fit(plan.fit_path);
  RollingCase last;
  sweep::check_ends(plan.points, [&](const auto& numbers) {
    last = cases.with(numbers);
    (void)fit_for(last, fit, plan.fit_path);
  });
  sweep::check_keys(plan.points,
                    [&](const std::string& key) { refuse_useless(last, key, plan.models); });
  sweep::Study study;
  study.points = plan.points;
  for (const auto& model : plan.models)
    for (const auto* column : kRollingColumns)
      study.results.push_back(fmt::format("{}.{}", model, column));
  study.comments =
      sweep::head_of("sweep of a rolling sphere", cases.text(), plan.points,
                     fmt::format("{} {}", fmt::join(plan.models, ","), sweep::text_of(plan.points)),
                     version, last.units);
  study.comments["fit"] = sha256(motions::write_pair_fit(fit));
  study.run = [cases, fit, plan = std::move(plan)](std::uint64_t index, const StopToken& stop) {
    sweep::RowResults results;
    sweep::add_part(results, [&] {
      roll_models(plan, cases.with(plan.points.numbers(index)), fit, stop, results);
    });
    return results;
  };
  return study;
}

}  // namespace viscontact::rolling
