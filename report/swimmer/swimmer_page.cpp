// Writes the page of a swimmer (swimmer_page.hpp). kPictureNames must contain the name of every
// picture, because it decides which files in plots/ may be replaced or removed.
#include "viscontact/report/swimmer/swimmer_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <string>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/report/html/figures.hpp"
#include "viscontact/report/html/html.hpp"
#include "viscontact/report/swimmer/swimmer_plots.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::report {
namespace {

constexpr auto kPictureNames = std::to_array<std::string_view>(
    {"loops", "position", "power", "arms", "forces", "convergence"});

std::string table(const std::string& rows) {
  return "<div class=scroll><table>\n" + rows + "</table></div>\n";
}

std::string number(double value) { return fmt::format("{:.7g}", value); }

std::string with_error(double value, double error) {
  return fmt::format("{:.9g} &plusmn; {:.1g}", value, error);
}

/// The sums of all strokes, one column each.
std::string strokes_table(const SwimmerResults& results) {
  std::vector<const StrokeResult*> strokes;
  std::string head = "<tr><th></th>";
  if (results.stroke) strokes.push_back(&*results.stroke), head += "<th>stroke</th>";
  if (results.optimal) strokes.push_back(&*results.optimal), head += "<th>optimal stroke</th>";
  const auto row = [&](const std::string& name, const auto& value) {
    std::string cells = "<tr><td>" + name + "</td>";
    for (const auto* stroke : strokes) cells += "<td>" + value(*stroke) + "</td>";
    return cells + "</tr>\n";
  };
  return table(
      head + "</tr>\n" +
      row("displacement in a period [L]",
          [](const StrokeResult& s) {
            return with_error(s.sums.displacement, s.errors.displacement);
          }) +
      row("energy of a period [M L<sup>2</sup>/T<sup>2</sup>]",
          [](const StrokeResult& s) { return with_error(s.sums.energy, s.errors.energy); }) +
      row("the same at constant power",
          [](const StrokeResult& s) { return number(s.sums.energy_at_constant_power); }) +
      row("Lighthill's efficiency",
          [](const StrokeResult& s) { return number(s.sums.efficiency); }) +
      row("period [T]", [](const StrokeResult& s) { return number(s.period); }));
}

std::string search_words(const SwimmerResults& results) {
  if (!results.search) return "";
  const auto& last = results.search->convergence.back();
  const auto& steps = results.search->convergence;
  return fmt::format(
      "<p>The optimal stroke has the least energy of all loops through its first shape with this "
      "displacement. It is found with {} polynomials for each arm{}. The residual of Euler and "
      "Lagrange's equation is {:.2g}.</p>\n",
      last.polynomials,
      steps.size() < 2 ? ""
                       : fmt::format("; with {} its energy is larger by the fraction {:.1g}",
                                     steps[steps.size() - 2].polynomials,
                                     steps[steps.size() - 2].energy / last.energy - 1),
      last.euler_lagrange_residual);
}

std::string fit_table_of(const SwimmerResults& results) {
  const auto& fit = results.fit;
  double estimate = 0;
  for (const auto& row : results.table.rows)
    estimate = std::max(estimate, row.largest_error_estimate());
  return table(
      table_row("rows of the table", std::to_string(results.table.rows.size())) +
      table_row("largest error estimate of an entry, relative", fmt::format("{:.2g}", estimate)) +
      table_row("terms of lubrication taken out", std::to_string(fit.lubrication_terms)) +
      table_row("largest residual of the fit, relative",
                fmt::format("{:.2g}", fit.largest_relative_residual)) +
      table_row("error of a row predicted from the others, relative: largest",
                fmt::format("{:.2g}", fit.largest_left_one_out_error)) +
      table_row("the same, root mean square", fmt::format("{:.2g}", fit.rms_left_one_out_error)));
}

std::string parameters_of(const SwimmerResults& results) {
  const auto& spheres = results.c.spheres;
  std::string radii;
  for (const double radius : spheres.radii)
    radii += (radii.empty() ? "" : ", ") + fmt::format("{:g}", radius);
  std::string rows =
      table_row("viscosity [M/(L T)]", fmt::format("{:g}", spheres.viscosity)) +
      table_row("radii [L]", radii) +
      table_row("surroundings", escaped(freefem_axi::surroundings_in_words(spheres)));
  for (std::size_t k = 0; k < results.c.gaps.size(); ++k) {
    const double both_radii = spheres.radii[k] + spheres.radii[k + 1];
    rows += table_row(
        fmt::format("arm x{} of the table [L]", k + 1),
        fmt::format("{} values from {:g} to {:g}", results.c.gaps[k].size(),
                    results.c.gaps[k].front() + both_radii, results.c.gaps[k].back() + both_radii));
  }
  return table(rows);
}

std::string figures_of(const std::vector<Picture>& pictures,
                       std::initializer_list<std::string_view> names) {
  std::string text;
  for (const auto name : names)
    for (const auto& picture : pictures)
      if (picture.plot.name == name) text += figure(picture);
  return text;
}

std::string files_words(const SwimmerResults& results) {
  std::string text =
      "<p>Files of this folder: <a href=\"table.csv\">table.csv</a>, <a "
      "href=\"fit.json\">fit.json</a>, <a href=\"swimmer.json\">swimmer.json</a>";
  if (results.stroke) text += ", <a href=\"stroke.csv\">stroke.csv</a>";
  if (results.optimal) text += ", <a href=\"optimal_stroke.csv\">optimal_stroke.csv</a>";
  return text + ".</p>\n";
}

std::string page_of(const SwimmerResults& results, const std::vector<Picture>& pictures,
                    const std::string& loops) {
  const auto title = results.c.title.empty() ? std::string("Swimmer") : results.c.title;
  std::string page = page_head(title);
  page += fmt::format(
      "<p class=summary>A swimmer of {} spheres on a line in a fluid without inertia</p>\n",
      results.c.spheres.radii.size());
  page += hints_about(pictures);
  const bool has_strokes = results.stroke || results.optimal;
  page += section("Strokes", has_strokes ? strokes_table(results) + search_words(results) : "");
  if (!loops.empty())
    page +=
        section("Loops in the plane of the arms",
                "<p>The displacement of a stroke is the integral of the coloured quantity over "
                "the area in its loop, positive for loops run counter-clockwise.</p>\n<figure>" +
                    loops +
                    "<figcaption><a href=\"plots/loops.svg\">plots/loops.svg</a></figcaption>"
                    "</figure>\n");
  page += section("Displacement and power", figures_of(pictures, {"position", "power"}));
  page += section("Arms and forces", figures_of(pictures, {"arms", "forces"}));
  page += section("How the optimal stroke converges", figures_of(pictures, {"convergence"}));
  page += section("Resistance matrices and their fit", fit_table_of(results));
  page += section("Parameters", parameters_of(results) + files_words(results));
  return page + page_foot();
}

}  // namespace

