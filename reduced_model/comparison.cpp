// Distances between trajectories that are linear between their rows, by exact integrals, and the
// comparison file (docs/file-formats.md). Lengths, masses and times are in the units of the
// trajectories.
#include "viscontact/reduced_model/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/json.hpp"

namespace viscontact::reduced_model {
namespace {

/// Gap and velocity of a trajectory at increasing times, linear between its rows.
class Interpolation {
 public:
  explicit Interpolation(const std::vector<TrajectoryRow>& rows) : rows_(rows) {}

  struct Value {
    double gap, velocity;
  };

  /// Gap and velocity at `time`, which must be within the trajectory and not before that of the
  /// last call.
  Value at(double time) {
    while (next_ + 1 < rows_.size() && rows_[next_].time < time) ++next_;
    const auto& b = rows_[next_];
    if (next_ == 0 || b.time == time) return {b.gap, b.velocity};
    const auto& a = rows_[next_ - 1];
    const double w = (time - a.time) / (b.time - a.time);
    return {std::lerp(a.gap, b.gap, w), std::lerp(a.velocity, b.velocity, w)};
  }

 private:
  const std::vector<TrajectoryRow>& rows_;
  std::size_t next_ = 0;
};

/// int |d| over a step in which d changes linearly from d0 to d1.
double integral_of_absolute(double d0, double d1, double step) {
  if (d0 * d1 >= 0) return step * (std::abs(d0) + std::abs(d1)) / 2;
  return step * (d0 * d0 + d1 * d1) / (2 * (std::abs(d0) + std::abs(d1)));
}

void measure_distances(const Trajectory& trajectory, const Trajectory& reference,
                       ModelComparison& result) {
  const double from = std::max(trajectory.rows.front().time, reference.rows.front().time);
  const double to = std::min(trajectory.rows.back().time, reference.rows.back().time);
  if (from > to)
    throw Error(ErrorKind::kBadInput,
                fmt::format("trajectories {} and {} have no time in common (they are from {} to {} "
                            "and from {} to {})",
                            trajectory.model, reference.model, trajectory.rows.front().time,
                            trajectory.rows.back().time, reference.rows.front().time,
                            reference.rows.back().time));
  // Both trajectories are linear between two neighbouring times of the merged list, so the sums
  // below are the exact integrals.
  std::vector<double> times = {from, to};
  for (const auto* rows : {&trajectory.rows, &reference.rows})
    for (const auto& row : *rows)
      if (row.time > from && row.time < to) times.push_back(row.time);
  std::ranges::sort(times);

  Interpolation ours(trajectory.rows);
  Interpolation theirs(reference.rows);
  double previous_time = from;
  Interpolation::Value previous{};
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto a = ours.at(times[i]);
    const auto b = theirs.at(times[i]);
    const Interpolation::Value distance{a.gap - b.gap, a.velocity - b.velocity};
    result.sup_gap_distance = std::max(result.sup_gap_distance, std::abs(distance.gap));
    if (i > 0) {
      const double step = times[i] - previous_time;
      result.l1_gap_distance += integral_of_absolute(previous.gap, distance.gap, step);
      result.l1_velocity_distance +=
          integral_of_absolute(previous.velocity, distance.velocity, step);
    }
    previous = distance;
    previous_time = times[i];
  }
}

/// The contact interval that the trajectory states, or else the first and last row with gamma < 0.
std::optional<std::array<double, 2>> contact_interval(const Trajectory& trajectory) {
  if (trajectory.contact_interval) return trajectory.contact_interval;
  const auto& rows = trajectory.rows;
  const auto in_contact = [](const TrajectoryRow& row) { return row.gamma && *row.gamma < 0; };
  const auto first = std::ranges::find_if(rows, in_contact);
  if (first == rows.end()) return {};
  const auto last = std::find_if(rows.rbegin(), rows.rend(), in_contact);
  return std::array{first->time, last->time};
}

}  // namespace

