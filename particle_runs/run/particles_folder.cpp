// Files of frames are recognised by their names, files of Viscontact by their provenance.
#include "viscontact/particle_runs/run/particles_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/json.hpp"
#include "viscontact/particle_runs/io/rheology_file.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"
#include "viscontact/results/foreign_files.hpp"

namespace viscontact {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FileEnd, bytes, last_line)
}  // namespace viscontact

namespace viscontact::particles {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RelativeErrors, best, of_one_mesh, of_penalty)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(ParticleRegime, reynolds, stokes, film, has_contact,
                                                have_solids_touched)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RheologyMeans::Block, duration, means)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(RheologyMeans, blocks)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(
    StepTotals, steps, unconverged, failed, iterations, most_iterations, first_time, last_time,
    largest_residual, largest_overlap, largest_impulse_residual, divided, unresolved, buckling,
    largest_buckling, first_buckling, lacks_springs, given_loads, regime, seconds,
    peak_memory_mebibytes, fluid_seconds, advection_errors, largest_advection_error, unknowns,
    first_velocity_errors, last_velocity_errors, first_force_errors, last_force_errors,
    averaged_time, mean_dissipation, mean_apparent_viscosity, contact_time, contact_means, rheology,
    jammed, first_jam, jammed_bodies, given_load, growing)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RunRecord, totals, frames, flows, last_frame, rebounds, files)

namespace {
constexpr const char* kRecordOf = "# record after step ";
}  // namespace

void StepTotals::add(const StepReport& report, double average_from) {
  ++steps;
  unconverged += report.converged ? 0 : 1;
  failed += report.converged || report.excess <= kStillAResult ? 0 : 1;
  iterations += report.iterations;
  most_iterations = std::max(most_iterations, report.iterations);
  largest_residual = std::max(largest_residual, report.residual);
  largest_overlap = std::max(largest_overlap, report.largest_overlap);
  largest_impulse_residual = std::max(largest_impulse_residual, report.impulse_residual);
  divided += report.parts > 1 ? 1 : 0;
  unresolved += static_cast<std::int64_t>(report.unresolved);
  if (report.buckling > 1 && ++buckling == 1) first_buckling = report.buckling;
  largest_buckling = std::max(largest_buckling, report.buckling);
  lacks_springs += report.lacks_springs ? 1 : 0;
  given_loads += report.has_given_loads ? 1 : 0;
  // A load that follows a motion through a spring, or the inertia of ever more particles, grows in
  // proportion to the time, and hence by ever smaller factors.
  constexpr double kGrowth = 1.5;
  constexpr int kGrowing = 10;
  growing = given_load > 0 && report.given_load > kGrowth * given_load ? growing + 1 : 0;
  given_load = report.given_load;
  if (!report.pressing.empty() && (report.jams || growing >= kGrowing) && ++jammed == 1) {
    first_jam = report.time;
    jammed_bodies = report.pressing;
  }
  const auto& fluid = report.fluid;
  fluid_seconds += fluid.seconds;
  advection_errors += fluid.advection_error > kNamedAdvectionError ? 1 : 0;
  largest_advection_error = std::max(largest_advection_error, fluid.advection_error);
  if (const double duration = report.time - std::max(last_time, average_from);
      duration > 0 && !fluid.is_computed_again) {
    averaged_time += duration;
    // This form of the mean has no rounding error if all values are equal (Welford 1962).
    const auto include = [&](double& mean, double value) {
      mean += (value - mean) * (duration / averaged_time);
    };
    include(mean_dissipation, fluid.dissipation);
    include(mean_apparent_viscosity, fluid.apparent_viscosity);
  }
  last_time = report.time;
  if (fluid.velocity_errors.best < 0) return;
  if (first_velocity_errors.best < 0) {
    first_velocity_errors = fluid.velocity_errors;
    first_force_errors = fluid.force_errors;
  }
  last_velocity_errors = fluid.velocity_errors;
  last_force_errors = fluid.force_errors;
}

void StepTotals::add_means(const std::vector<double>& values, double duration) {
  assert(contact_means.empty() || contact_means.size() == values.size());
  if (!(duration > 0)) return;
  contact_means.resize(values.size());
  contact_time += duration;
  for (std::size_t k = 0; k < values.size(); ++k)
    contact_means[k] += (values[k] - contact_means[k]) * (duration / contact_time);
}