void check_swimmer_report(const std::filesystem::path& folder) {
  const results::RunFolder run{folder};
  results::refuse_other_kind(run.report(), "id=\"provenance\"", "report");
  for (const auto name : kPictureNames)
    results::refuse_other_kind(run.plot(std::string(name)), "<svg", "picture");
}

void write_swimmer_report(const SwimmerResults& results, const std::filesystem::path& folder,
                          const results::Provenance& provenance, const StopToken& stop) {
  const results::RunFolder run{folder};
  std::exception_ptr failure;
  auto pictures = draw_pictures(swimmer_plots(results), failure, stop);
  std::string loops;
  if (!failure && results.c.gaps.size() == 2) loops = draw_loops(results, stop);
  const auto page = page_of(results, pictures, loops);
  std::erase_if(pictures, [](const Picture& picture) { return picture.svg.empty(); });
  for (const auto& [plot, svg] : pictures)
    results::write_output(run.plot(plot.name), TextKind::kSvg, svg, provenance);
  if (!loops.empty()) results::write_output(run.plot("loops"), TextKind::kSvg, loops, provenance);
  results::write_output(run.report(), TextKind::kHtml, page, provenance);
  // Pictures of an earlier report that this report does not have are removed.
  for (const auto name : kPictureNames)
    if (!(name == "loops" && !loops.empty()) &&
        std::ranges::find(pictures, name, [](const Picture& p) { return p.plot.name; }) ==
            pictures.end())
      remove_file(run.plot(std::string(name)));
  terminal::say(fmt::format("report: {}", run.report().string()));
  if (failure) warn_of_missing_pictures(failure);
}

}  // namespace viscontact::report
