// The CSV file of a trajectory (docs/file-formats.md), and the selection of rows for it.
#include "viscontact/reduced_model/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <iterator>
#include <limits>
#include <sstream>

#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/lubrication/regime.hpp"
#include "viscontact/reduced_model/motion.hpp"

namespace viscontact::reduced_model {
namespace {

// In the order in which read_trajectory() reads the fields of a row.
const std::array<std::string, 7> kColumns = {
    "time", "gap", "velocity", "lubrication_force", "external_force", "gamma", "solid_force"};
const std::array<std::string, 2> kContactKeys = {"contact_from", "contact_until"};
const std::array<std::string, 2> kSolidKeys = {"solid_contact_from", "solid_contact_velocity"};
const std::string kFilmKey = "film_from_gamma";
const std::string kReynoldsKey = "reynolds_number", kStokesKey = "stokes_number",
                  kFilmStokesKey = "film_stokes_number";
constexpr std::size_t kRequiredColumns = 3;  // time, gap, velocity

std::string optional_number(const OptionalDouble& value) {
  return value ? format_number(*value) : "";
}

/// Throws Error(kBadInput) if the number in the head of the file is missing or is not from 0 to
/// 1e15.
long steps_of(const CsvComments& comments, const std::string& file) {
  constexpr double kMost = 1e15;  // below 2^53, so every integer up to it is a double
  const double steps = csv_comment_number(comments, "steps", file);
  if (!(steps >= 0 && steps <= kMost))
    throw_bad_input({file, 0, "steps"}, "# steps: is {}; it must be from 0 to {}", steps, kMost);
  return static_cast<long>(steps);
}

/// A gap [L] and its time [T], or "never", for each gap; separated by "; ".
std::string write_gap_times(const std::vector<GapTime>& times) {
  std::string text;
  for (const auto& of : times)
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", format_number(of.gap),
                        of.time ? format_number(*of.time) : "never");
  return text;
}

/// The opposite of write_gap_times(). Throws Error(kBadInput) for another text.
std::vector<GapTime> read_gap_times(const std::string& text, const FilePosition& file) {
  std::vector<GapTime> times;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ';');) {
    std::istringstream words(part);
    std::string gap, time;
    words >> gap >> time;
    const auto number = parse_number(gap), at = parse_number(time);
    if (!number || (!at && time != "never"))
      throw_bad_input({file.file, file.line, "time_to_gap"},
                      "time_to_gap in its head has '{}'; it must be a gap and its time", part);
    times.push_back({*number, at});
  }
  return times;
}

/// A rebound as five numbers separated by blanks, in the order of the members of Rebound; rebounds
/// are separated by "; ".
std::string write_rebounds(const std::vector<Rebound>& rebounds) {
  std::string text;
  for (const auto& of : rebounds)
    text += fmt::format("{}{} {} {} {} {}", text.empty() ? "" : "; ", format_number(of.time),
                        format_number(of.approach_velocity), format_number(of.solid_impulse),
                        format_number(of.velocity), format_number(of.coefficient));
  return text;
}

/// The opposite of write_rebounds(). Throws Error(kBadInput) if a rebound does not have five
/// numbers.
std::vector<Rebound> read_rebounds(const std::string& text, const FilePosition& file) {
  std::vector<Rebound> rebounds;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ';');) {
    std::istringstream words(part);
    std::vector<double> numbers;
    for (std::string word; words >> word;)
      if (const auto number = parse_number(word)) numbers.push_back(*number);
    if (numbers.size() != 5)
      throw_bad_input({file.file, file.line, "rebound"},
                      "the rebound '{}' in its head is not five numbers: time, approach_velocity, "
                      "solid_impulse, velocity, coefficient",
                      part);
    rebounds.push_back({numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]});
  }
  return rebounds;
}

}  // namespace