std::string record_comment(const RunRecord& record, std::int64_t step) {
  return fmt::format("{}{}: {}\n", kRecordOf, step, nlohmann::json(record).dump());
}

RunRecord read_record(const std::string& head, const std::filesystem::path& restart) {
  const auto line = head.find(kRecordOf);
  const auto json = head.find('{', line);
  if (line == std::string::npos || json == std::string::npos)
    throw_bad_input({restart.string()}, "has no record of its run");
  try {
    return nlohmann::json::parse(head.substr(json, head.find('\n', json) - json));
  } catch (const nlohmann::json::exception&) {
    throw_bad_input({restart.string()}, "has a damaged record of its run");
  }
}

namespace {

/// Adds the means over time of the stress, of the forces on obstacles and of the loads of particles
/// whose motion is given, in the order in which RunLog::add_step() makes them.
void add_contact_means(const ParticlesCase& c, const StepTotals& totals, Json& json) {
  const auto n = static_cast<std::size_t>(c.particles.dimension);
  std::size_t next = 0;
  const auto row = [&](std::size_t count) {
    Json numbers = Json::array();
    for (std::size_t d = 0; d < count; ++d)
      numbers.push_back(next < totals.contact_means.size() ? Json(totals.contact_means[next])
                                                           : Json()),
          ++next;
    return numbers;
  };
  json["average_from"] = std::max(c.average_from, totals.first_time);
  if (!std::holds_alternative<std::monostate>(c.setting.domain)) {
    json["mean_stress"] = Json::array();
    for (std::size_t i = 0; i < n; ++i) json["mean_stress"].push_back(row(n));
  }
  json["mean_wall_forces"] = Json::array();
  for (std::size_t w = 0; w < obstacles_of(c.setting).size(); ++w)
    json["mean_wall_forces"].push_back(row(n));
  if (c.setting.fluid || c.setting.given_motions.empty()) return;
  json["mean_given_loads"] = Json::array();
  for (const auto& [particle, motion] : c.setting.given_motions) {
    Json load;
    load["id"] = c.particles.id(index_of(particle));
    load["contact_force"] = row(n);
    load["contact_torque"] = row(n == 3 ? 3 : 1);
    json["mean_given_loads"].push_back(load);
  }
}

/// The means over time of the rheology, and their standard errors.
void add_rheology(const ParticlesCase& c, const StepTotals& totals, Json& json) {
  json["average_from"] = std::max(c.average_from, totals.first_time);
  json["rheology_blocks"] = totals.rheology.filled_blocks();
  const auto known = [](const std::optional<double>& number) {
    return number ? Json(*number) : Json();
  };
  for (std::size_t k = 0; k < kRheologyMeans.size(); ++k) {
    json[mean_name(k)] = known(totals.rheology.mean(k));
    json[standard_error_name(k)] = known(totals.rheology.standard_error(k));
  }
}

}  // namespace

