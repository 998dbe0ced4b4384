// Plots as JSON for the scripts in report/page, and as SVG. Texts of users pass through escaped().
#include "viscontact/report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <future>
#include <nlohmann/json.hpp>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/on_one_line.hpp"
#include "viscontact/report/pictures/gnuplot.hpp"
#include "viscontact/report/pictures/pdf.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::report {

// The files in report/page; CMakeLists.txt makes these functions, so that a page needs no other
// file.
std::string_view uplot_script();
std::string_view uplot_style();
std::string_view uplot_licence();
std::string_view report_script();
std::string_view report_style();

namespace {

/// The text with each % doubled, because gnuplot reads the label of a tick as a format.
std::string doubled_percent(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '%' ? std::string("%%") : std::string(1, c);
  return result;
}

constexpr int kWidth = 860;  // of still pictures [pixels]

/// The tag before a still picture, by which page_is_current() finds out whether a page has one.
constexpr std::string_view kStill = "<div class=still>";

/// A kind of point in gnuplot (pointtype) and page/axes.js. The rows are in the order of PointKind.
struct PointName {
  PointKind kind;
  int gnuplot;
  const char* page;
};
constexpr auto kPointNames = std::to_array<PointName>({{PointKind::kNone, 0, ""},
                                                       {PointKind::kCircle, 6, "circle"},
                                                       {PointKind::kDisc, 7, "disc"},
                                                       {PointKind::kSquare, 4, "square"},
                                                       {PointKind::kCross, 2, "cross"}});

const PointName& name_of(PointKind kind) { return kPointNames[static_cast<std::size_t>(kind)]; }

std::string gnuplot_style(const CurveStyle& style) {
  const bool points = style.point != PointKind::kNone;
  std::string text = style.width == 0 ? "points" : points ? "linespoints" : "lines";
  text += fmt::format(" linecolor rgb '{}' linewidth {}", style.colour,
                      style.width == 0 ? 1.5 : style.width);
  if (points)
    text +=
        fmt::format(" pointtype {} pointsize {}", name_of(style.point).gnuplot, style.point_size);
  if (!style.dash.empty()) text += fmt::format(" dashtype ({})", fmt::join(style.dash, ","));
  return text;
}

/// "*" lets gnuplot choose.
std::string bound(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "*";
}

/// gnuplot's commands for the ranges, legend and tics of a panel.
std::vector<std::string> gnuplot_settings(const PlotPanel& panel) {
  std::vector<std::string> settings = {
      fmt::format("set xrange [{}:{}]", bound(panel.x.low), bound(panel.x.high)),
      fmt::format("set yrange [{}:{}]", bound(panel.y.low), bound(panel.y.high)),
      panel.key == KeyPlace::kTopRight      ? "set key top right"
      : panel.key == KeyPlace::kBottomRight ? "set key bottom right"
                                            : kLegendBelow};
  if (panel.x.logarithmic) settings.emplace_back("set format x '1e%T'");
  if (panel.y.logarithmic) settings.emplace_back("set format y '1e%T'");
  if (!panel.rows.empty()) {
    std::string ticks;
    for (std::size_t i = 0; i < panel.rows.size(); ++i)
      ticks += fmt::format("{}{} {}", i == 0 ? "" : ", ",
                           quoted_for_gnuplot(doubled_percent(panel.rows[i])), i + 1);
    // A margin for names of 38 characters. The longest name of a model with one suffix,
    // viscous_contact_regular_drag_brenner, has 36.
    settings.push_back("set ytics (" + ticks + ")\nset lmargin 38");
  }
  return settings;
}

/// The number with eight digits, as more could not be seen in a plot; null if it is not finite.
nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(std::stod(fmt::format("{:.8g}", value)))
                              : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json optional_number(const std::optional<double>& value) {
  return value ? number(*value) : nlohmann::ordered_json(nullptr);
}

/// The scripts in report/page read the JSON. An end that the axis does not set is null.
nlohmann::ordered_json json_of(const PlotAxis& axis) {
  return {{"label", axis.label},
          {"logarithmic", axis.logarithmic},
          {"low", optional_number(axis.low)},
          {"high", optional_number(axis.high)}};
}

nlohmann::ordered_json json_of(const PlotCurve& curve) {
  assert(std::ranges::is_sorted(curve.points, {}, &std::pair<double, double>::first));
  auto x = nlohmann::ordered_json::array(), y = nlohmann::ordered_json::array();
  for (const auto& point : curve.points) {
    x.push_back(number(point.first));
    y.push_back(number(point.second));
  }
  return {{"legend", curve.legend},
          {"colour", curve.style.colour},
          {"width", curve.style.width},
          {"dash", curve.style.dash},
          {"point", name_of(curve.style.point).page},
          {"pointSize", curve.style.point_size},
          {"x", std::move(x)},
          {"y", std::move(y)}};
}

/// gnuplot draws it; its errors are those of draw_svg().
std::string svg_of(const Plot& plot, const StopToken& stop) {
  std::vector<Panel> panels;
  for (const auto& panel : plot.panels) {
    panels.push_back({panel.title,
                      panel.x.label,
                      panel.y.label,
                      panel.x.logarithmic,
                      panel.y.logarithmic,
                      gnuplot_settings(panel),
                      {}});
    for (const auto& curve : panel.curves)
      panels.back().curves.push_back({curve.legend, gnuplot_style(curve.style), curve.points});
  }
  return draw_svg(panels, kWidth, plot.height, stop);
}

/// The plot as JSON for report/page/panels.js, in a form that can stand in a script element.
std::string json_of(const Plot& plot) {
  auto panels = nlohmann::ordered_json::array();
  for (const auto& panel : plot.panels) {
    panels.push_back({{"title", panel.title},
                      {"x", json_of(panel.x)},
                      {"y", json_of(panel.y)},
                      {"rows", panel.rows},
                      {"curves", nlohmann::ordered_json::array()}});
    for (const auto& curve : panel.curves) panels.back()["curves"].push_back(json_of(curve));
  }
  std::string text =
      nlohmann::ordered_json{{"name", plot.name}, {"panels", std::move(panels)}}.dump(
          -1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  // "</script>" in a title would end the script element, and "<!--" would begin a comment.
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos; ++at)
    text.replace(at, 1, "\\u003c");
  return text;
}
/// The path of a file, relative to the page, as an address (RFC 3986).
std::string as_url(const std::string& file) {
  std::string url;
  for (const char c : file) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("-._~/").find(c) != std::string_view::npos;
    url += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return url;
}

void warn_of_missing_pictures(const std::exception_ptr& failure) {
  constexpr const char* kWritten =
      "the report is written, without still pictures and without the files in plots/";
  try {
    std::rethrow_exception(failure);
  } catch (const GnuplotMissing& missing) {
    terminal::warn("report: warning: {}; {}", on_one_line(missing.what()), kWritten);
  } catch (const Error& error) {
    throw Error(error.kind(), on_one_line(error.what()) + "; " + kWritten, error.at());
  }
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (static_cast<unsigned char>(c) < ' ' && c != '\n' && c != '\t')
      result += "\uFFFD";  // XML allows no control characters, not even escaped ones
    else
      result += c;
  }
  return result;
}

