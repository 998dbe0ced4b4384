// Chooses the gaps, names the files and writes the pictures of a tabulation.
#include "viscontact/pipeline/tabulate/picture_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>
#include <string_view>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/report/flow/flow_plots.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::pipeline {
namespace {

/// One of the files that are written for each gap. A file without its marker is not replaced.
struct PictureFile {
  std::string_view end;     ///< end of the file's name
  std::string_view marker;  ///< text that every file of this kind contains
  std::string_view kind;    ///< name of the kind in messages
};
constexpr PictureFile kMesh{"_mesh.svg", "<svg", "picture"};
constexpr PictureFile kFlow{"_flow.svg", "<svg", "picture"};
constexpr PictureFile kFilm{"_film.svg", "<svg", "picture"};
constexpr PictureFile kVtu{".vtu", "<VTKFile", "VTK file"};

/// Seven digits of the gap, so that gaps_to_picture() accepts the number in the name.
std::filesystem::path path_of(const std::filesystem::path& folder, double gap,
                              const PictureFile& file) {
  return folder / fmt::format("gap_{:.7g}{}", gap, file.end);
}

}  // namespace

void check_pictures(const std::vector<double>& gaps, const std::filesystem::path& folder) {
  for (const double gap : gaps)
    for (const auto& file : {kMesh, kFlow, kFilm, kVtu})
      results::refuse_other_kind(path_of(folder, gap, file), file.marker, file.kind);
}

std::vector<double> gaps_to_picture(const freefem_axi::Tabulation& tabulation,
                                    const std::vector<double>& asked) {
  assert(!tabulation.gaps.empty());
  constexpr double kTolerance = 1e-6;  // relative; names of files have seven digits of the gap
  auto sorted = tabulation.gaps;
  std::ranges::sort(sorted);
  if (asked.empty()) {
    const std::set gaps = {sorted.front(), sorted[sorted.size() / 2], sorted.back()};
    return {gaps.begin(), gaps.end()};
  }
  std::vector<double> gaps;
  for (const double gap : asked) {
    const double nearest =
        *std::ranges::min_element(sorted, {}, [&](double g) { return std::abs(g - gap); });
    if (!(std::abs(nearest - gap) <= kTolerance * nearest))
      throw Error(ErrorKind::kBadInput,
                  "{} is not one of the case's gaps; the nearest of them is {}", format_number(gap),
                  format_number(nearest));
    gaps.push_back(nearest);
  }
  return gaps;
}

std::filesystem::path picture_folder(const std::filesystem::path& table_path) {
  auto folder = table_path;
  return folder.replace_extension(".plots");
}

void picture_stage(const freefem_axi::Tabulation& tabulation, lubrication::MotionKind motion,
                   const std::vector<double>& gaps, const std::filesystem::path& folder,
                   const std::filesystem::path& case_file, const StopToken& stop) {
  const bool approaches = motion == lubrication::MotionKind::kApproach;
  const auto freefem = freefem_axi::default_freefem(stop);
  const auto provenance = results::provenance_of({{case_file}, {}});
  for (const double gap : gaps) {
    stop.throw_if_stop_requested();
    terminal::show_progress(fmt::format("tabulate: pictures of gap {:.7g}", gap));
    const auto picture = freefem_axi::solve_row_for_picture(
        freefem, tabulation, gap, tabulation.reference_velocities.front(), motion);
    const auto path = [&](const PictureFile& file) { return path_of(folder, gap, file); };
    // The VTK file comes first because it needs no gnuplot, which may be missing.
    results::write_output(path(kVtu), TextKind::kXml, freefem_axi::write_vtu(picture), provenance);
    results::write_output(path(kMesh), TextKind::kSvg, report::plot_mesh(picture, tabulation, stop),
                          provenance);
    results::write_output(path(kFlow), TextKind::kSvg,
                          approaches ? report::plot_flow(picture, tabulation, stop)
                                     : report::plot_motion(picture, tabulation, false, stop),
                          provenance);
    results::write_output(path(kFilm), TextKind::kSvg,
                          approaches ? report::plot_gap_flow(picture, tabulation, stop)
                                     : report::plot_motion(picture, tabulation, true, stop),
                          provenance);
    terminal::clear_progress();
    terminal::say("tabulate: {}/gap_{:.7g}_{{mesh,flow,film}}.svg, .vtu", folder.string(), gap);
  }
}

}  // namespace viscontact::pipeline