Trajectory read_trajectory(const std::filesystem::path& path) {
  const std::string file = path.string();
  const auto csv = read_csv(path, kColumns, kRequiredColumns);
  Trajectory trajectory;
  trajectory.model = path.stem().string();
  trajectory.provenance = csv.comments;
  const auto take = [&](const std::string& key) -> std::optional<std::string> {
    const auto found = trajectory.provenance.extract(key);
    return found.empty() ? std::nullopt : std::optional(found.mapped());
  };
  const auto take_number = [&](const std::string& key) -> std::optional<double> {
    if (!take(key)) return {};
    return csv_comment_number(csv.comments, key, file);
  };
  if (const auto model = take("model")) trajectory.model = *model;
  trajectory.film_from_gamma = take_number(kFilmKey);
  trajectory.reynolds_number = take_number(kReynoldsKey);
  trajectory.stokes_number = take_number(kStokesKey);
  trajectory.film_stokes_number = take_number(kFilmStokesKey);
  if (take("steps")) trajectory.steps = steps_of(csv.comments, file);
  trajectory.seconds = take_number("seconds").value_or(0);
  if (const auto from = take_number(kContactKeys[0]))
    trajectory.contact_interval = {*from, csv_comment_number(csv.comments, kContactKeys[1], file)};
  if (const auto from = take_number(kSolidKeys[0]))
    trajectory.solid_contact_from = {*from, csv_comment_number(csv.comments, kSolidKeys[1], file)};
  if (const auto times = take("time_to_gap")) trajectory.gap_times = read_gap_times(*times, {file});
  if (const auto rebounds = take("rebounds"))
    trajectory.rebounds = read_rebounds(*rebounds, {file});
  for (const auto& entry : kBudgetEntries)
    if (const auto value = take_number(std::string(entry.name))) {
      if (!trajectory.budget) trajectory.budget.emplace();
      (*trajectory.budget).*entry.value = *value;
    }
  for (const auto& key :
       {std::string("viscontact"), std::string("rows"), kContactKeys[1], kSolidKeys[1]})
    take(key);
  trajectory.rows.reserve(csv.rows.size());
  for (const auto& fields : csv.rows) {
    TrajectoryRow row;
    row.time = required_field(fields, kColumns, 0, file);
    row.gap = required_field(fields, kColumns, 1, file);
    row.velocity = required_field(fields, kColumns, 2, file);
    if (fields.fields[3]) row.lubrication_force = *fields.fields[3];
    if (fields.fields[4]) row.external_force = *fields.fields[4];
    if (fields.fields[5]) row.gamma = *fields.fields[5];
    if (fields.fields[6]) row.solid_force = *fields.fields[6];
    if (row.gap < 0)
      throw_bad_input({file, fields.line, "gap"}, "gap is {}; it must be >= 0", row.gap);
    if (!trajectory.rows.empty() && !(row.time > trajectory.rows.back().time))
      throw_bad_input({file, fields.line, "time"},
                      "time is {} after {}; it must increase from row to row", row.time,
                      trajectory.rows.back().time);
    trajectory.rows.push_back(row);
  }
  if (trajectory.rows.empty())
    throw_bad_input({file}, "has no rows below its header line; it needs at least one");
  return trajectory;
}

std::string write_trajectory(const Trajectory& trajectory) {
  CsvComments comments = trajectory.provenance;
  comments["viscontact"] = "trajectory";
  comments["model"] = trajectory.model;
  comments["rows"] = std::to_string(trajectory.rows.size());
  comments["steps"] = std::to_string(trajectory.steps);
  comments["seconds"] = format_number(trajectory.seconds);
  const auto add = [&](const std::string& key, const std::optional<double>& number) {
    if (number) comments[key] = format_number(*number);
  };
  add(kFilmKey, trajectory.film_from_gamma);
  add(kReynoldsKey, trajectory.reynolds_number);
  add(kStokesKey, trajectory.stokes_number);
  add(kFilmStokesKey, trajectory.film_stokes_number);
  if (trajectory.contact_interval)
    for (std::size_t i = 0; i < kContactKeys.size(); ++i)
      comments[kContactKeys[i]] = format_number((*trajectory.contact_interval)[i]);
  if (const auto& touch = trajectory.solid_contact_from) {
    comments[kSolidKeys[0]] = format_number(touch->time);
    comments[kSolidKeys[1]] = format_number(touch->velocity);
  }
  if (!trajectory.gap_times.empty())
    comments["time_to_gap"] = write_gap_times(trajectory.gap_times);
  if (!trajectory.rebounds.empty()) comments["rebounds"] = write_rebounds(trajectory.rebounds);
  if (trajectory.budget)
    for (const auto& entry : kBudgetEntries)
      comments[std::string(entry.name)] = format_number((*trajectory.budget).*entry.value);
  std::string text = write_csv_comments(comments);
  text += fmt::format("{}\n", fmt::join(kColumns, ","));
  for (const auto& row : trajectory.rows)
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{}\n", format_number(row.time),
                   format_number(row.gap), format_number(row.velocity),
                   optional_number(row.lubrication_force), optional_number(row.external_force),
                   optional_number(row.gamma), optional_number(row.solid_force));
  return text;
}