Comparison compare_trajectories(const std::vector<Trajectory>& trajectories,
                                std::string_view reference_model, const StopToken& stop) {
  const auto reference = std::ranges::find(trajectories, reference_model, &Trajectory::model);
  if (reference == trajectories.end()) {
    std::string names;
    for (const auto& trajectory : trajectories)
      names += fmt::format("{}{}", names.empty() ? "" : ", ", trajectory.model);
    throw Error(ErrorKind::kBadInput,
                fmt::format("the reference model '{}' has no trajectory here; there are: {}",
                            reference_model, names));
  }
  Comparison comparison{std::string(reference_model), {}};
  std::set<std::string> seen;
  for (const auto& trajectory : trajectories) {
    stop.throw_if_stop_requested();
    if (!seen.insert(trajectory.model).second)
      throw Error(
          ErrorKind::kBadInput,
          fmt::format("two trajectories have the name '{}'; rename one of them", trajectory.model));
    ModelComparison result;
    result.model = trajectory.model;
    const auto lowest = std::ranges::min_element(trajectory.rows, {}, &TrajectoryRow::gap);
    result.minimal_gap = lowest->gap;
    result.minimal_gap_time = lowest->time;
    result.recovered_minimal_gap = trajectory.recovered_minimal_gap;
    result.contact_interval = contact_interval(trajectory);
    result.rebounds = trajectory.rebounds;
    result.budget = trajectory.budget;
    result.steps = trajectory.steps;
    result.seconds = trajectory.seconds;
    measure_distances(trajectory, *reference, result);
    comparison.models.push_back(result);
  }
  return comparison;
}

std::string write_comparison(const Comparison& comparison) {
  Json json;
  json["reference_model"] = comparison.reference_model;
  json["models"] = Json::object();
  for (const auto& model : comparison.models) {
    Json& entry = json["models"][model.model];
    entry["minimal_gap"] = model.minimal_gap;
    entry["minimal_gap_time"] = model.minimal_gap_time;
    entry["recovered_minimal_gap"] =
        model.recovered_minimal_gap ? Json(*model.recovered_minimal_gap) : Json();
    entry["contact_interval"] = model.contact_interval ? Json(*model.contact_interval) : Json();
    entry["rebounds"] = Json::array();
    for (const auto& of : model.rebounds)
      entry["rebounds"].push_back({{"time", of.time},
                                   {"approach_velocity", of.approach_velocity},
                                   {"solid_impulse", of.solid_impulse},
                                   {"velocity", of.velocity},
                                   {"coefficient", of.coefficient}});
    entry["sup_gap_distance"] = model.sup_gap_distance;
    entry["l1_gap_distance"] = model.l1_gap_distance;
    entry["l1_velocity_distance"] = model.l1_velocity_distance;
    entry["books"] = Json();
    if (model.budget)
      for (const auto& amount : kBudgetEntries)
        entry["books"][std::string(amount.name)] = (*model.budget).*amount.value;
    entry["steps"] = model.steps;
    entry["seconds"] = model.seconds;
  }
  json["failed_models"] = Json::object();
  for (const auto& failed : comparison.failed_models)
    json["failed_models"][failed.model] = failed.reason;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Comparison read_comparison(const std::filesystem::path& path) {
  const auto document = JsonDocument::parse(read_file(path), path.string());
  try {
    const auto& json = document.root();
    Comparison comparison;
    comparison.reference_model = json.at("reference_model").get<std::string>();
    for (const auto& [name, entry] : json.at("models").items()) {
      ModelComparison model;
      model.model = name;
      model.minimal_gap = entry.at("minimal_gap").get<double>();
      model.minimal_gap_time = entry.at("minimal_gap_time").get<double>();
      if (!entry.at("recovered_minimal_gap").is_null())
        model.recovered_minimal_gap = entry.at("recovered_minimal_gap").get<double>();
      if (!entry.at("contact_interval").is_null())
        model.contact_interval = entry.at("contact_interval").get<std::array<double, 2>>();
      if (entry.contains("rebounds"))
        for (const auto& of : entry.at("rebounds"))
          model.rebounds.push_back(
              {of.at("time").get<double>(), of.at("approach_velocity").get<double>(),
               of.at("solid_impulse").get<double>(), of.at("velocity").get<double>(),
               of.at("coefficient").get<double>()});
      model.sup_gap_distance = entry.at("sup_gap_distance").get<double>();
      model.l1_gap_distance = entry.at("l1_gap_distance").get<double>();
      model.l1_velocity_distance = entry.at("l1_velocity_distance").get<double>();
      if (entry.contains("books") && !entry.at("books").is_null()) {
        model.budget.emplace();
        for (const auto& amount : kBudgetEntries)
          (*model.budget).*amount.value =
              entry.at("books").at(std::string(amount.name)).get<double>();
      }
      model.steps = entry.at("steps").get<long>();
      model.seconds = entry.at("seconds").get<double>();
      comparison.models.push_back(model);
    }
    if (json.contains("failed_models"))  // Viscontact 0.1.0 did not write this key
      for (const auto& [name, reason] : json.at("failed_models").items())
        comparison.failed_models.push_back({name, reason.get<std::string>()});
    return comparison;
  } catch (const Json::exception& error) {
    throw_bad_input(
        {path.string()},
        fmt::format("is not a comparison file ({}); write one with 'viscontact compare'",
                    cause_in_words(error)));
  }
}

}  // namespace viscontact::reduced_model
