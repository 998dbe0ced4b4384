// report.html with plots that can be zoomed in a browser, and for each plot a still picture
// plots/NAME.svg, for browsers without scripts and for printing.
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

struct CurveStyle {
  std::string colour{};  ///< "#rrggbb"
  double width = 2;      ///< of the line [pixels], >= 0; 0: points only
  /// Lengths of dashes and spaces in turn [pixels], an even number of them; empty: a solid line.
  std::vector<double> dash{};
  PointKind point = PointKind::kNone;  ///< kNone: the line only
  double point_size = 1;               ///< in units of about 7 pixels, > 0
};

struct PlotCurve {
  /// Words in the legend. A curve without words belongs to the entry of the previous curve.
  std::string legend{};
  CurveStyle style{};
  /// The points in the order of x, which must not decrease. A y that is not finite interrupts the
  /// line.
  std::vector<std::pair<double, double>> points{};
};

struct PlotAxis {
  std::string label{};                  ///< the name of the quantity, with its unit
  bool logarithmic = false;             ///< values <= 0 are not drawn
  std::optional<double> low{}, high{};  ///< ends before zooming; nothing: those of the curves
};

/// Place of the legend in a still picture: below the panel, or in a corner of it.
enum class KeyPlace { kBelow, kTopRight, kBottomRight };

/// Curves on common axes.
struct PlotPanel {
  std::string title{};  ///< above the panel
  PlotAxis x{}, y{};
  std::vector<PlotCurve> curves{};  ///< in the order of the legend
  KeyPlace key = KeyPlace::kBelow;
  /// Names of the rows y = 1, 2, ... of a panel that shows a point for each name; otherwise empty.
  std::vector<std::string> rows{};
};

/// A plot has panels one below the other.
struct Plot {
  std::string name{};               ///< NAME of the file plots/NAME.svg
  int height = 440;                 ///< of the still picture [pixels], > 0
  std::vector<PlotPanel> panels{};  ///< from the top; empty: the plot is a still picture only
};

/// The text with the characters &, <, > and " escaped for HTML. U+FFFD replaces each control
/// character except line breaks and tabs.
std::string escaped(std::string_view text);

/// A section with this heading (HTML) above `body` (HTML); empty if `body` is empty.
std::string section(std::string_view heading, const std::string& body);

/// A link from the report to the file `file` of a run, a path relative to the run's folder. `words`
/// is the text of the link (plain text), by default `file`. If there is no such file, the result is
/// the text without a link. Throws std::filesystem::filesystem_error if the system cannot tell.
std::string link_to(const results::RunFolder& run, const std::string& file,
                    std::string_view words = {});

/// A row "<tr><td>a</td><td>b</td></tr>" of cells that are HTML.
template <class... Cells>
std::string table_row(const Cells&... cells) {
  std::string row = "<tr>";
  ((row.append("<td>").append(cells).append("</td>")), ...);
  return row + "</tr>\n";
}

/// A row "<tr><th>a</th><th>b</th></tr>" of cells that are HTML.
std::string headings(std::initializer_list<std::string_view> cells);

/// A table that can be scrolled if it is wider than the page. `rows` and `head` are rows of HTML.
/// If `head` is empty, `rows` may begin with rows of headings.
std::string table_of(const std::string& rows, const std::string& head = {});

/// The line "From WORDS.", where `words` is HTML. It stands below a table or text and names the
/// files that the numbers above it come from.
std::string source(const std::string& words);

/// Items of HTML as a box with warnings; empty if there are none.
std::string warnings_box(const std::vector<std::string>& items);

/// The beginning of a page, up to the end of its <style> element: a policy by which the browser
/// loads nothing from elsewhere, the elements `more` of the head (HTML), the title (plain text) and
/// `style` (CSS). If `has_images` is true, the policy allows images that the page contains itself.
/// The caller must close the head.
std::string page_head(std::string_view title, std::string_view style, bool has_images,
                      std::string_view more = {});

/// True if the folder of a run has a report and those of the pictures `names` that the report
/// contains, and if the inputs of the report have not changed since it was made. False if there are
/// no still pictures, because gnuplot may have been installed since, and if the report or another
/// file cannot be read.
bool page_is_current(const std::filesystem::path& folder, std::span<const std::string_view> names);

/// A report that is being made: draw() and add_picture() make its figures, then write() its page.
class Report {
 public:
  /// `folder` is that of the run. `names` are the names of all pictures that a report of this kind
  /// can have; only these files in plots/ are replaced or removed. They must outlive this object.
  /// Throws Error(kBadInput) if the report or one of these pictures would replace or delete a file
  /// that Viscontact did not write, that is of another kind, or that cannot be read.
  Report(std::filesystem::path folder, std::span<const std::string_view> names);

  /// Draws the still pictures of these plots at the same time, each in a process of gnuplot,
  /// because most of the time of such a process is its start. If gnuplot is missing or fails for
  /// one of them, none of these plots gets a still picture. Throws Error(kInterrupted) if `stop`
  /// requests a stop.
  void draw(std::vector<Plot> plots, const StopToken& stop);

  bool is_drawn() const { return failure_ == nullptr; }

  /// Adds the SVG of a picture that cannot be zoomed, under a name of the constructor's `names`.
  void add_picture(const std::string& name, std::string svg) {
    figures_.push_back({{.name = name}, std::move(svg)});
  }

  /// The HTML of the figures with these names, in this order; names without a figure are skipped.
  /// Without names, that of all figures in the order in which they were added.
  std::string figures(std::initializer_list<std::string_view> names = {}) const;

  /// Writes the pictures and report.html, and removes pictures of an earlier report that this one
  /// does not have. `title` is plain text; `opening` and `sections` are HTML above and below the
  /// hints for the use of the figures. Warns the user if gnuplot was missing in draw(). Throws
  /// Error(kBadInput) if a file cannot be written, Error(kWrongUsage) if the environment variable
  /// SOURCE_DATE_EPOCH is not a time, and Error(kExternalProgram), after all files are written, if
  /// gnuplot failed in draw().
  void write(std::string_view title, const std::string& opening, const std::string& sections,
             const results::Provenance& provenance) const;

 private:
  /// A plot and its still picture. A plot without panels cannot be zoomed.
  struct Figure {
    Plot plot;
    std::string svg;  ///< empty: gnuplot did not draw it
  };
  static std::string html_of(const Figure& figure);
  /// Hints for the use of the figures (HTML), and a note if the page has no still pictures.
  std::string hints() const;

  results::RunFolder run_;
  std::span<const std::string_view> names_;
  std::vector<Figure> figures_;
  std::exception_ptr failure_;
};

}  // namespace viscontact::report
