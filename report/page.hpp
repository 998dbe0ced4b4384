// Writes report.html with plots that can be zoomed in a browser, and for each plot a still picture
// plots/NAME.svg, for browsers without scripts and for printing. The reports of report/, rolling/
// and swimmer/ use all of this file, the page of particles/picture only the functions for pieces of
// HTML. Numbers in plots have no units here; the labels of axes name the units. Only link_to() and
// the class Report throw. report/page/*.js read the plots as JSON, so a change of the JSON must be
// made there, too.
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

/// The shape of the marked points of a curve; a disc is a filled circle.
enum class PointKind { kNone, kCircle, kDisc, kSquare, kCross };

/// How a curve is drawn.
struct CurveStyle {
  std::string colour{};        ///< "#rrggbb"
  double width = 2;            ///< width of the line [pixels], >= 0; 0: points only
  std::vector<double> dash{};  ///< lengths of dashes and spaces in turn [pixels]; empty: solid
  PointKind point = PointKind::kNone;  ///< kNone: the line only
  double point_size = 1;               ///< size of a point in units of about 7 pixels, > 0
};

/// A curve of points (x, y).
struct PlotCurve {
  /// Words in the legend. A curve without words belongs to the entry of the previous curve.
  std::string legend{};
  CurveStyle style{};  ///< how it is drawn
  /// In the order of x, which must not decrease (not checked); a y that is not finite interrupts
  /// the line. May be empty.
  std::vector<std::pair<double, double>> points{};
};

/// An axis of a plot.
struct PlotAxis {
  std::string label{};                  ///< what it shows, with the unit
  bool logarithmic = false;             ///< true: values <= 0 are not drawn
  std::optional<double> low{}, high{};  ///< ends before zooming; nothing: those of the curves
};

/// Where the legend of the still picture is.
enum class KeyPlace { kBelow, kTopRight, kBottomRight };

/// Curves on common axes.
struct PlotPanel {
  std::string title{};              ///< above the panel
  PlotAxis x{}, y{};                ///< its axes
  std::vector<PlotCurve> curves{};  ///< in the order of the legend
  KeyPlace key = KeyPlace::kBelow;  ///< in the still picture
  std::vector<std::string> rows{};  ///< names of y = 1, 2, ..., if y counts rows; else empty
};

/// A plot: panels one below the other.
struct Plot {
  std::string name{};               ///< NAME of the file plots/NAME.svg, without the ending
  int height = 440;                 ///< height of the still picture [pixels], > 0
  std::vector<PlotPanel> panels{};  ///< from the top; empty: a picture that cannot be zoomed
};

/// The text with the characters &, <, > and " escaped for HTML, and U+FFFD for control characters.
std::string escaped(std::string_view text);

/// A section with a heading, both HTML; empty if `body` is empty.
std::string section(std::string_view heading, const std::string& body);

/// A link from the report to the file `file` of a run, a path relative to the run's folder. `words`
/// is the text of the link, by default `file`. If there is no such file, the text without a link.
/// Throws std::filesystem::filesystem_error if the system cannot tell.
std::string link_to(const results::RunFolder& run, const std::string& file,
                    std::string_view words = {});

/// A row "<tr><td>a</td><td>b</td></tr>" of cells that are HTML.
template <class... Cells>
std::string table_row(const Cells&... cells) {
  std::string row = "<tr>";
  ((row.append("<td>").append(cells).append("</td>")), ...);
  return row + "</tr>\n";
}

/// A row of headings "<tr><th>a</th><th>b</th></tr>" of cells that are HTML.
std::string headings(std::initializer_list<std::string_view> cells);

/// A table that can be scrolled if it is wider than the page. `rows` and `head` are rows of HTML.
/// If `head` is empty, `rows` may begin with rows of headings.
std::string table_of(const std::string& rows, const std::string& head = {});

/// A line "From WORDS." (HTML) below a table or text, which says from which files its numbers are.
std::string source(const std::string& words);

/// Items of HTML as a box with warnings; empty if there are none.
std::string warnings_box(const std::vector<std::string>& items);

/// The beginning of a page, up to the end of its style: the title (plain text), `style` (CSS),
/// `more` elements of the head, and a policy by which the browser loads nothing from elsewhere.
/// `has_images` allows images that are contained in the page.
std::string page_head(std::string_view title, std::string_view style, bool has_images,
                      std::string_view more = {});

/// True if the report in the folder of a run and its pictures, those of `names`, exist and the
/// inputs of the report have not changed since. False if there are no still pictures, because
/// gnuplot may have been installed since, and if the report or another file cannot be read.
bool page_is_current(const std::filesystem::path& folder, std::span<const std::string_view> names);

/// A report while it is made: first its figures, then its page.
class Report {
 public:
  /// `folder` is that of the run. `names` are the names of all pictures that a report of this kind
  /// can have; only these files in plots/ are replaced or removed. They must outlive this object.
  /// Throws Error(kBadInput) if the report or one of these pictures would replace or delete a file
  /// that Viscontact did not write, that is of another kind, or that cannot be read.
  Report(std::filesystem::path folder, std::span<const std::string_view> names);

  /// Draws the still pictures of these plots at the same time, each in a process of gnuplot,
  /// because most of the time of such a process is its start. If gnuplot is missing or fails, no
  /// plot has a still picture (see write()). Throws Error(kInterrupted) if `stop` requests a stop.
  void draw(std::vector<Plot> plots, const StopToken& stop);

  /// False if gnuplot was missing or failed in draw().
  bool is_drawn() const { return failure_ == nullptr; }

  /// Adds the SVG of a picture that cannot be zoomed, under a name of the constructor's `names`
  /// (not checked).
  void add_picture(const std::string& name, std::string svg) {
    figures_.push_back({{.name = name}, std::move(svg)});
  }

  /// The HTML of the figures with these names, as far as they exist; without names, of all figures.
  std::string figures(std::initializer_list<std::string_view> names = {}) const;

  /// Writes the pictures and report.html, and removes pictures of an earlier report that this one
  /// does not have. `title` is plain text; `opening` and `sections` are HTML above and below the
  /// hints for the use of the figures. Warns if gnuplot was missing. Throws Error(kBadInput) if a
  /// file cannot be written, Error(kWrongUsage) if the variable SOURCE_DATE_EPOCH is no time, and
  /// Error(kExternalProgram), after all is written, if gnuplot failed in draw().
  void write(std::string_view title, const std::string& opening, const std::string& sections,
             const results::Provenance& provenance) const;

 private:
  /// A plot and its still picture. A plot without panels cannot be zoomed.
  struct Figure {
    Plot plot;
    std::string svg;  ///< empty: gnuplot did not draw it
  };
  static std::string html_of(const Figure& figure);
  std::string hints() const;

  results::RunFolder run_;
  std::span<const std::string_view> names_;
  std::vector<Figure> figures_;
  std::exception_ptr failure_;
};

}  // namespace viscontact::report
