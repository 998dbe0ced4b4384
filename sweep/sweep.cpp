#include "sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "common/error.hpp"
#include "common/interrupt.hpp"
#include "common/number.hpp"
#include "reduced_model/comparison.hpp"
#include "reduced_model/models.hpp"

namespace viscontact {
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

/// Text that is one field of a CSV file.
std::string as_field(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == ',' || c == '\n' || c == '\r'; }, ';');
  return text;
}

double thinnest(const ModelComparison& model) {
  return model.recovered_minimal_gap.value_or(model.minimal_gap);
}

std::string model_fields(const ModelComparison& model, const ModelComparison* reference) {
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
    const bool comparable = thinnest(*reference) > 0;
    text += "," + (comparable ? format_number(thinnest(model) / thinnest(*reference)) : "");
  }
  return text + fmt::format(",{}", model.steps);
}

template <class Names>
void refuse_doubles(const Names& names, std::string_view kind) {
  std::set<std::string> seen;
  for (const auto& name : names)
    if (!seen.insert(name).second)
      throw Error(ExitCode::kWrongUsage, fmt::format("{} {} is there twice", kind, name));
}

}  // namespace

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
  std::vector<std::string> keys;
  for (const auto& variation : plan_.variations) keys.push_back(variation.key);
  refuse_doubles(keys, "the key");
  refuse_doubles(plan_.models, "the model");
  for (const auto& model : plan_.models) (void)find_model(model);
  if (std::ranges::find(plan_.models, plan_.reference) == plan_.models.end())
    throw Error(ExitCode::kWrongUsage,
                fmt::format("the reference model '{}' is none of the models: {}", plan_.reference,
                            fmt::join(plan_.models, ", ")));
  for (const std::uint64_t index : {std::uint64_t{0}, sweep_size(plan_) - 1}) {
    const Case c = case_at(index);
    (void)required_motion(c);
    if (plan_.fit.basis != kExactPlane && c.radius != plan_.fit.radius)
      throw_bad_input(
          {plan_.case_path.string()},
          fmt::format("sphere.radius is {}, the fit's {}: a fit is of one radius; vary it with "
                      "the exact drag",
                      c.radius, plan_.fit.radius));
  }
}

std::vector<std::pair<std::string, double>> Sweep::point(std::uint64_t index) const {
  return plan_.samples > 0 ? random_point(plan_.variations, index, plan_.seed)
                           : grid_point(plan_.variations, index);
}

Case Sweep::case_at(std::uint64_t index) const {
  const auto numbers = point(index);
  try {
    return case_.with(numbers);
  } catch (const Error& error) {
    std::string values;
    for (const auto& [key, value] : numbers) values += fmt::format(" {} = {}", key, value);
    throw Error(error.exit_code(), fmt::format("{}, with{}", error.what(), values));
  }
}

std::string Sweep::row(std::uint64_t index) const {
  std::string text;
  for (const auto& [key, value] : point(index)) text += format_number(value) + ",";
  text.pop_back();
  std::vector<Trajectory> trajectories;
  std::string failure;
  try {
    const Case c = case_at(index);
    const Fit fit = plan_.fit.basis == kExactPlane ? exact_plane_fit(c.viscosity, c.radius)
                                                   : with_viscosity(plan_.fit, c.viscosity);
    const LubricationForce force(fit, plan_.below, plan_.above);
    for (const auto& model : plan_.models) {
      try {
        trajectories.push_back(simulate(find_model(model), required_motion(c), force));
      } catch (const Error& error) {
        failure += fmt::format("{}{}", failure.empty() ? "" : " | ", error.what());
      }
    }
  } catch (const Error& error) {
    failure = error.what();
  }
  const auto of_model = [](const Comparison& comparison, std::string_view name) {
    return &*std::ranges::find(comparison.models, name, &ModelComparison::model);
  };
  const auto has = [&](std::string_view name) {
    return std::ranges::find(trajectories, name, &Trajectory::model) != trajectories.end();
  };
  const bool referred = has(plan_.reference);
  std::optional<Comparison> comparison;
  if (!trajectories.empty())
    comparison =
        compare_trajectories(trajectories, referred ? plan_.reference : trajectories.front().model);
  for (const auto& model : plan_.models)
    text += has(model) ? model_fields(*of_model(*comparison, model),
                                      referred ? of_model(*comparison, plan_.reference) : nullptr)
                       : std::string(kModelColumns.size(), ',');
  return fmt::format("{},{}\n", text, as_field(failure));
}

std::uint64_t run_sweep(
    const Sweep& sweep, std::uint64_t begin, int jobs,
    const std::function<void(std::uint64_t index, const std::string& row)>& take) {
  const std::uint64_t size = sweep_size(sweep.plan());
  // No thread runs further ahead of the last row taken than this: what is kept stays small.
  const std::uint64_t window = 32 * static_cast<std::uint64_t>(jobs);
  std::mutex mutex;
  std::condition_variable room;
  std::map<std::uint64_t, std::string> finished;
  std::uint64_t next = begin, taken = begin;
  std::exception_ptr error;
  const auto work = [&] {
    std::unique_lock lock(mutex);
    for (;;) {
      room.wait(lock, [&] { return error || next >= size || next < taken + window; });
      if (error || next >= size || interrupted()) return;
      const std::uint64_t index = next++;
      lock.unlock();
      std::string row;
      std::exception_ptr thrown;
      try {
        row = sweep.row(index);
      } catch (...) {
        thrown = std::current_exception();
      }
      lock.lock();
      if (thrown) {
        error = thrown;
        room.notify_all();
        return;
      }
      finished.emplace(index, std::move(row));
      try {
        for (auto first = finished.begin();
             first != finished.end() && first->first == taken && !error;
             first = finished.erase(first)) {
          take(taken, first->second);
          ++taken;
        }
      } catch (...) {
        error = std::current_exception();
      }
      room.notify_all();
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < jobs; ++i) threads.emplace_back(work);
  }
  if (error) std::rethrow_exception(error);
  return taken;
}

}  // namespace viscontact