std::string section(std::string_view heading, const std::string& body) {
  return body.empty() ? "" : fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", heading, body);
}

std::string link_to(const results::RunFolder& run, const std::string& file,
                    std::string_view words) {
  const std::string text = escaped(words.empty() ? file : words);
  return std::filesystem::exists(run.path / file)
             ? fmt::format("<a href=\"{}\">{}</a>", escaped(as_url(file)), text)
             : text;
}

std::string headings(std::initializer_list<std::string_view> cells) {
  return fmt::format("<tr><th>{}</th></tr>", fmt::join(cells, "</th><th>"));
}

std::string table_of(const std::string& rows, const std::string& head) {
  if (head.empty()) return "<div class=scroll><table>\n" + rows + "</table></div>\n";
  return fmt::format(
      "<div class=scroll><table><thead>{}</thead><tbody>\n{}</tbody></table></div>\n", head, rows);
}

std::string source(const std::string& words) { return "<p class=source>From " + words + ".</p>\n"; }

std::string warnings_box(const std::vector<std::string>& items) {
  if (items.empty()) return "";
  return fmt::format(
      "<section class=warnings>\n<h2>Warnings</h2>\n<ul>\n<li>{}</li>\n</ul></section>\n",
      fmt::join(items, "</li>\n<li>"));
}

std::string page_head(std::string_view title, std::string_view style, bool has_images,
                      std::string_view more) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8>\n"
      "<meta name=viewport content=\"width=device-width,initial-scale=1\">\n"
      "<meta http-equiv=Content-Security-Policy content=\"default-src 'none'; style-src "
      "'unsafe-inline'; script-src 'unsafe-inline'{}\">\n{}<title>{}</title>\n<style>\n{}</style>",
      has_images ? "; img-src data:" : "", more, escaped(title), style);
}

