// Runs the stages one after the other. The texts in check_files() must be those that the files
// contain, because files are recognized by them.
#include "viscontact/swimmer/job/swimmer_stage.hpp"

#include <fmt/format.h>

#include <cassert>
#include <optional>
#include <span>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/files/locks.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/json.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/results/run_folder.hpp"
#include "viscontact/swimmer/fit/fit_resistance.hpp"
#include "viscontact/swimmer/job/swimmer_page.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::swimmer {
namespace {

namespace fs = std::filesystem;

struct SwimmerFolder {
  fs::path path;
  fs::path table() const { return path / "table.csv"; }
  fs::path fit() const { return path / "fit.json"; }
  fs::path results() const { return path / "swimmer.json"; }
  fs::path stroke() const { return path / "stroke.csv"; }
  fs::path optimal() const { return path / "optimal_stroke.csv"; }
};

/// Throws Error(kBadInput) if the results would replace a file that Viscontact did not write.
void check_files(const SwimmerFolder& folder) {
  results::refuse_other_kind(folder.table(), "# viscontact: resistance table",
                             "table of resistance matrices");
  results::refuse_other_kind(folder.fit(), "\"resistance fit\"", "fit of resistance matrices");
  results::refuse_other_kind(folder.results(), "\"swimmer\"", "swimmer.json");
  for (const auto& stroke : {folder.stroke(), folder.optimal()})
    results::refuse_other_kind(stroke, "# viscontact: stroke of a swimmer", "stroke");
  (void)report::Report(folder.path, kSwimmerPictures);  // throws for a file of the user
}

ResistanceFit fit_table(const SwimmerFolder& folder, const ResistanceTable& table,
                        const results::Provenance& provenance) {
  auto fit = in_file(folder.table().string(), [&] { return fit_resistance(table); });
  fit.table_sha256 = results::content_sha256(read_file(folder.table()));
  fit.versions = results::library_versions();
  if (const auto text = write_resistance_fit(fit); results::has_content(folder.fit(), text))
    terminal::say("fit: {} is up to date", folder.fit().string());
  else
    results::write_output(folder.fit(), TextKind::kJson, text, provenance);
  terminal::say(
      "fit: a row predicted from the others is off by {:.2g} at most (relative), {:.2g} rms",
      fit.largest_left_one_out_error, fit.rms_left_one_out_error);
  return fit;
}

/// The sums of a stroke, their error estimates and its rows. `multiplier` is that of swim_errors().
StrokeResult result_of(const SwimmerResults& results, const Stroke& stroke, double multiplier) {
  constexpr int kIntervals = 400;  // about the rows of stroke.csv, enough for smooth curves
  const Swimmer swimmer(results.fit);
  const auto sums = swim_sums(swimmer, stroke);
  const auto perturbed = perturbed_fits(results.table, results.fit);
  return {stroke.period, sums,
          swim_errors(sums, stroke, perturbed.lower_degrees, perturbed.table_errors, multiplier),
          swim_rows(swimmer, stroke, kIntervals)};
}

/// The text of stroke.csv or optimal_stroke.csv (docs/file-formats.md).
std::string stroke_csv(const StrokeResult& stroke) {
  assert(!stroke.rows.empty());
  const auto& first = stroke.rows.front();
  std::string text = write_csv_comments(
      {{"viscontact", "stroke of a swimmer"}, {"rows", std::to_string(stroke.rows.size())}});
  text += "time";
  for (Eigen::Index k = 0; k < first.arms.size(); ++k) text += fmt::format(",x{}", k + 1);
  text += ",position";
  for (Eigen::Index i = 0; i < first.forces.size(); ++i) text += fmt::format(",force{}", i + 1);
  text += ",power\n";
  for (const auto& row : stroke.rows) {
    text += format_number(row.time);
    for (const double arm : row.arms) text += "," + format_number(arm);
    text += "," + format_number(row.position);
    for (const double force : row.forces) text += "," + format_number(force);
    text += "," + format_number(row.power) + "\n";
  }
  return text;
}

Json json_of(const StrokeResult& stroke) {
  return {{"displacement", stroke.sums.displacement},
          {"displacement_error_estimate", stroke.errors.displacement},
          {"energy", stroke.sums.energy},
          {"energy_error_estimate", stroke.errors.energy},
          {"energy_at_constant_power", stroke.sums.energy_at_constant_power},
          {"efficiency", stroke.sums.efficiency},
          {"period", stroke.period}};
}

/// The text of swimmer.json (docs/file-formats.md).
std::string results_json(const SwimmerResults& results) {
  Json json = {{"kind", "swimmer"}, {"title", results.c.title}};
  if (results.stroke) json.update(json_of(*results.stroke));
  if (results.optimal) {
    auto& optimal = json["optimal"] = json_of(*results.optimal);
    assert(!results.convergence.empty());
    const auto& last = results.convergence.back();
    optimal["polynomials"] = last.polynomials;
    optimal["euler_lagrange_residual"] = last.euler_lagrange_residual;
    optimal["energy_per_displacement"] = results.energy_per_displacement;
    for (const auto& step : results.convergence)
      optimal["convergence"].push_back({{"polynomials", step.polynomials},
                                        {"energy", step.energy},
                                        {"euler_lagrange_residual", step.euler_lagrange_residual}});
  }
  json["fit"] = {{"largest_left_one_out_error", results.fit.largest_left_one_out_error},
                 {"rms_left_one_out_error", results.fit.rms_left_one_out_error}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void compute_strokes(SwimmerResults& results, const StopToken& stop) {
  const std::string place = results.c.path.string();
  if (results.c.stroke)
    results.stroke = in_file(place, [&] {
      return with_place("[stroke]", [&] { return result_of(results, *results.c.stroke, 0); });
    });
  if (!results.c.optimal) return;
  terminal::show_progress("swimmer: searching for the optimal stroke");
  results.optimal = with_place(place + ": [optimal]", [&] {
    const auto search = find_optimal_stroke(Swimmer(results.fit), *results.c.optimal, stop);
    // The search is for a period of 1. The energy in another period is the energy in a period of 1
    // divided by the period.
    const double period = results.c.optimal_period;
    results.energy_per_displacement = search.multiplier / period;
    results.convergence = search.convergence;
    for (auto& step : results.convergence) step.energy /= period;
    return result_of(results, stroke_of(search.loop, period), results.energy_per_displacement);
  });
  terminal::clear_progress();
}

/// Writes the file of a stroke unless it is up to date, or, if there is no stroke, removes the file
/// of an earlier run. Returns true if the file was written.
bool write_stroke(const fs::path& path, const std::optional<StrokeResult>& stroke,
                  const results::Provenance& provenance) {
  if (stroke)
    return results::write_if_changed(path, TextKind::kHashComment, stroke_csv(*stroke), provenance);
  remove_file(path);
  return false;
}

/// Reads the stroke that json_of() and stroke_csv() wrote for a swimmer with `spheres` >= 2
/// spheres.
StrokeResult read_stroke(const Json& json, const fs::path& path, std::size_t spheres) {
  StrokeResult stroke{json.at("period"),
                      {json.at("displacement"), json.at("energy"),
                       json.at("energy_at_constant_power"), json.at("efficiency")},
                      {json.at("displacement_error_estimate"), json.at("energy_error_estimate")},
                      {}};
  std::vector<std::string> columns = {"time", "position", "power"};
  for (std::size_t k = 1; k < spheres; ++k) columns.push_back(fmt::format("x{}", k));
  for (std::size_t i = 1; i <= spheres; ++i) columns.push_back(fmt::format("force{}", i));
  const auto count = static_cast<Eigen::Index>(spheres);
  read_csv_rows(
      read_file(path), path.string(), columns, columns.size(),
      [&](std::span<const std::optional<double>> fields, int line) {
        Eigen::VectorXd row(std::ssize(fields));
        for (std::size_t i = 0; i < fields.size(); ++i) {
          if (!fields[i]) throw_bad_input({path.string(), line}, "lacks a number");
          row[static_cast<Eigen::Index>(i)] = *fields[i];
        }
        stroke.rows.push_back({row[0], row.segment(3, count - 1), row[1], row.tail(count), row[2]});
      });
  if (stroke.rows.empty()) throw_bad_input({path.string()}, "has no rows");
  return stroke;
}

SwimmerResults read_results(const SwimmerFolder& folder, const fs::path& case_file) {
  SwimmerResults results;
  results.c = read_swimmer_case(case_file);
  results.table = read_resistance_table(folder.table());
  results.fit = read_resistance_fit(folder.fit());
  const auto spheres = results.c.spheres.radii.size();
  read_json(folder.results(), [&](const Json& json) {
    if (results.c.stroke) results.stroke = read_stroke(json, folder.stroke(), spheres);
    if (!results.c.optimal) return;
    const auto& optimal = json.at("optimal");
    results.optimal = read_stroke(optimal, folder.optimal(), spheres);
    for (const auto& step : optimal.at("convergence"))
      results.convergence.push_back(
          {step.at("polynomials"), step.at("energy"), step.at("euler_lagrange_residual")});
  });
  return results;
}

void tell(const std::string& name, const StrokeResult& stroke) {
  terminal::say(
      "{}: displacement {:.9g} (error estimate {:.1g}), energy {:.9g} ({:.1g}), efficiency {:.4g}",
      name, stroke.sums.displacement, stroke.errors.displacement, stroke.sums.energy,
      stroke.errors.energy, stroke.sums.efficiency);
}

}  // namespace

pipeline::CaseTable case_table(const SwimmerCase& c, const fs::path& table) {
  if (c.table_file)
    throw_bad_input({c.path.string()},
                    "names its table with swimmer.table, so that there is none to compute");
  return {c.path, c.text, table, resistance_table_plan(c.spheres, c.gaps), {}, {}};
}

void run_swimmer(const SwimmerRequest& request) {
  assert(request.jobs >= 1);
  SwimmerResults results;
  results.c = read_swimmer_case(request.case_file);
  const SwimmerFolder folder{request.folder};
  check_files(folder);
  const LockedFolder lock(folder.path, results::kFolderIsLocked);
  const auto given = files_of(results.c);
  const auto of_fit = results::provenance_of({given, {}});

  if (results.c.table_file)
    (void)results::write_if_changed(folder.table(), TextKind::kHashComment,
                                    write_resistance_table(results.c.table), of_fit);
  else  // tabulate_stage() throws if a row fails, because the table needs all its rows
    (void)pipeline::tabulate_stage({case_table(results.c, folder.table())}, request.jobs,
                                   request.stop);
  request.stop.throw_if_stop_requested();
  results.table = read_resistance_table(folder.table());
  results.fit = fit_table(folder, results.table, of_fit);
  compute_strokes(results, request.stop);

  const auto provenance = results::provenance_of({given, {folder.table(), folder.fit()}});
  bool wrote = write_stroke(folder.stroke(), results.stroke, provenance);
  if (write_stroke(folder.optimal(), results.optimal, provenance)) wrote = true;
  const auto json = results_json(results);
  if (results::write_if_changed(folder.results(), TextKind::kJson, json, provenance)) wrote = true;
  if (results.stroke) tell("stroke", *results.stroke);
  if (results.optimal) tell("optimal stroke", *results.optimal);
  if (wrote || !report::page_is_current(folder.path, kSwimmerPictures))
    write_swimmer_report(results, folder.path, provenance, request.stop);
  else
    terminal::say("swimmer: {} is up to date", folder.path.string());
  if (request.json) fmt::print("{}", json);
}

void report_swimmer(const fs::path& path, const StopToken& stop) {
  const SwimmerFolder folder{path};
  auto files = results::given_inputs(folder.results());
  const auto results = read_results(folder, files.front());
  files.insert(files.end(), {folder.table(), folder.fit(), folder.results()});
  if (results.stroke) files.push_back(folder.stroke());
  if (results.optimal) files.push_back(folder.optimal());
  write_swimmer_report(results, path, results::provenance_of({files, {}}), stop);
}

}  // namespace viscontact::swimmer
