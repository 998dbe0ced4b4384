// Reads tables, calls fitting/, and writes fits, shifts and pictures with their provenance.
#include "viscontact/pipeline/fit_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/report/summaries.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::pipeline {
namespace fs = std::filesystem;

void fit_stage(const fs::path& table_path, const fs::path& fit_path,
               const fitting::FitSettings& settings, const results::Provenance& provenance,
               const StopToken& stop) {
  const auto table = lubrication::read_force_table(table_path);
  stop.throw_if_stop_requested();
  lubrication::Fit fit =
      in_file(table_path.string(), [&] { return fitting::fit_force_table(table, settings, stop); });
  if (fs::is_regular_file(table_path))  // a pipe cannot be read a second time
    fit.table_sha256 = results::content_sha256(read_file(table_path));
  fit.versions = results::library_versions();
  stop.throw_if_stop_requested();
  for (const auto& warning : fit.diagnostics->warnings) terminal::warn("fit: warning: {}", warning);
  const std::string text = lubrication::write_fit(fit);
  if (results::has_content(fit_path, text)) {
    terminal::say("fit: {} is up to date", fit_path.string());
    return;
  }
  results::write_output(fit_path, TextKind::kJson, text, provenance);
  terminal::say(report::fit_in_words(fit));
}

void compare_bases_stage(const fs::path& table_path, const fitting::FitSettings& settings,
                         const results::PictureRequest& picture, bool json, const StopToken& stop) {
  const auto provenance = results::provenance_of({{table_path}, {}});
  const auto table = lubrication::read_force_table(table_path);
  const auto results = fitting::compare_bases(table, settings, stop);
  if (std::ranges::none_of(
          results, [](const fitting::BasisResult& result) { return result.fit.has_value(); }))
    throw_bad_input({table_path.string()}, results.front().failure);
  // The numbers come first because the picture needs gnuplot, which may be missing.
  fmt::print("{}", json ? report::basis_json(results) : report::basis_table(results));
  const auto format = picture.format();
  results::write_output(picture.path, format.kind, report::plot_bases(table, results, format, stop),
                        provenance);
}

void shift_stage(const fs::path& table_path, const fs::path& fit_path, const fs::path& shift_path,
                 const results::PictureRequest& picture, const StopToken& stop) {
  const auto provenance = results::provenance_of({{table_path, fit_path}, {}});
  const auto rough = lubrication::read_force_table(table_path);
  const auto shift = with_place(table_path.string() + ", " + fit_path.string(), [&] {
    return fitting::fit_wall_shift(rough,
                                   lubrication::LubricationForce(lubrication::read_fit(fit_path)));
  });
  std::string text = write_csv_comments(
      {{"viscontact", "wall shift"},
       {"geometry", rough.geometry},
       {"table", results::content_sha256(read_file(table_path))},
       {"fit", results::content_sha256(read_file(fit_path))},
       {"shift", format_number(shift.shift)},
       {"largest_relative_residual", format_number(shift.largest_relative_residual)},
       {"rms_relative_residual", format_number(shift.rms_relative_residual)},
       {"rows", std::to_string(shift.rows.size())}});
  text += "gap,shift,relative_residual,relative_error_estimate\n";
  for (const auto& row : shift.rows)
    text += fmt::format("{},{},{},{}\n", format_number(row.gap), format_number(row.shift),
                        format_number(row.relative_residual),
                        format_number(row.relative_error_estimate));
  results::write_output(shift_path, TextKind::kHashComment, text, provenance);
  fmt::print("shift {:.6g}; relative residual: largest {:.2g}, rms {:.2g}\n", shift.shift,
             shift.largest_relative_residual, shift.rms_relative_residual);
  // The picture comes last because it needs gnuplot, which may be missing.
  if (picture.path.empty()) return;
  const auto format = picture.format();
  results::write_output(picture.path, format.kind,
                        report::plot_wall_shift(shift, rough.geometry, format, stop), provenance);
}

}  // namespace viscontact::pipeline
