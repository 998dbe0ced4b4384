// Texts of the user must pass through quoted_for_gnuplot(), because gnuplot can run commands of the
// shell.
#include "viscontact/report/pictures/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>

#include "viscontact/common/system/process.hpp"

namespace viscontact::report {
namespace {

/// The block has one point in each line; an empty line interrupts the curve.
/// Free choices of a call.
struct GnuplotTuning {
  // A picture takes about one second. If gnuplot needs ten minutes, it hangs.
  static constexpr std::chrono::seconds kLongest = std::chrono::minutes(10);
  // gnuplot reads standard input byte by byte, but a file in blocks. If the script is longer
  // [bytes], blocks save more time than the process `cat` takes.
  static constexpr std::size_t kLong = 200'000;
  // Bytes of gnuplot's output in a message.
  static constexpr std::size_t kOutput = 300;
};

std::string data_block(const std::string& name, const Curve& curve) {
  std::string text = fmt::format("${} << END_OF_CURVE\n", name);
  for (const auto& [x, y] : curve.points)
    if (std::isfinite(x) && std::isfinite(y))
      fmt::format_to(std::back_inserter(text), "{:.8g} {:.8g}\n", x, y);
    else
      text += "\n";
  return text + "END_OF_CURVE\n";
}

// gnuplot warns of missing values in a matrix, so a cell with this or a larger value is
// transparent.
constexpr double kTransparent = 1e99;

/// The block has the values row by row from the bottom.
std::string data_block(const std::string& name, const ColourField& field) {
  assert(field.columns >= 2 && field.rows >= 2);
  assert(field.values.size() == field.columns * field.rows);
  std::string text = fmt::format("${} << END_OF_FIELD\n", name);
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const double value = field.values[i];
    fmt::format_to(std::back_inserter(text), "{:.4g}{}",
                   std::isfinite(value) ? value : kTransparent,
                   (i + 1) % field.columns == 0 ? '\n' : ' ');
  }
  return text + "END_OF_FIELD\n";
}

/// The cells fill the rectangle of the field exactly.
std::string plot_of(const std::string& name, const ColourField& field) {
  assert(field.left < field.right && field.bottom < field.top);
  const double width = (field.right - field.left) / static_cast<double>(field.columns);
  const double height = (field.top - field.bottom) / static_cast<double>(field.rows);
  return fmt::format(
      "plot ${} matrix using ({:.17g} + $1 * {:.17g}):({:.17g} + $2 * {:.17g}):($3 < {} ? $3 : "
      "NaN) with image notitle",
      name, field.left + width / 2, width, field.bottom + height / 2, height, kTransparent);
}

std::string last_part(const std::string& output) {
  return output.size() <= GnuplotTuning::kOutput
             ? output
             : output.substr(output.size() - GnuplotTuning::kOutput);
}

/// gnuplot's commands for the numbers of a linear axis with these values: as many digits as tell a
/// tenth of the range from its neighbours. By itself gnuplot writes 0.000049 at several ticks, if
/// values are small. Empty for values that it writes well.
std::string number_format(std::string_view axis, const std::vector<double>& values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values)
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  const double size = std::max(std::abs(low), std::abs(high));
  if (!(size < 1e-3) || size == 0 || !(high > low)) return "";
  const int digits =
      std::min(15, 1 + static_cast<int>(std::ceil(std::log10(10 * size / (high - low)))));
  // A number such as 4.95e-05 at the right end needs a margin of its own.
  return fmt::format("set format {} '%.{}g'\n{}", axis, digits,
                     axis == "x" ? "set rmargin 5\n" : "");
}

std::string panel_script(const Panel& panel, std::size_t index) {
  std::string script;
  for (std::size_t i = 0; i < panel.curves.size(); ++i)
    script += data_block(fmt::format("panel{}curve{}", index, i), panel.curves[i]);
  script += fmt::format(
      "unset logscale\nunset rmargin\nset format x\nset format y\nset title {}\nset xlabel {}\nset "
      "ylabel {}\n",
      quoted_for_gnuplot(panel.title), quoted_for_gnuplot(panel.x_label),
      quoted_for_gnuplot(panel.y_label));
  std::vector<double> xs, ys;
  for (const auto& curve : panel.curves)
    for (const auto& [x, y] : curve.points) xs.push_back(x), ys.push_back(y);
  if (panel.field) {
    xs.insert(xs.end(), {panel.field->left, panel.field->right});
    ys.insert(ys.end(), {panel.field->bottom, panel.field->top});
    script += "set format cb\n" + number_format("cb", panel.field->values);
  }
  script += panel.x_log ? "set logscale x\n" : number_format("x", xs);
  script += panel.y_log ? "set logscale y\n" : number_format("y", ys);
  for (const auto& setting : panel.settings) script += setting + "\n";
  std::string plots;
  if (panel.field) {
    const auto name = fmt::format("panel{}field", index);
    script += data_block(name, *panel.field);
    plots = plot_of(name, *panel.field);
  }
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    const auto& curve = panel.curves[i];
    if (curve.points.empty()) continue;  // gnuplot refuses an empty block
    plots +=
        fmt::format("{}$panel{}curve{} using 1:2 with {} {}", plots.empty() ? "plot " : ", ", index,
                    i, curve.style,
                    curve.legend.empty() ? "notitle" : "title " + quoted_for_gnuplot(curve.legend));
  }
  return script + plots + "\n";
}

