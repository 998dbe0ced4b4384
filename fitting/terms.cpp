#include "fitting/terms.hpp"

#include <array>
#include <cmath>

#include "common/named.hpp"

namespace viscontact {
namespace {

constexpr std::array kTerms = {
    Term{kLeadingTerm,  //
         [](double q) { return 1 / q; }, [](double q) { return -1 / q; },
         [](double q) { return std::log(q); }},
    Term{"ln q",  //
         [](double q) { return std::log(q); }, [](double) { return 1.0; },
         [](double q) { return q * (std::log(q) - 1); }},
    Term{"1",  //
         [](double) { return 1.0; }, [](double) { return 0.0; }, [](double q) { return q; }},
    Term{"q ln q",  //
         [](double q) { return q * std::log(q); }, [](double q) { return q * (std::log(q) + 1); },
         [](double q) { return q * q / 2 * (std::log(q) - 0.5); }},
    Term{"q",  //
         [](double q) { return q; }, [](double q) { return q; },
         [](double q) { return q * q / 2; }},
    Term{"q^2",  //
         [](double q) { return q * q; }, [](double q) { return 2 * q * q; },
         [](double q) { return q * q * q / 3; }},
    Term{"q^3",  //
         [](double q) { return q * q * q; }, [](double q) { return 3 * q * q * q; },
         [](double q) { return q * q * q * q / 4; }},
};

Basis make_basis(std::string_view name, std::initializer_list<std::string_view> terms) {
  Basis basis{name, {}};
  for (const auto term : terms) basis.terms.push_back(find_term(term).value());
  return basis;
}

}  // namespace

std::span<const Term> all_terms() { return kTerms; }

std::optional<Term> find_term(std::string_view name) {
  const auto* term = find_named(kTerms, name);
  return term == nullptr ? std::nullopt : std::optional(*term);
}

const std::vector<Basis>& all_bases() {
  static const std::vector<Basis> bases = {
      make_basis("lecture", {"1/q", "1", "q", "q^2", "q^3"}),
      make_basis("asymptotic", {"1/q", "ln q", "1", "q ln q", "q"}),
  };
  return bases;
}

const Basis& find_basis(std::string_view name) { return require_named(all_bases(), name, "basis"); }

}  // namespace viscontact