namespace {

// Whether the film has absorbed an impulse, and whether the solids press on each other.
bool in_contact(const TrajectoryRow& row) { return row.gamma && *row.gamma < 0; }
bool on_solid(const TrajectoryRow& row) { return row.solid_force && *row.solid_force > 0; }

/// The indices of the rows for which in_contact() or on_solid() differs from that of the row
/// before.
std::vector<std::size_t> changes_of_contact(const std::vector<TrajectoryRow>& rows) {
  std::vector<std::size_t> changes;
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (in_contact(rows[i]) != in_contact(rows[i - 1]) ||
        on_solid(rows[i]) != on_solid(rows[i - 1]))
      changes.push_back(i);
  return changes;
}

template <class Value>
std::size_t first_of_least(const std::vector<TrajectoryRow>& rows, const Value& value) {
  return static_cast<std::size_t>(std::ranges::min_element(rows, {}, value) - rows.begin());
}

}  // namespace

std::vector<TrajectoryRow> fewer_rows(const std::vector<TrajectoryRow>& rows, int count) {
  assert(count >= 2);
  const auto wanted = static_cast<std::size_t>(count);
  if (rows.size() <= wanted) return rows;
  std::vector<char> kept(rows.size(), 0);
  const double from = rows.front().time, to = rows.back().time;
  std::size_t row = 0;
  for (std::size_t n = 0; n < wanted; ++n) {
    const double w = static_cast<double>(n) / static_cast<double>(wanted - 1);
    // The factor makes the time slightly earlier, so that rounding cannot skip its row.
    const double time = from + w * (to - from) * (1 - 1e-12);
    while (row + 1 < rows.size() && rows[row].time < time) ++row;
    kept[row] = 1;
  }
  kept.front() = kept.back() = 1;
  kept[first_of_least(rows, [](const TrajectoryRow& r) { return r.gap; })] = 1;
  kept[first_of_least(rows, [](const TrajectoryRow& r) { return -r.gap; })] = 1;
  kept[first_of_least(rows, [](const TrajectoryRow& r) { return r.gamma ? *r.gamma : 0; })] = 1;
  auto changes = changes_of_contact(rows);
  if (changes.size() > wanted) changes = {changes.front(), changes.back()};
  for (const std::size_t i : changes) kept[i - 1] = kept[i] = 1;
  std::vector<TrajectoryRow> result;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (kept[i] != 0) result.push_back(rows[i]);
  return result;
}

std::optional<std::string> reached_wall(const Trajectory& trajectory, const Motion& motion,
                                        double largest_gap) {
  assert(!trajectory.rows.empty());
  const auto& last = trajectory.rows.back();
  if (!(last.time < motion.end_time && last.gap >= motion_ends_at(largest_gap))) return {};
  return fmt::format(
      "the sphere reaches the wall opposite, at the gap {:.6g}, at time {:.6g}; the motion ends "
      "there",
      largest_gap, last.time);
}

std::vector<std::string> regime_warnings(const std::vector<Trajectory>& trajectories) {
  std::string fast, thin;  // names of models
  double reynolds = 0, film = std::numeric_limits<double>::infinity();
  const auto add = [](std::string& names, const std::string& name) {
    names += (names.empty() ? "" : ", ") + name;
  };
  for (const auto& trajectory : trajectories) {
    if (trajectory.reynolds_number.value_or(0) > lubrication::kLargestReynolds) {
      add(fast, trajectory.model);
      reynolds = std::max(reynolds, *trajectory.reynolds_number);
    }
    if (trajectory.film_stokes_number.value_or(film) < lubrication::kSmallestFilmStokes) {
      add(thin, trajectory.model);
      film = std::min(film, *trajectory.film_stokes_number);
    }
  }
  std::vector<std::string> warnings;
  if (const auto warning = lubrication::reynolds_warning(reynolds))
    warnings.push_back(fmt::format("{} ({})", *warning, fast));
  if (const auto warning = lubrication::film_warning(
          film, "viscous_contact_regular_drag and the models without contact resolve the drag"))
    warnings.push_back(fmt::format("{} ({})", *warning, thin));
  return warnings;
}

}  // namespace viscontact::reduced_model
