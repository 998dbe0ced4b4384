// Writes and reads steps.csv (comment lines with the sums as JSON, then a row for each step), and
// writes run.json. A change must keep the keys of for_each_sum, because earlier files have them.
#include "viscontact/particles/run/particles_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/particles/current_contacts.hpp"

namespace viscontact::particles {
namespace {

using Json = nlohmann::ordered_json;

// A million rows are 50 MB. After that many steps, only every thousandth step and the steps that
// did not converge get a row.
constexpr std::int64_t kMostRows = 1000000, kThen = 1000;

constexpr std::string_view kInertiaColumns =
    ",kinetic_energy_fluid,reynolds_number,courant_number,given_force_x,given_force_y";

std::string comment_begin(std::int64_t last_step) {
  return fmt::format("# record after step {}: ", last_step);
}

template <class Errors, class Visit>
void visit_errors(const std::string& of, Errors& errors, const Visit& visit) {
  visit((of + "_error").c_str(), errors.best);
  visit((of + "_error_of_one_mesh").c_str(), errors.of_one_mesh);
  visit((of + "_error_of_penalty").c_str(), errors.of_penalty);
}

/// Calls `visit` with the key and the value of each sum, in the order in which a comment of
/// steps.csv has them.
template <class Totals, class Visit>
void for_each_sum(Totals& sums, const Visit& visit) {
  visit("steps", sums.steps);
  visit("unconverged", sums.unconverged);
  visit("iterations", sums.iterations);
  visit("most_iterations", sums.most_iterations);
  visit("first_time", sums.first_time);
  visit("last_time", sums.last_time);
  visit("largest_residual", sums.largest_residual);
  visit("largest_overlap", sums.largest_overlap);
  visit("largest_impulse_residual", sums.largest_impulse_residual);
  visit("divided", sums.divided);
  visit("unresolved", sums.unresolved);
  visit("seconds", sums.seconds);
  visit("peak_memory_mebibytes", sums.peak_memory_mebibytes);
  if (!sums.has_fluid) return;
  visit("fluid_seconds", sums.fluid_seconds);
  visit("unknowns", sums.unknowns);
  visit_errors("first_velocity", sums.first_velocity_errors, visit);
  visit_errors("last_velocity", sums.last_velocity_errors, visit);
  visit_errors("first_force", sums.first_force_errors, visit);
  visit_errors("last_force", sums.last_force_errors, visit);
}

/// The header line of `text` and its rows up to the step `last_step`.
std::string rows_until(std::string_view text, std::string_view header, std::int64_t last_step) {
  const auto begin = text.find(header);
  if (begin == std::string_view::npos) return "";
  auto end = begin + header.size();
  for (auto line_end = text.find('\n', end); line_end != std::string_view::npos;
       line_end = text.find('\n', end)) {
    std::int64_t step = 0;
    const auto [stop, error] = std::from_chars(text.data() + end, text.data() + line_end, step);
    if (error != std::errc() || *stop != ',' || step > last_step) break;
    end = line_end + 1;
  }
  return std::string(text.substr(begin, end - begin));
}

}  // namespace

StepRecord::StepRecord(bool in_fluid, bool with_inertia) {
  has_fluid = in_fluid;
  has_inertia = with_inertia;
  rows =
      "step,time,contacts,glued,iterations,residual,largest_overlap,converged,impulse_residual,"
      "parts,unresolved";
  if (has_fluid) rows += ",dissipation,apparent_viscosity,fluid_seconds";
  if (has_inertia) rows += kInertiaColumns;
  rows += '\n';
}

void StepRecord::add(std::int64_t step, const StepReport& report) {
  last_step = step;
  ++steps;
  unconverged += report.converged ? 0 : 1;
  iterations += report.iterations;
  most_iterations = std::max(most_iterations, report.iterations);
  largest_residual = std::max(largest_residual, report.residual);
  largest_overlap = std::max(largest_overlap, report.largest_overlap);
  largest_impulse_residual = std::max(largest_impulse_residual, report.impulse_residual);
  divided += report.parts > 1 ? 1 : 0;
  unresolved += static_cast<std::int64_t>(report.unresolved);
  last_time = report.time;
  const auto& fluid = report.fluid;
  fluid_seconds += fluid.seconds;
  if (fluid.velocity_errors.best >= 0) {
    if (first_velocity_errors.best < 0) {
      first_velocity_errors = fluid.velocity_errors;
      first_force_errors = fluid.force_errors;
    }
    last_velocity_errors = fluid.velocity_errors;
    last_force_errors = fluid.force_errors;
  }
  if (steps > kMostRows && steps % kThen != 0 && report.converged) return;
  fmt::format_to(std::back_inserter(rows), "{},{},{},{},{},{},{},{},{},{},{}", step,
                 format_number(report.time), report.contacts, report.glued, report.iterations,
                 format_number(report.residual), format_number(report.largest_overlap),
                 report.converged ? 1 : 0, format_number(report.impulse_residual), report.parts,
                 report.unresolved);
  if (has_fluid)
    fmt::format_to(std::back_inserter(rows), ",{},{},{:.3g}", format_number(fluid.dissipation),
                   format_number(fluid.apparent_viscosity), fluid.seconds);
  if (has_inertia)
    fmt::format_to(std::back_inserter(rows), ",{},{},{},{},{}", format_number(fluid.kinetic_energy),
                   format_number(fluid.reynolds_number), format_number(fluid.courant_number),
                   format_number(fluid.given_force[0]), format_number(fluid.given_force[1]));
  rows += '\n';
}

std::string record_comment(const StepTotals& sums) {
  Json json;
  for_each_sum(sums, [&](const char* key, const auto& value) { json[key] = value; });
  return comment_begin(sums.last_step) + json.dump() + "\n";
}

std::string run_json(const ParticlesCase& c, const StepTotals& record, const State& state) {
  const auto steps = static_cast<double>(std::max<std::int64_t>(record.steps, 1));
  Json json;
  json["title"] = c.title;
  json["particles"] = state.particles.count();
  json["dimension"] = state.particles.dimension;
  json["from_time"] = record.first_time;
  json["to_time"] = record.last_time;
  json["time_step"] = c.setting.time_step;
  json["steps"] = record.steps;
  json["unconverged_steps"] = record.unconverged;
  json["iterations"] = record.iterations;
  json["mean_iterations"] = static_cast<double>(record.iterations) / steps;
  json["largest_iterations"] = record.most_iterations;
  json["tolerance"] = c.setting.solver.tolerance;
  json["impulse_tolerance"] = c.setting.solver.impulse_tolerance;
  json["largest_residual"] = record.largest_residual;
  json["largest_impulse_residual"] = record.largest_impulse_residual;
  json["largest_gamma_error"] = largest_gamma_error(state);
  json["divided_steps"] = record.divided;
  json["unresolved_contacts"] = record.unresolved;
  json["largest_overlap"] = record.largest_overlap;
  json["final_overlap"] = largest_overlap(c.setting, state);
  json["seconds"] = record.seconds;
  json["peak_memory_mebibytes"] = record.peak_memory_mebibytes;
  if (record.has_fluid) {
    const auto add_estimates = [&](const std::string& key, const RelativeErrors& first,
                                   const RelativeErrors& last) {
      const auto number = [](double error) { return error < 0 ? Json() : Json(error); };
      const auto add = [&](const std::string& name, double of_first, double of_last) {
        json[name] = {{"first_step", number(of_first)}, {"last_step", number(of_last)}};
      };
      add(key, first.best, last.best);
      add(key + "_of_one_mesh", first.of_one_mesh, last.of_one_mesh);
      add(key + "_of_penalty", first.of_penalty, last.of_penalty);
    };
    add_estimates("velocity_error_estimate", record.first_velocity_errors,
                  record.last_velocity_errors);
    add_estimates("force_error_estimate", record.first_force_errors, record.last_force_errors);
    json["unknowns"] = record.unknowns;
    json["fluid_seconds"] = record.fluid_seconds;
  }
  return json.dump(2) + "\n";
}

StepRecord read_step_record(const std::filesystem::path& path, std::int64_t last_step,
                            bool has_fluid) {
  const std::string text = read_file(path);
  const std::string begin = comment_begin(last_step);
  const auto at = text.find(begin);
  if (at == std::string::npos)
    throw_bad_input({path.string()}, fmt::format("has no record after step {}", last_step));
  StepRecord record(has_fluid, text.find(kInertiaColumns) != std::string::npos);
  record.last_step = last_step;
  const auto json_begin = at + begin.size();
  try {
    const Json json =
        Json::parse(text.substr(json_begin, text.find('\n', json_begin) - json_begin));
    for_each_sum(record, [&](const char* key, auto& value) { json.at(key).get_to(value); });
  } catch (const Json::exception&) {
    throw_bad_input({path.string()}, fmt::format("its record after step {} is damaged", last_step));
  }
  record.rows = rows_until(text, record.rows, last_step);
  const auto lines = std::ranges::count(record.rows, '\n');
  if (lines == 0 || (record.steps <= kMostRows && lines != record.steps + 1))
    throw_bad_input({path.string()},
                    fmt::format("has {} rows up to step {}, its record says {}",
                                std::max<std::int64_t>(lines - 1, 0), last_step, record.steps));
  return record;
}

}  // namespace viscontact::particles
