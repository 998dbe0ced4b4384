// The functions of the gap that a fit may be made of, and the named bases made of them.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace viscontact {

/// A function of the gap q > 0 and of l = ln q, which is passed beside it so that a sum takes one logarithm.
struct Formula {
  /// What it computes, in q and l with + - * / ( ) and numbers that a float holds: C, Fortran and Python read it alike.
  std::string_view text;
  double (*at)(double gap, double log_gap);

  double operator()(double gap) const { return at(gap, std::log(gap)); }
};

/// One function phi of the gap q > 0, a number in the table's unit of length: another unit moves coefficients
/// between ln q and 1, q ln q and q. A coefficient's dimension is [force] over that of phi.
struct Term {
  std::string_view name;
  Formula value;  ///< phi(q)
  Formula
      log_slope;  ///< q phi'(q) = d phi / d ln q: the derivative, in a form that does not overflow near contact
  Formula antiderivative;  ///< a primitive of phi: what Gamma is made of
};

/// Name of the leading term of lubrication, 1/q.
inline constexpr std::string_view kLeadingTerm = "1/q";

/// Every term there is. A term is added by adding its row to the table in terms.cpp.
std::span<const Term> all_terms();

/// The term of that name, or nothing.
std::optional<Term> find_term(std::string_view name);

/// Sum of weight * value over all_terms(), `weights` in their order; terms of weight 0 are not evaluated. For sums that are wanted often: one logarithm, no
/// calls. The two others likewise.
double sum_values(std::span<const double> weights, double gap);
double sum_log_slopes(std::span<const double> weights, double gap);
double sum_antiderivatives(std::span<const double> weights, double gap);

/// The place of that term in all_terms().
std::size_t place_of(std::string_view term);

/// A list of terms.
struct Basis {
  std::string_view name;
  std::vector<Term> terms;
};

/// The name of a basis that is a user's own list of terms.
inline constexpr std::string_view kOwnTerms = "terms";

/// Every named basis there is:
///   lecture              1/q, 1, q, q^2, q^3        (Lefebvre 2008: a/q + b + c q + d q^2 + e q^3)
///   asymptotic           1/q, ln q, 1, q ln q, q    (near-contact expansion: Cox & Brenner 1967; Cooley & O'Neill 1969)
///   asymptotic_extended  the same and q^2 ln q, q^2, q^3
const std::vector<Basis>& all_bases();

/// The basis of that name. Throws Error(kBadInput) that lists the names there are.
const Basis& find_basis(std::string_view name);

/// A user's own basis, from names of terms separated by commas: "1/q, ln q, 1, q". Throws Error(kBadInput) for a name
/// that is no term's, and for a term named twice.
Basis parse_terms(std::string_view names);

}  // namespace viscontact
