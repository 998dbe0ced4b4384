// The writer of all reports (one sphere, rolling, swimmer, particles): report.html, with plots that
// can be zoomed in a browser, and a still picture plots/NAME.svg of each, for browsers without
// scripts and for printing. Pieces of HTML that all pages share are here, too. Numbers in plots
// have no units here; the labels of the axes name the units. report/page/*.js read the plots as
// JSON; a change of the JSON must be made in both.
#pragma once

#include <exception>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/results/run_folder.hpp"

namespace viscontact::report {

/// The shape in which the points of a curve are drawn; a disc is a filled circle.
enum class PointKind { kNone, kCircle, kDisc, kSquare, kCross };

/// How a curve is drawn.
struct CurveStyle {
  std::string colour{};        ///< "#rrggbb"
  double width = 2;            ///< width of the line [pixels]; 0: points only
  std::vector<double> dash{};  ///< lengths of dashes and spaces in turn [pixels]; empty: solid
  PointKind point = PointKind::kNone;  ///< shape of the points; kNone: the line only
  double point_size = 1;               ///< in units of about 7 pixels, > 0
};

/// A curve of points (x, y).
struct PlotCurve {
  /// Words in the legend. A curve without words belongs to the entry of the curve before it.
  std::string legend{};
  CurveStyle style{};
  /// The values of x must not decrease; a non-finite y interrupts the line.
  std::vector<std::pair<double, double>> points{};
};

/// An axis of a plot.
struct PlotAxis {
  std::string label{};                  ///< what it shows, with the unit
  bool logarithmic = false;             ///< true: values <= 0 are not drawn
  std::optional<double> low{}, high{};  ///< range before zooming; nothing: that of the curves
};

/// Where the legend of the still picture is.
enum class KeyPlace { kBelow, kTopRight, kBottomRight };

/// Curves on common axes.
struct PlotPanel {
  std::string title{};              ///< above the panel
  PlotAxis x{}, y{};                ///< its axes
  std::vector<PlotCurve> curves{};  ///< in the order of the legend
  KeyPlace key = KeyPlace::kBelow;  ///< where the legend is
  std::vector<std::string> rows{};  ///< names of y = 1, 2, ... if y numbers rows from the bottom
};

/// Panels one below the other.
struct Plot {
  std::string name{};  ///< name of the file plots/NAME.svg
  int height = 440;    ///< height of the still picture [pixels]
  std::vector<PlotPanel> panels{};
};

/// The text with the special characters of HTML escaped.
std::string escaped(std::string_view text);

/// A section with a heading; empty if `body` is empty.
std::string section(std::string_view heading, const std::string& body);

/// A link from the report to a file of the run. `file` is relative to the run's folder; `words` is
/// the text of the link, by default the file's name. Without such a file it is no link.
std::string link_to(const results::RunFolder& run, const std::string& file,
                    std::string_view words = {});

/// A row "<tr><td>a</td><td>b</td></tr>"; the cells must be HTML already.
template <class... Cells>
std::string table_row(const Cells&... cells) {
  std::string row = "<tr>";
  ((row.append("<td>").append(cells).append("</td>")), ...);
  return row + "</tr>\n";
}

/// A row of headings "<tr><th>a</th><th>b</th></tr>", which must be HTML already.
std::string headings(std::initializer_list<std::string_view> cells);

/// A table with these rows, which can be scrolled if it is wider than the page. `head` has the rows
/// of headings; if it is empty, headings, if any, are in `rows`.
std::string table_of(const std::string& rows, const std::string& head = {});

/// A line of HTML below a table or text that says from which files the numbers above it are.
std::string source(const std::string& words);

/// Items of HTML as a box with warnings; empty if there are none.
std::string warnings_box(const std::vector<std::string>& items);

/// The beginning of any page, up to its body: the title, `style` (CSS), `more` elements of the
/// head, and a policy that forbids the browser to load anything from elsewhere, except images that
/// are in the page if `has_images`.
std::string page_head(std::string_view title, std::string_view style, bool has_images,
                      std::string_view more = {});

/// The report of a folder while it is made: its figures, and then its page.
class Report {
 public:
  /// `names` are the names of all pictures that a report of this kind can have, which decide which
  /// files in plots/ are replaced or removed. They must outlive this object. Throws
  /// Error(kBadInput) if the report or one of these pictures would replace or delete a file that
  /// Viscontact did not write.
  Report(std::filesystem::path folder, std::span<const std::string_view> names);

  /// Draws the still pictures of these plots at the same time, each in a process of gnuplot,
  /// because most of the time of such a process is its start. If one of them cannot be drawn, no
  /// figure has a still picture. Throws Error(kInterrupted) if `stop` requests a stop.
  void draw(std::vector<Plot> plots, const StopToken& stop);

  /// True if gnuplot drew all pictures.
  bool is_drawn() const { return failure_ == nullptr; }

  /// Adds a picture that cannot be zoomed.
  void add_picture(const std::string& name, std::string svg) {
    figures_.push_back({{.name = name}, std::move(svg)});
  }

  /// The figures with these names as HTML, as far as there are such figures; without names, all.
  std::string figures(std::initializer_list<std::string_view> names = {}) const;

  /// Writes the pictures and report.html, and removes pictures of an earlier report that this one
  /// does not have. `opening` is HTML above the hints how to use the figures, `sections` is HTML
  /// below them. If gnuplot is missing, a warning says so; throws Error(kExternalProgram) after the
  /// page is written if gnuplot failed.
  void write(std::string_view title, const std::string& opening, const std::string& sections,
             const results::Provenance& provenance) const;

 private:
  /// A plot and its still picture. A plot without panels is not in the page as data.
  struct Figure {
    Plot plot;
    std::string svg;  ///< empty if gnuplot did not draw it
  };
  static std::string html_of(const Figure& figure);
  std::string hints() const;

  results::RunFolder run_;
  std::span<const std::string_view> names_;
  std::vector<Figure> figures_;
  std::exception_ptr failure_;
};

/// report.html contains this text if, and only if, it has still pictures.
inline constexpr std::string_view kStillPicture = "<div class=still><svg";

}  // namespace viscontact::report
