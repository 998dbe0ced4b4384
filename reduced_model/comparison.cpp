// Distances of trajectories by exact integrals, and the comparison file.
#include "viscontact/reduced_model/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/json_fields.hpp"

namespace viscontact::reduced_model {
namespace {

/// Gap and velocity of a trajectory, linear between its rows.
class Interpolation {
 public:
  explicit Interpolation(const std::vector<TrajectoryRow>& rows) : rows_(rows) {}

  struct Value {
    double gap, velocity;
  };

  /// `time` [T] is not outside the rows, and not before the time of an earlier call.
  Value at(double time) {
    assert(rows_.front().time <= time && time <= rows_.back().time);
    assert(next_ == 0 || rows_[next_ - 1].time < time);
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

/// Integral of |d| over a step of time of the length `step` >= 0, in which d changes linearly from
/// d0 to d1.
double integral_of_absolute(double d0, double d1, double step) {
  assert(step >= 0);
  if (d0 * d1 >= 0) return step * (std::abs(d0) + std::abs(d1)) / 2;
  return step * (d0 * d0 + d1 * d1) / (2 * (std::abs(d0) + std::abs(d1)));
}

/// Sets the distances of `result` over the times that both trajectories cover. Throws
/// Error(kBadInput) if there are none.
void measure_distances(const Trajectory& trajectory, const Trajectory& reference,
                       ModelComparison& result) {
  const double from = std::max(trajectory.rows.front().time, reference.rows.front().time);
  const double to = std::min(trajectory.rows.back().time, reference.rows.back().time);
  if (from > to)
    throw Error(
        ErrorKind::kBadInput,
        "trajectories {} and {} have no time in common (they are from {} to {} and from {} to {})",
        trajectory.model, reference.model, trajectory.rows.front().time,
        trajectory.rows.back().time, reference.rows.front().time, reference.rows.back().time);
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

/// ModelComparison::contact_interval.
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
                "the reference model '{}' has no trajectory here; there are: {}", reference_model,
                names);
  }
  Comparison comparison{std::string(reference_model), {}};
  const auto& head = trajectories.front().provenance;
  if (const auto units = head.find("units"); units != head.end()) comparison.units = units->second;
  std::set<std::string> seen;
  for (const auto& trajectory : trajectories) {
    stop.throw_if_stop_requested();
    if (!seen.insert(trajectory.model).second)
      throw Error(ErrorKind::kBadInput, "two trajectories have the name '{}'; rename one of them",
                  trajectory.model);
    ModelComparison result;
    assert(!trajectory.rows.empty());
    result.model = trajectory.model;
    const auto lowest = std::ranges::min_element(trajectory.rows, {}, &TrajectoryRow::gap);
    result.minimal_gap = lowest->gap;
    result.minimal_gap_time = lowest->time;
    result.film_from_gamma = trajectory.film_from_gamma;
    result.contact_interval = contact_interval(trajectory);
    result.solid_contact_from = trajectory.solid_contact_from;
    result.gap_times = trajectory.gap_times;
    result.rebounds = trajectory.rebounds;
    result.budget = trajectory.budget;
    result.reynolds_number = trajectory.reynolds_number;
    result.stokes_number = trajectory.stokes_number;
    result.film_stokes_number = trajectory.film_stokes_number;
    result.steps = trajectory.steps;
    result.seconds = trajectory.seconds;
    measure_distances(trajectory, *reference, result);
    comparison.models.push_back(result);
  }
  return comparison;
}

void fields_of(JsonFields& json, SolidTouch& touch) {
  // The functions fields_of() state the keys of the file in their order, for reading and writing.
  json("time", touch.time);
  json("velocity", touch.velocity);
}

void fields_of(JsonFields& json, GapTime& of) {
  json("gap", of.gap);
  json("time", of.time);
}

void fields_of(JsonFields& json, Rebound& rebound) {
  json("time", rebound.time);
  json("approach_velocity", rebound.approach_velocity);
  json("solid_impulse", rebound.solid_impulse);
  json("velocity", rebound.velocity);
  json("coefficient", rebound.coefficient);
}

void fields_of(JsonFields& json, MomentumEnergyBudget& budget) {
  for (const auto& amount : kBudgetEntries) json(std::string(amount.name), budget.*amount.value);
}

void fields_of(JsonFields& json, ModelComparison& model) {
  json("minimal_gap", model.minimal_gap);
  json("minimal_gap_time", model.minimal_gap_time);
  json("film_from_gamma", model.film_from_gamma);
  json("contact_interval", model.contact_interval);
  json("solid_contact_from", model.solid_contact_from);
  json("time_to_gap", model.gap_times, Absence::kLeftOutIfEmpty);
  json("rebounds", model.rebounds);
  json("sup_gap_distance", model.sup_gap_distance);
  json("l1_gap_distance", model.l1_gap_distance);
  json("l1_velocity_distance", model.l1_velocity_distance);
  json("books", model.budget);
  json("reynolds_number", model.reynolds_number);
  json("stokes_number", model.stokes_number);
  json("film_stokes_number", model.film_stokes_number);
  json("steps", model.steps);
  json("seconds", model.seconds);
}

void fields_of(JsonFields& json, Comparison& comparison) {
  json("reference_model", comparison.reference_model);
  json("units", comparison.units, Absence::kLeftOutIfEmpty);
  json.by_name(
      "models", comparison.models, &ModelComparison::model,
      [](ModelComparison & model) -> auto& { return model; });
  json.by_name(
      "failed_models", comparison.failed_models, &ModelWithoutTrajectory::model,
      [](ModelWithoutTrajectory & failed) -> auto& { return failed.reason; },
      Absence::kLeftOutIfEmpty);
  json.foreign_object("provenance");
}

std::string write_comparison(const Comparison& comparison) {
  return JsonFields::text_of(comparison);
}

Comparison read_comparison(const std::filesystem::path& path) {
  return JsonFields::read<Comparison>(read_file(path), path.string(),
                                      "; 'viscontact compare' writes such a file");
}

}  // namespace viscontact::reduced_model
