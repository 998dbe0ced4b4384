// The functions of the gap that a fit may be made of, and the named bases made of them.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace viscontact {

/// One function phi of the gap q > 0, a number in the table's unit of length: another unit moves coefficients
/// between ln q and 1, q ln q and q. A coefficient's dimension is [force] over that of phi.
struct Term {
  std::string_view name;
  double (*value)(double gap);           ///< phi(q)
  double (*log_slope)(double gap);       ///< q phi'(q) = d phi / d ln q
  double (*antiderivative)(double gap);  ///< a primitive of phi: what Gamma is made of
};

/// Name of the leading term of lubrication, 1/q.
inline constexpr std::string_view kLeadingTerm = "1/q";

/// Every term there is. A term is added by adding its row to the table in terms.cpp.
std::span<const Term> all_terms();

/// The term of that name, or nothing.
std::optional<Term> find_term(std::string_view name);

/// A named list of terms.
struct Basis {
  std::string_view name;
  std::vector<Term> terms;
};

/// Every basis there is:
///   lecture     1/q, 1, q, q^2, q^3        (Lefebvre 2008: a/q + b + c q + d q^2 + e q^3)
///   asymptotic  1/q, ln q, 1, q ln q, q    (near-contact expansion: Cox & Brenner 1967; Cooley &
///   O'Neill 1969)
const std::vector<Basis>& all_bases();

/// The basis of that name. Throws Error(kBadInput) that lists the names there are.
const Basis& find_basis(std::string_view name);

}  // namespace viscontact
