// The table of terms, and the bases.
#include "viscontact/lubrication/terms.hpp"

#include <array>
#include <cassert>
#include <type_traits>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/named.hpp"

namespace viscontact::lubrication {
namespace {

// A Formula of one expression, so that the exported text cannot differ from the code.
#define FORMULA(expression)                                                                 \
  Formula {                                                                                 \
#expression,                                                                            \
        []([[maybe_unused]] double q, [[maybe_unused]] double l, [[maybe_unused]] double p, \
           [[maybe_unused]] double m) -> double { return expression; }                      \
  }

// Sums are added in this order.
// clang-format off
constexpr std::array kTerms = {
    //   name          value             log_slope                 antiderivative
    Term{kLeadingTerm, FORMULA(1.0/q),   FORMULA(-1.0/q),          FORMULA(l)},
    Term{"ln q",       FORMULA(l),       FORMULA(1.0),             FORMULA(q*(l - 1.0))},
    Term{"1",          FORMULA(1.0),     FORMULA(0.0),             FORMULA(q)},
    Term{"q ln q",     FORMULA(q*l),     FORMULA(q*(l + 1.0)),     FORMULA(q*q*(2.0*l - 1.0)/4.0)},
    Term{"q",          FORMULA(q),       FORMULA(q),               FORMULA(q*q/2.0)},
    Term{"q^2 ln q",   FORMULA(q*q*l),   FORMULA(q*q*(2.0*l + 1.0)), FORMULA(q*q*q*(3.0*l - 1.0)/9.0)},
    Term{"q^2",        FORMULA(q*q),     FORMULA(2.0*q*q),         FORMULA(q*q*q/3.0)},
    Term{"q^3 ln q",   FORMULA(q*q*q*l), FORMULA(q*q*q*(3.0*l + 1.0)), FORMULA(q*q*q*q*(4.0*l - 1.0)/16.0)},
    Term{"q^3",        FORMULA(q*q*q),   FORMULA(3.0*q*q*q),       FORMULA(q*q*q*q/4.0)},
    Term{"q^4 ln q",   FORMULA(q*q*q*q*l), FORMULA(q*q*q*q*(4.0*l + 1.0)), FORMULA(q*q*q*q*q*(5.0*l - 1.0)/25.0)},
    Term{"q^4",        FORMULA(q*q*q*q), FORMULA(4.0*q*q*q*q),     FORMULA(q*q*q*q*q/5.0)},
    Term{"1/(L-q)",    FORMULA(1.0/p),   FORMULA(q/(p*p)),         FORMULA(0.0 - m)},
    Term{"ln(L-q)",    FORMULA(m),       FORMULA(0.0 - q/p),       FORMULA(p*(1.0 - m))},
};
// clang-format on

constexpr std::size_t kWallTerms = 2;  // the last ones of kTerms

#undef FORMULA

/// The text without blanks and tabs at its ends.
std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Throws Error(kBadInput) if there is no term with this name, or if `basis` has it.
void add_term(Basis& basis, std::string_view name) {
  if (find_named(basis.terms, name) != nullptr)
    throw Error(ErrorKind::kBadInput, "the term '{}' is named twice; name it once", name);
  basis.terms.push_back(require_named(kTerms, name, "term"));
}

Basis make_basis(std::string_view name, std::string_view terms) {
  Basis basis = parse_terms(terms);
  basis.name = name;
  return basis;
}

/// Each formula is known at compile time and inlined.
template <Formula Term::*formula>
double sum_of(std::span<const double> weights, double gap, double largest_gap) {
  assert(weights.size() == kTerms.size() || weights.size() == all_terms().size());
  const double log_gap = std::log(gap);
  const double to_wall = largest_gap - gap;
  const double log_to_wall = largest_gap < kNoWall ? std::log(to_wall) : kNoWall;
  double total = 0;
  const auto add = [&]<std::size_t i>(std::integral_constant<std::size_t, i>) {
    constexpr auto at = (kTerms[i].*formula).at;
    if (i < weights.size() && weights[i] != 0)
      total += weights[i] * at(gap, log_gap, to_wall, log_to_wall);
  };
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (add(std::integral_constant<std::size_t, i>()), ...);
  }
  (std::make_index_sequence<kTerms.size()>());
  return total;
}

}  // namespace

std::span<const Term> all_terms() { return std::span(kTerms).first(kTerms.size() - kWallTerms); }

std::span<const Term> terms_beside_walls() { return kTerms; }

bool needs_second_wall(std::string_view term) { return term.find('L') != term.npos; }

std::optional<std::string> factor_of_logarithm(std::string_view term) {
  if (term == "ln(L-q)") return "1";
  constexpr std::string_view kLogarithm = "ln q";
  if (!term.ends_with(kLogarithm)) return {};
  term.remove_suffix(kLogarithm.size());
  if (term.empty()) return "1";
  return std::string(term.substr(0, term.size() - 1));  // without the blank
}

double sum_values(std::span<const double> weights, double gap, double largest_gap) {
  return sum_of<&Term::value>(weights, gap, largest_gap);
}

double sum_log_slopes(std::span<const double> weights, double gap, double largest_gap) {
  return sum_of<&Term::log_slope>(weights, gap, largest_gap);
}

double sum_antiderivatives(std::span<const double> weights, double gap, double largest_gap) {
  return sum_of<&Term::antiderivative>(weights, gap, largest_gap);
}

std::size_t place_of(std::string_view term) {
  return static_cast<std::size_t>(&require_named(kTerms, term, "term") - kTerms.data());
}

std::optional<Term> find_term(std::string_view name) {
  const auto* term = find_named(kTerms, name);
  return term == nullptr ? std::nullopt : std::optional(*term);
}

const std::vector<Basis>& all_bases() {
  static const std::vector<Basis> bases = {
      // The first basis is the default. Another order would change the fits of users.
      make_basis("lecture", "1/q, 1, q, q^2, q^3"),
      make_basis("asymptotic", "1/q, ln q, 1, q ln q, q"),
      make_basis("asymptotic_extended", "1/q, ln q, 1, q ln q, q, q^2 ln q, q^2, q^3"),
  };
  return bases;
}

const std::vector<Basis>& bases_beside_walls() {
  static const std::vector<Basis> bases = [] {
    auto all = all_bases();
    all.push_back(make_basis("two_walls", "1/q, ln q, 1, q, q^2, 1/(L-q), ln(L-q)"));
    return all;
  }();
  return bases;
}

const Basis& default_basis() { return all_bases().front(); }

const Basis& find_basis(std::string_view name) {
  return require_named(bases_beside_walls(), name, "basis");
}

Basis parse_terms(std::string_view names) {
  Basis basis{kOwnTerms, {}};
  for (std::size_t begin = 0; begin <= names.size();) {
    const auto end = std::min(names.find(',', begin), names.size());
    add_term(basis, trimmed(names.substr(begin, end - begin)));
    begin = end + 1;
  }
  return basis;
}

}  // namespace viscontact::lubrication
