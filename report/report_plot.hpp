// A plot of the report as data, from which both its picture and its zoomable twin on the page are made.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace viscontact {

enum class PointKind { kNone, kCircle, kDisc, kSquare, kCross };

struct CurveStyle {
  std::string colour{};        ///< "#rrggbb"
  double width = 2;            ///< of the line [pixels]; 0: points only
  std::vector<double> dash{};  ///< lengths of strokes and holes in turn [pixels]; empty: solid
  PointKind point = PointKind::kNone;
  double point_size = 1;  ///< 1: about 7 pixels
};

struct PlotCurve {
  std::string legend{};  ///< in words; empty: goes with the curve before it
  CurveStyle style{};
  std::vector<std::pair<double, double>>
      points{};  ///< x never falls; a non-finite y interrupts the line
};

struct PlotAxis {
  std::string label{};
  bool logarithmic = false;
  std::optional<double> low{}, high{};  ///< what is shown at first; nothing: what the curves need
};

enum class KeyPlace { kBelow, kTopRight, kBottomRight };

struct PlotPanel {
  std::string title{};
  PlotAxis x{}, y{};
  std::vector<PlotCurve> curves{};
  KeyPlace key = KeyPlace::kBelow;
  std::vector<std::string> rows{};  ///< if y counts rows: the names of 1, 2, ... from the bottom
};

/// Panels one below the other.
struct Plot {
  std::string name{};  ///< of its file, plots/NAME.svg
  int height = 440;    ///< of the picture [pixels]
  std::vector<PlotPanel> panels{};
};

/// False if no panel has a curve.
bool shows_something(const Plot& plot);

/// As an SVG element by gnuplot. Throws Error(kExternalProgram) as draw_svg.
std::string svg_of(const Plot& plot);

/// As JSON for report/page/report.js, fit to stand in a script element.
std::string json_of(const Plot& plot);

}  // namespace viscontact
