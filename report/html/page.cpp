// Draws figures and writes the page around them (page.hpp). report/page/panels.js reads the data of
// the figures. Every text of the user must pass through escaped(), because it could contain markup.
#include "viscontact/report/html/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/on_one_line.hpp"
#include "viscontact/report/page_texts.hpp"
#include "viscontact/report/pictures/gnuplot.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::report {
namespace {

/// The name of a relative file as part of an address (RFC 3986).
std::string as_url(const std::string& file) {
  std::string url;
  for (const char c : file) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("-._~/").find(c) != std::string_view::npos;
    url += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return url;
}

/// Warns if gnuplot is missing; throws Error(kExternalProgram) if gnuplot failed.
void warn_of_missing_pictures(const std::exception_ptr& failure) {
  constexpr const char* kWritten =
      "the report is written, without still pictures and without the files in plots/";
  try {
    std::rethrow_exception(failure);
  } catch (const GnuplotMissing& missing) {
    terminal::warn(fmt::format("report: warning: {}; {}", on_one_line(missing.what()), kWritten));
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}; {}", on_one_line(error.what()), kWritten));
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
      result += "\uFFFD";  // XML does not allow control characters, not even escaped
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

std::string table_of(const std::string& rows) {
  return "<div class=scroll><table>\n" + rows + "</table></div>\n";
}

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
      "<figure data-plot=\"{}\">\n<div class=still>{}</div>\n"
      "<script type=\"application/json\">{}</script>\n{}</figure>\n",
      plot.name, svg, json_of(plot), caption);
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
      "again. "
      "The values at the pointer are shown beside the legend.</p>\n";
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
  results::write_output(run_.report(), TextKind::kHtml, page, provenance);
  for (const auto name : names_)
    if (std::ranges::none_of(figures_, [&](const Figure& figure) {
          return figure.plot.name == name && !figure.svg.empty();
        }))
      remove_file(run_.plot(std::string(name)));
  terminal::say(fmt::format("report: {}", run_.report().string()));
  if (failure_) warn_of_missing_pictures(failure_);
}

}  // namespace viscontact::report
