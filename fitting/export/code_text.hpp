// Numbers and sums of terms as code of C, Fortran, Python and MATLAB, for export_fit.cpp and
// export_pair.cpp. Numbers have the units of the fit. Nothing is thrown. A change must keep that
// the code reads back the same doubles. Used by export_fit.cpp and motions/.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "viscontact/common/text/number.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::fitting {

/// A term of a sum with its coefficient.
using WeightedTerm = std::pair<double, lubrication::Term>;

/// Writes a number as a double of the language.
using Literal = std::string (*)(double);

/// A literal of Python, or of another language in which a number without a point is as good as one
/// with a point. C needs c_literal(). `number` is finite.
inline std::string plain(double number) { return format_number(number); }

/// A Fortran literal in double precision, such as 56.5d0 or 1d-05.
inline std::string fortran_literal(double number) {
  std::string text = format_number(number);
  const auto exponent = text.find('e');
  if (exponent == std::string::npos) return text + "d0";
  text[exponent] = 'd';
  return text;
}

/// A C literal such as 56.5, 5.0 or 1e-05. Without a point or an exponent C would read it as an
/// integer, which would overflow if it has many digits.
inline std::string c_literal(double number) {
  const std::string text = format_number(number);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

/// The text "(weight) * (formula) ...", with the text `between` before each term but the first.
inline std::string terms_text(const std::vector<WeightedTerm>& terms,
                              lubrication::Formula lubrication::Term::*formula, Literal literal,
                              std::string_view between) {
  std::string text;
  for (const auto& [weight, term] : terms)
    text += fmt::format("{}({}) * ({})", text.empty() ? "" : between, literal(weight),
                        (term.*formula).text);
  return text;
}

/// An expression for the entries of arrays of MATLAB: "a*b/c" becomes "a.*b./c".
inline std::string elementwise(const std::string& expression) {
  std::string text;
  for (const char c : expression) {
    if (c == '*' || c == '/') text += '.';
    text += c;
  }
  return text;
}

/// The function of Python that computes a quantity at a number or at each entry of an array. The
/// module has SMALLEST_GAP and LARGEST_GAP. `formulas` are tuples (low, high, function of q and
/// log), of which the first that contains a gap is used.
inline constexpr std::string_view kPythonEvaluate =
    "def _evaluate(gap, formulas):\n"
    "    if isinstance(gap, (int, float)):\n"
    "        for low, high, formula in formulas:\n"
    "            if low <= gap <= high:\n"
    "                return formula(gap, math.log)\n"
    "        outside = gap\n"
    "    else:\n"
    "        import numpy  # only arrays need it\n"
    "        q = numpy.asarray(gap, dtype=float)\n"
    "        answer = numpy.empty_like(q)\n"
    "        left = numpy.ones(q.shape, dtype=bool)\n"
    "        for low, high, formula in formulas:\n"
    "            here = left & (low <= q) & (q <= high)\n"
    "            answer[here] = formula(q[here], numpy.log)\n"
    "            left &= ~here\n"
    "        if not left.any():\n"
    "            return answer[()]\n"
    "        outside = q[left][0]\n"
    "    raise ValueError(f\"gap {outside} is outside [{formulas[0][0]}, {formulas[0][1]}]\")\n";

/// The lines with blanks in place of control characters, for comments of the code. A line end in a
/// text of a fit file would otherwise begin a line of code.
inline std::vector<std::string> on_lines_of_comments(std::vector<std::string> lines) {
  for (auto& line : lines)
    std::ranges::replace_if(
        line, [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return lines;
}

}  // namespace viscontact::fitting