/// `font_size` is in the unit of `width`. Letters, lines and points have the same size relative to
/// the picture in all kinds.
std::string terminal_of(TextKind kind, double font_size, int width, int height) {
  const auto common =
      fmt::format("noenhanced font 'sans-serif,{:g}' background 'white'", font_size);
  constexpr double kPointsPerInch = 72;
  if (kind == TextKind::kPdf)
    return fmt::format("set terminal pdfcairo size {:.6g}in,{:.6g}in {} fontscale 0.75 linewidth 2",
                       width / kPointsPerInch, height / kPointsPerInch, common);
  if (kind == TextKind::kPng)
    return fmt::format("set terminal pngcairo size {},{} {} fontscale 1.5 linewidth 2 pointscale 2",
                       2 * width, 2 * height, common);
  return fmt::format("set terminal svg size {},{} dynamic {}", width, height, common);
}

/// The texts with which a picture begins and ends in the output of gnuplot, whose warnings follow.
struct PictureMarks {
  std::string begin, end;
};

/// The marks are those of an SVG if the kind is neither PDF nor PNG.
PictureMarks marks_of(TextKind kind) {
  if (kind == TextKind::kPdf) return {"%PDF-", "%%EOF"};
  if (kind == TextKind::kPng) return {"\x89PNG", "IEND\xae\x42\x60\x82"};  // with its checksum
  return {"<svg", "</svg>"};
}

}  // namespace

std::string quoted_for_gnuplot(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n')
      result += "\\n";
    else if (c == '`')
      result += "\\140";  // an unescaped backquote would run a command of the shell
    else if (static_cast<unsigned char>(c) < ' ')
      result += "\uFFFD";  // control characters are not allowed in an SVG
    else
      result += c;
  }
  return result + "\"";
}

std::string draw_svg(const std::vector<Panel>& panels, int width, int height,
                     const StopToken& stop) {
  return draw_picture({}, panels, width, height, stop);
}

std::string draw_picture(const results::PictureFormat& format, const std::vector<Panel>& panels,
                         int width, int height, const StopToken& stop) {
  assert(width > 0 && height > 0);
  const auto kind = format.kind;
  if (format.width > 0) {
    height = std::max(1, height * format.width / width);
    width = format.width;
  }
  std::string script = fmt::format(
      "set encoding utf8\n{}\nset grid linecolor '#dddddd'\nset border linecolor '#444444'\nset "
      "key opaque spacing 1.15\n",
      terminal_of(kind, format.font_size, width, height));
  if (panels.size() > 1) script += fmt::format("set multiplot layout {},1\n", panels.size());
  for (std::size_t i = 0; i < panels.size(); ++i) script += panel_script(panels[i], i);
  if (panels.size() > 1) script += "unset multiplot\n";
  if (kind == TextKind::kHashComment)
    return "# gnuplot script by Viscontact, with its data: gnuplot FILE > PICTURE.svg\n" + script;
  const std::string gnuplot =
      script.size() > GnuplotTuning::kLong ? "cat | gnuplot /dev/stdin" : "gnuplot";
  // This shell command puts gnuplot's warnings after the picture. Without it they could stand in
  // the middle of the picture.
  const auto result =
      run_process({"/bin/sh", "-c",
                   "{ errors=$(" + gnuplot +
                       " 2>&1 >&3); status=$?; } 3>&1; printf '%s' \"$errors\"; exit $status"},
                  {"LC_ALL=C"}, script, {}, GnuplotTuning::kLongest, stop);
  if (result.timed_out)
    throw Error(ErrorKind::kExternalProgram, "gnuplot had not ended after {} s and was stopped",
                GnuplotTuning::kLongest.count());
  constexpr int kCannotBeRun = 126, kNotFound = 127;  // of the shell
  if (!result.started || result.exit_status == kNotFound || result.exit_status == kCannotBeRun)
    throw GnuplotMissing(
        ErrorKind::kExternalProgram,
        fmt::format("gnuplot cannot be run ({}); install it (apt-get install gnuplot-nox)",
                    result.output));
  const auto marks = marks_of(kind);
  const auto start = result.output.find(marks.begin);
  const auto end = result.output.rfind(marks.end);
  if (result.exit_status != 0 || start == std::string::npos || end == std::string::npos)
    throw Error(ErrorKind::kExternalProgram, "gnuplot failed (exit status {}): {}",
                result.exit_status, last_part(result.output));
  return result.output.substr(start, end + marks.end.size() - start) +
         (kind == TextKind::kPng ? "" : "\n");
}

}  // namespace viscontact::report
