// Numbers and sums of terms as code of C, Fortran, Python and MATLAB.
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

/// The weight of a term in a sum, and the term. The unit of the weight is the unit of the sum
/// divided by the unit of the term.
using WeightedTerm = std::pair<double, lubrication::Term>;

/// A function that writes a finite number as a literal of type double in one language, which a
/// compiler reads as the same double.
using Literal = std::string (*)(double);

/// A literal of Python or MATLAB, such as 56.5, 5 or 1e-05. Unlike C, these languages need no point
/// in a number.
inline std::string plain(double number) { return format_number(number); }

/// A Fortran literal, such as 56.5d0 or 1d-05.
inline std::string fortran_literal(double number) {
  std::string text = format_number(number);
  const auto exponent = text.find('e');
  if (exponent == std::string::npos) return text + "d0";
  text[exponent] = 'd';
  return text;
}

/// A C literal such as 56.5, 5.0 or 1e-05. C reads a literal without a point or an exponent as an
/// integer, and an integer of many digits overflows.
inline std::string c_literal(double number) {
  const std::string text = format_number(number);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

/// The sum of weight * formula over `terms` as code, with the gap as variable q and its logarithm
/// as l. `formula` selects one function of each term: value, log_slope (q times the derivative) or
/// antiderivative. `between` is the text that joins two summands: a plus sign, and a line break in
/// the syntax of the language.
inline std::string terms_text(const std::vector<WeightedTerm>& terms,
                              lubrication::Formula lubrication::Term::*formula, Literal literal,
                              std::string_view between) {
  std::string text;
  for (const auto& [weight, term] : terms)
    text += fmt::format("{}({}) * ({})", text.empty() ? "" : between, literal(weight),
                        (term.*formula).text);
  return text;
}

/// The expression with MATLAB's operators for the entries of arrays: "a*b/c" becomes "a.*b./c".
inline std::string elementwise(const std::string& expression) {
  std::string text;
  for (const char c : expression) {
    if (c == '*' || c == '/') text += '.';
    text += c;
  }
  return text;
}

/// Python's function _evaluate(gap, formulas), which each exported module contains. `gap` is a
/// number or an array. `formulas` are tuples (low, high, f): f(q, log) is the formula for gaps q in
/// [low, high], with the logarithm of `math` or of NumPy. The first tuple whose interval contains a
/// gap is used. Raises ValueError, which names the interval of the first tuple, if a gap is in no
/// interval.
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

/// The lines with blanks in place of control characters. The lines become comments of the written
/// code, and a line end within a text from the fit file would end the comment.
inline std::vector<std::string> on_lines_of_comments(std::vector<std::string> lines) {
  for (auto& line : lines)
    std::ranges::replace_if(
        line, [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return lines;
}

/// The lines as comments, each of which begins with `mark` (such as "//") and a blank.
inline std::string commented(const std::vector<std::string>& lines, std::string_view mark) {
  std::string text;
  for (const auto& line : lines) text += fmt::format("{} {}\n", mark, line);
  return text;
}

}  // namespace viscontact::fitting