bool page_is_current(const std::filesystem::path& folder, std::span<const std::string_view> names) {
  const results::RunFolder run{folder};
  try {
    if (!std::filesystem::exists(run.report())) return false;
    const auto page = read_file(run.report());
    if (page.find(fmt::format("{}<svg", kStill)) == std::string::npos) return false;
    const auto provenance = results::provenance_in(page, run.report().string());
    if (!provenance) return false;
    // An input without a hash was a pipe, and is skipped, because its content is in the copy of the
    // case.
    for (const auto& input : provenance->inputs)
      if (!input.sha256.empty() && !results::change_of(input, provenance->folder).empty())
        return false;
    return std::ranges::all_of(names, [&](std::string_view name) {
      return page.find(fmt::format("\"plots/{}.svg\"", name)) == std::string::npos ||
             std::filesystem::exists(run.plot(std::string(name)));
    });
  } catch (const Error&) {
    return false;
  }
}

Report::Report(std::filesystem::path folder, std::span<const std::string_view> names)
    : run_{std::move(folder)}, names_(names) {
  results::refuse_other_kind(run_.report(), "id=\"provenance\"", "report");
  for (const auto name : names_)
    results::refuse_other_kind(run_.plot(std::string(name)), "<svg", "picture");
}

void Report::draw(std::vector<Plot> plots, const StopToken& stop) {
  std::vector<std::future<std::string>> drawings;
  for (const auto& plot : plots)
    drawings.push_back(
        std::async(std::launch::async, [&plot, &stop] { return svg_of(plot, stop); }));
  std::vector<std::string> drawn;
  try {
    for (auto& drawing : drawings) drawn.push_back(drawing.get());
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kExternalProgram) throw;
    failure_ = std::current_exception();
    drawn.assign(plots.size(), "");
  }
  for (auto& drawing : drawings)
    if (drawing.valid()) drawing.wait();  // the drawing refers to its plot, which is moved below
  for (std::size_t i = 0; i < plots.size(); ++i)
    figures_.push_back({std::move(plots[i]), std::move(drawn[i])});
}

std::string Report::html_of(const Figure& figure) {
  const auto& [plot, svg] = figure;
  const std::string caption =
      svg.empty()
          ? ""
          : fmt::format("<figcaption><a href=\"plots/{0}.svg\">plots/{0}.svg</a></figcaption>",
                        plot.name);
  if (plot.panels.empty()) return fmt::format("<figure>{}{}</figure>\n", svg, caption);
  return fmt::format(
      "<figure data-plot=\"{}\">\n{}{}</div>\n"
      "<script type=\"application/json\">{}</script>\n{}</figure>\n",
      plot.name, kStill, svg, json_of(plot), caption);
}

std::string Report::figures(std::initializer_list<std::string_view> names) const {
  std::string text;
  if (names.size() == 0)
    for (const auto& figure : figures_) text += html_of(figure);
  for (const auto name : names)
    for (const auto& figure : figures_)
      if (figure.plot.name == name) text += html_of(figure);
  return text;
}

std::string Report::hints() const {
  std::string text =
      "<p class=hint>Drag in a plot to zoom; double-click or tap twice to see the whole plot "
      "again. The values at the pointer are shown beside the legend.</p>\n";
  if (!is_drawn())
    text +=
        "<p class=fine>gnuplot was missing or failed when this page was made. The page therefore "
        "has no still pictures, and prints and browsers without JavaScript show no plots. Install "
        "gnuplot (<code>apt-get install gnuplot-nox</code>) and make the report again.</p>\n";
  return text;
}

void Report::write(std::string_view title, const std::string& opening, const std::string& sections,
                   const results::Provenance& provenance) const {
  const auto page =
      page_head(title, fmt::format("{}{}", uplot_style(), report_style()), true) +
      fmt::format(
          "</head>\n<body>\n<h1>{}</h1>\n{}{}{}"
          "<footer>Made by Viscontact {}. Plots on this page by uPlot.</footer>\n"
          "<!-- uPlot:\n{} -->\n<script>\n{}</script>\n<script>\n{}</script>\n</body></html>\n",
          escaped(title), opening, hints(), sections, VISCONTACT_VERSION, uplot_licence(),
          uplot_script(), report_script());
  for (const auto& [plot, svg] : figures_)
    if (!svg.empty()) results::write_output(run_.plot(plot.name), TextKind::kSvg, svg, provenance);
  for (const auto name : names_) remove_pdf_of(run_.plot(std::string(name)));
  results::write_output(run_.report(), TextKind::kHtml, page, provenance);
  for (const auto name : names_)
    if (std::ranges::none_of(figures_, [&](const Figure& figure) {
          return figure.plot.name == name && !figure.svg.empty();
        }))
      remove_file(run_.plot(std::string(name)));
  terminal::say("report: {}", run_.report().string());
  if (failure_) warn_of_missing_pictures(failure_);
}

}  // namespace viscontact::report
