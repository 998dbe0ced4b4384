#include "viscontact/lubrication/terms.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <set>
#include <string>

#include "tests/common/failure.hpp"

namespace viscontact::lubrication {
namespace {

using ::testing::ElementsAre;

/// f'(q) by the central difference of five points, step h = q/256 (a power of two: q +- h are
/// exact).
double numerical_derivative(const Formula& f, double q) {
  const double h = std::ldexp(q, -8);
  return (8 * (f(q + h) - f(q - h)) - (f(q + 2 * h) - f(q - 2 * h))) / (12 * h);
}

/// What that may be off by. Truncation is h^4 f^(5)/30 = q^-1 (h/q)^4 |q^5 f^(5)|/30, where |q^5
/// f^(5)| is at most 120 times the size of the term (1/q: 5!), hence 4 * 2^-32 = 1e-9; rounding is
/// eps * 256 = 6e-14. `size` is the term's own.
double numerical_tolerance(double size, double q) { return 2e-9 * size / q; }

/// |f| without the dip where a logarithm passes zero.
double size_of(const Formula& f, double q) {
  return std::abs(f(q)) + std::abs(f(2 * q)) + std::abs(f(q / 2));
}

class EachTerm : public ::testing::TestWithParam<Term> {};

TEST_P(EachTerm, HasItsDerivativeByTheLogarithmAsLogSlope) {
  const auto& term = GetParam();
  for (const double q : {1e-4, 0.03, 0.9, 1.0, 7.0})
    EXPECT_NEAR(term.log_slope(q) / q, numerical_derivative(term.value, q),
                numerical_tolerance(size_of(term.value, q), q))
        << term.name << " at " << q;
}

TEST_P(EachTerm, IsTheDerivativeOfItsAntiderivative) {
  const auto& term = GetParam();
  for (const double q : {1e-4, 0.03, 0.9, 1.0, 7.0})
    EXPECT_NEAR(term.value(q), numerical_derivative(term.antiderivative, q),
                numerical_tolerance(size_of(term.antiderivative, q), q))
        << term.name << " at " << q;
}

TEST_P(EachTerm, IsFoundByItsName) {
  const auto found = find_term(GetParam().name);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->value.text, GetParam().value.text);
}

INSTANTIATE_TEST_SUITE_P(Terms, EachTerm,
                         ::testing::ValuesIn(all_terms().begin(), all_terms().end()),
                         [](const auto& tested) {
                           return "Number" + std::to_string(tested.index);
                         });

TEST(Terms, AreWhatTheirNamesSay) {
  const double q = 0.3;
  EXPECT_EQ(find_term("1/q")->value(q), 1 / q);
  EXPECT_EQ(find_term("ln q")->value(q), std::log(q));
  EXPECT_EQ(find_term("1")->value(q), 1);
  EXPECT_EQ(find_term("q ln q")->value(q), q * std::log(q));
  EXPECT_EQ(find_term("q")->value(q), q);
  EXPECT_DOUBLE_EQ(find_term("q^2")->value(q), q * q);
  EXPECT_DOUBLE_EQ(find_term("q^3")->value(q), q * q * q);
  EXPECT_DOUBLE_EQ(find_term("q^2 ln q")->value(q), q * q * std::log(q));
  EXPECT_DOUBLE_EQ(find_term("q^3 ln q")->value(q), q * q * q * std::log(q));
  EXPECT_DOUBLE_EQ(find_term("q^4 ln q")->value(q), q * q * q * q * std::log(q));
  EXPECT_DOUBLE_EQ(find_term("q^4")->value(q), q * q * q * q);
}

TEST(Terms, HaveDifferentNames) {
  std::set<std::string_view> names;
  for (const auto& term : all_terms()) EXPECT_TRUE(names.insert(term.name).second) << term.name;
}

TEST(Terms, OfAnUnknownNameAreNone) { EXPECT_FALSE(find_term("q^5").has_value()); }

std::vector<std::string> term_names(std::string_view basis) {
  std::vector<std::string> names;
  for (const auto& term : find_basis(basis).terms) names.emplace_back(term.name);
  return names;
}

TEST(Bases, HaveTheTermsOfTheirSources) {
  EXPECT_THAT(term_names("lecture"), ElementsAre("1/q", "1", "q", "q^2", "q^3"));
  EXPECT_THAT(term_names("asymptotic"), ElementsAre("1/q", "ln q", "1", "q ln q", "q"));
  EXPECT_THAT(term_names("asymptotic_extended"),
              ElementsAre("1/q", "ln q", "1", "q ln q", "q", "q^2 ln q", "q^2", "q^3"));
}

TEST(OwnTerms, AreThoseNamedInTheirOrder) {
  const auto basis = parse_terms(" q^2,1/q , q ln q");
  EXPECT_EQ(basis.name, kOwnTerms);
  std::vector<std::string> names;
  for (const auto& term : basis.terms) names.emplace_back(term.name);
  EXPECT_THAT(names, ElementsAre("q^2", "1/q", "q ln q"));
}

TEST(OwnTerms, AreRefusedWhereANameIsUnknownEmptyOrThereTwice) {
  EXPECT_THAT(bad_input([] { parse_terms("1/q, q^7"); }), Names("q^7"));
  EXPECT_THAT(bad_input([] { parse_terms("1/q,, q"); }), Says("''"));
  EXPECT_THAT(bad_input([] { parse_terms(""); }), Names("1/q", "ln q"));
  EXPECT_THAT(bad_input([] { parse_terms("1/q, q, 1/q"); }), Names("twice"));
}

TEST(Bases, AreListedWhereANameIsUnknown) {
  const auto message = bad_input([] { find_basis("cubic"); });
  EXPECT_THAT(message, Names("cubic"));
  for (const auto& basis : all_bases()) EXPECT_THAT(message, Names(basis.name));
}

}  // namespace
}  // namespace viscontact::lubrication