std::string run_json(const ParticlesCase& c, const StepTotals& totals, const State& state) {
  const auto steps = static_cast<double>(std::max<std::int64_t>(totals.steps, 1));
  Json json;
  json["title"] = c.title;
  json["particles"] = state.particles.count();
  json["dimension"] = state.particles.dimension;
  json["from_time"] = totals.first_time;
  json["to_time"] = totals.last_time;
  json["time_step"] = c.setting.time_step;
  json["steps"] = totals.steps;
  json["unconverged_steps"] = totals.unconverged;
  json["failed_steps"] = totals.failed;
  json["iterations"] = totals.iterations;
  json["mean_iterations"] = static_cast<double>(totals.iterations) / steps;
  json["largest_iterations"] = totals.most_iterations;
  json["accuracy"] = c.setting.solver.accuracy == Accuracy::kPacking ? "packing" : "full";
  json["tolerance"] = c.setting.solver.tolerance;
  json["impulse_tolerance"] = c.setting.solver.impulse_tolerance;
  json["largest_residual"] = totals.largest_residual;
  json["largest_impulse_residual"] = totals.largest_impulse_residual;
  json["largest_gamma_error"] = largest_gamma_error(state);
  json["divided_steps"] = totals.divided;
  json["unresolved_contacts"] = totals.unresolved;
  json["buckling_steps"] = totals.buckling;
  json["steps_without_springs"] = totals.lacks_springs;
  json["steps_with_given_loads"] = totals.given_loads;
  json["largest_overlap"] = totals.largest_overlap;
  json["final_overlap"] = largest_overlap(c.setting, state);
  const auto known = [](double number) { return number < 0 ? Json() : Json(number); };
  json["reynolds_number"] = known(totals.regime.reynolds);
  json["stokes_number"] = known(totals.regime.stokes);
  json["film_stokes_number"] = known(totals.regime.has_contact ? totals.regime.film : -1);
  json["seconds"] = totals.seconds;
  json["peak_memory_mebibytes"] = totals.peak_memory_mebibytes;
  json["jammed_steps"] = totals.jammed;
  json["first_jam"] = totals.jammed > 0 ? Json(totals.first_jam) : Json();
  if (c.average_from_given) add_contact_means(c, totals, json);
  if (c.setting.lubrication) add_rheology(c, totals, json);
  if (c.setting.fluid) {
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
    add_estimates("velocity_error_estimate", totals.first_velocity_errors,
                  totals.last_velocity_errors);
    add_estimates("force_error_estimate", totals.first_force_errors, totals.last_force_errors);
    json["average_from"] = std::max(c.average_from, totals.first_time);
    const auto mean = [&](double value) { return totals.averaged_time > 0 ? Json(value) : Json(); };
    json["mean_dissipation"] = mean(totals.mean_dissipation);
    json["mean_apparent_viscosity"] = mean(totals.mean_apparent_viscosity);
    if (c.setting.fluid->advection == Advection::kCharacteristics) {
      json["advection_error"] = totals.largest_advection_error;
      json["steps_with_advection_error"] = totals.advection_errors;
    }
    json["unknowns"] = totals.unknowns;
    json["fluid_seconds"] = totals.fluid_seconds;
  }
  return json.dump(2) + "\n";
}

namespace {

namespace fs = std::filesystem;

/// The number in a name such as particles_00012.vtp; nothing if it is not the name of such a file.
std::optional<std::uint64_t> number_of_frame(const FrameKind& kind, std::string_view name) {
  const std::string_view begin(kind.begin);
  if (!name.starts_with(begin) || name.size() <= begin.size()) return {};
  std::uint64_t number = 0;
  std::from_chars(name.data() + begin.size() + 1, name.data() + name.size(), number);
  if (name != frame_name(kind, number)) return {};
  return number;
}

/// The files whose numbers are at least `first`, in no particular order.
std::vector<fs::path> frames_in(const fs::path& folder, const FrameKind& kind,
                                std::uint64_t first) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (const auto number = number_of_frame(kind, entry.path().filename().string());
        number && *number >= first)
      files.push_back(entry.path());
  return files;
}

}  // namespace

std::string frame_name(const FrameKind& kind, std::uint64_t number) {
  return fmt::format("{}_{:05}{}", kind.begin, number, kind.end);
}

void check_results(const fs::path& folder) {
  for (const auto* name : kParticleResults) results::refuse_other_kind(folder / name, "", "result");
  for (const auto& kind : {kFrameFile, kFlowFile, kLinksFile})
    for (const auto& file : frames_in(folder, kind, 0))
      results::refuse_other_kind(file, "", "result");
}

void check_inputs_stay(const ParticlesCase& c, const fs::path& restart, const fs::path& folder) {
  std::error_code none;
  if (!restart.empty() && fs::equivalent(fs::absolute(restart).parent_path(), folder, none))
    throw_bad_input({restart.string()},
                    "belongs to the run in the output folder, whose frames and record would be "
                    "lost; choose another folder, or give no restart file: the same command "
                    "continues an interrupted run in its own folder");
  auto inputs = files_of(c);
  inputs.push_back(c.path);
  for (const auto& input : inputs) {
    for (const std::string output : kParticleResults)
      if (fs::equivalent(input, folder / output, none))
        throw_bad_input({input.string()},
                        "would be overwritten by the run's " + output + "; choose another folder");
  }
}

void remove_results(const fs::path& folder) {
  for (const auto* name : kParticleResults) remove_file(folder / name);
  remove_later_frames(folder, 0, 0);
}

void remove_later_frames(const fs::path& folder, std::uint64_t frames, std::uint64_t flows) {
  for (const auto& [kind, first] :
       {std::pair{kFrameFile, frames}, {kLinksFile, frames}, {kFlowFile, flows}})
    for (const auto& file : frames_in(folder, kind, first)) remove_file(file);
  remove_unfinished(folder);
}

}  // namespace viscontact::particles
