// Lists the terms, the functions of the gap q that a fit of a force may combine, and the bases,
// named lists of terms (docs/physics.md (3.2)). q is a number > 0 in the unit of length of the fit.
// No function checks that q > 0: values at other q are NaN, infinite, or without meaning. An
// unknown name throws Error(kBadInput) if the comment of the function does not say otherwise.
// fitting/, lubrication/, motions/, rolling/, case_file/ and app/ use this file. A change must keep
// names and formulas, which fit files and exports contain; terms and bases may be added.
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
/// neighbour (second_wall.hpp), and of m = ln p. The logarithms are arguments so that they are
/// computed only once for a sum of terms. Without that wall p and m are infinite.
struct Formula {
  /// The expression in q, l, p and m, with + - * / ( ) and numbers. Exported code of C, Fortran, Python
  /// and MATLAB contains it. The numbers must be exact in single precision, as Fortran reads them.
  std::string_view text;
  double (*at)(double q, double l, double p, double m);  ///< the value

  /// The value at the gap q > 0, with a wall at the largest gap L > q.
  double operator()(double gap, double largest_gap = kNoWall) const {
    return at(gap, std::log(gap), largest_gap - gap, std::log(largest_gap - gap));
  }
};

/// A function phi of the gap q > 0. Its coefficient in a force has the unit of a force [M L/T^2]
/// over that of phi. In another unit of length ln q differs by a constant; the coefficients of 1,
/// q, ... then change by multiples of those of ln q, q ln q, ...
struct Term {
  std::string_view name;  ///< in fit files and the option `--terms`, such as "q ln q"
  Formula value;          ///< phi(q)
  /// q phi'(q) = d phi/d ln q: the derivative in a form that does not overflow near contact.
  Formula log_slope;
  /// A primitive of phi: a function whose derivative is phi.
  Formula antiderivative;
};

/// Name of the leading term of lubrication, 1/q.
inline constexpr std::string_view kLeadingTerm = "1/q";

/// The terms of the gap alone: 1/q, ln q, 1, q ln q, q, q^2 ln q, q^2, q^3 ln q, q^3, q^4 ln q, q^4.
/// A new term needs only a row in the table of terms.cpp.
std::span<const Term> all_terms();

/// all_terms(), and then the terms of a second wall, 1/(L-q) and ln(L-q).
std::span<const Term> terms_beside_walls();

/// True if the term is a function of the distance L - q to the wall opposite the neighbour.
bool needs_second_wall(std::string_view term);

/// For a term f ln q or ln(L-q) the factor of the logarithm, such as "q" or "1"; nothing for other
/// terms.
std::optional<std::string> factor_of_logarithm(std::string_view term);

/// The term with this name, or nothing if there is none. Throws nothing.
std::optional<Term> find_term(std::string_view name);

/// The sum of weight * value over terms_beside_walls() at a gap > 0. `weights` has an entry for each
/// of these terms, in the same order, or only for all_terms(); a term of weight 0 is not evaluated. The result
/// has the dimension of a weight times that of its term. For the speed of inner loops this function
/// and the next two compute one logarithm and call no function pointer.
double sum_values(std::span<const double> weights, double gap, double largest_gap = kNoWall);
/// The sum of weight * log_slope over the same terms; arguments are those of sum_values().
double sum_log_slopes(std::span<const double> weights, double gap, double largest_gap = kNoWall);
/// The sum of weight * antiderivative over the same terms; arguments are those of sum_values(). The
/// result has the dimension of sum_values() times a length.
double sum_antiderivatives(std::span<const double> weights, double gap,
                           double largest_gap = kNoWall);

/// The index, from 0, of the term in terms_beside_walls(). Throws Error(kBadInput) if no term has this name.
std::size_t place_of(std::string_view term);

/// A named list of terms.
struct Basis {
  std::string_view name;    ///< one of all_bases(), two_walls, or kOwnTerms
  std::vector<Term> terms;  ///< at least one, none of them twice
};

/// The name of a basis that a user gives as a list of terms.
inline constexpr std::string_view kOwnTerms = "terms";

/// All named bases, with q in units of the table:
///   lecture              1/q, 1, q, q^2, q^3; used by Lefebvre 2008, physics.md (3.1)
///   asymptotic           1/q, ln q, 1, q ln q, q; these terms are those of the expansion near
///                        contact by Cox & Brenner 1967 and Cooley & O'Neill 1969
///   asymptotic_extended  the terms of `asymptotic`, and q^2 ln q, q^2, q^3
const std::vector<Basis>& all_bases();

/// all_bases(), and then `two_walls` with 1/q, ln q, 1, q, q^2, 1/(L-q), ln(L-q), for a sphere that
/// has a wall on either side, at the gaps 0 and L.
const std::vector<Basis>& bases_beside_walls();

/// The basis `lecture`, which is fitted if a user names no basis.
const Basis& default_basis();

/// The basis with this name in bases_beside_walls(). Throws Error(kBadInput), which lists the names, if there is none.
const Basis& find_basis(std::string_view name);

/// Makes a basis from names of terms that are separated by commas: "1/q, ln q, 1, q". Throws
/// Error(kBadInput) if a name, also an empty one, is not that of a term, or if a term is named
/// twice.
Basis parse_terms(std::string_view names);

}  // namespace viscontact::lubrication
