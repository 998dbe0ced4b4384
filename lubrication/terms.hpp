// Terms, the functions of the gap q that fits combine, and lists of terms (docs/physics.md (3.2)).
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace viscontact::lubrication {

/// The largest gap L where there is no wall opposite the neighbour.
inline constexpr double kNoWall = std::numeric_limits<double>::infinity();

/// A function of the gap q > 0, of l = ln q, of the distance p = L - q to the wall opposite the
/// neighbour (second_wall.hpp), and of m = ln p. Without that wall p and m are infinite. The
/// logarithms are arguments so that they are computed only once for a sum of terms.
struct Formula {
  /// The expression in q, l, p and m, with + - * / ( ) and numbers. Exported code of C, Fortran,
  /// Python and MATLAB contains it. Numbers must be exact in single precision for Fortran.
  std::string_view text;
  double (*at)(double q, double l, double p, double m);  ///< the value

  /// The value at the gap q > 0, with a wall at the largest gap L > q.
  double operator()(double gap, double largest_gap = kNoWall) const {
    return at(gap, std::log(gap), largest_gap - gap, std::log(largest_gap - gap));
  }
};

/// A function phi of the gap q > 0, a number in the unit of length of the fit. Its coefficient in a
/// force has the unit of a force [M L/T^2] over that of phi. In another unit of length ln q differs
/// by a constant; the coefficients of q^n then change by multiples of those of q^n ln q.
struct Term {
  std::string_view name;  ///< in fit files and the option `--terms`, such as "q ln q"
  Formula value;          ///< phi(q)
  /// q phi'(q) = d phi/d ln q, which does not overflow near contact.
  Formula log_slope;
  Formula antiderivative;
};

/// The leading term of lubrication.
inline constexpr std::string_view kLeadingTerm = "1/q";

/// 1/q, ln q, 1, q ln q, q, q^2 ln q, q^2, q^3 ln q, q^3, q^4 ln q, q^4.
std::span<const Term> all_terms();

/// all_terms(), and then the terms of a second wall, 1/(L-q) and ln(L-q).
std::span<const Term> terms_beside_walls();

/// True for a function of the distance L - q to the wall opposite the neighbour.
bool needs_second_wall(std::string_view term);

/// The factor "f" of a term f ln q, "1" for ln q and ln(L-q); nothing for other terms.
std::optional<std::string> factor_of_logarithm(std::string_view term);

std::optional<Term> find_term(std::string_view name);

/// The sum of weight * value over terms_beside_walls(), or only all_terms(), as many as there are
/// weights, at a gap > 0. A term of weight 0 is not evaluated. For the speed of inner loops this
/// function and the next two compute one logarithm and call no function pointer.
double sum_values(std::span<const double> weights, double gap, double largest_gap = kNoWall);
/// The same for log_slope.
double sum_log_slopes(std::span<const double> weights, double gap, double largest_gap = kNoWall);
/// The same for the antiderivative.
double sum_antiderivatives(std::span<const double> weights, double gap,
                           double largest_gap = kNoWall);

/// The index of the term in terms_beside_walls(). Throws Error(kBadInput) for another name.
std::size_t place_of(std::string_view term);

/// A named list of terms.
struct Basis {
  std::string_view name;    ///< one of all_bases(), two_walls, or kOwnTerms
  std::vector<Term> terms;  ///< at least one, none of them twice
};

/// The name of a basis that a user gives as a list of terms.
inline constexpr std::string_view kOwnTerms = "terms";

/// The bases, with q in units of the table:
///   lecture              1/q, 1, q, q^2, q^3; used by Lefebvre 2008, physics.md (3.1)
///   asymptotic           1/q, ln q, 1, q ln q, q: the expansion near contact by Cox & Brenner 1967
///                        and Cooley & O'Neill 1969
///   asymptotic_extended  the terms of `asymptotic`, and q^2 ln q, q^2, q^3
const std::vector<Basis>& all_bases();

/// all_bases(), and then `two_walls` with 1/q, ln q, 1, q, q^2, 1/(L-q), ln(L-q), for a sphere that
/// has a wall on either side, at the gaps 0 and L.
const std::vector<Basis>& bases_beside_walls();

/// The basis `lecture`, which is fitted if a user names no basis.
const Basis& default_basis();

/// One of bases_beside_walls(). Throws Error(kBadInput), which lists the names, for another name.
const Basis& find_basis(std::string_view name);

/// The basis of terms whose names are separated by commas: "1/q, ln q, 1, q". Throws
/// Error(kBadInput) if a name is not that of a term, or stands twice.
Basis parse_terms(std::string_view names);

}  // namespace viscontact::lubrication
