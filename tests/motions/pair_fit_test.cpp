// The file of a pair's fit, and the bases of its entries.
#include "viscontact/motions/pair_fit.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact::motions {
namespace {

const std::string kPlane = std::string(VISCONTACT_SOURCE_FOLDER) + "/data/fits/pairs/plane.json";

std::string names_of_terms(const lubrication::Basis& basis) {
  std::string names;
  for (const auto& term : basis.terms) names += std::string(term.name) + ", ";
  return names;
}

TEST(PairBasis, HasTheTermsThatTheoryHas) {
  const auto& entries = pair_entries();
  EXPECT_EQ(names_of_terms(basis_of_entry(entries[0], "asymptotic")), "1/q, ln q, 1, q ln q, q, ");
  EXPECT_EQ(names_of_terms(basis_of_entry(entries[1], "asymptotic_extended")),
            "ln q, 1, q ln q, q, q^2 ln q, q^2, q^3, ");
  EXPECT_EQ(names_of_terms(basis_of_entry(entries[4], "asymptotic_cubic")),
            "1, q ln q, q, q^2 ln q, q^2, q^3, q^3 ln q, ");
  EXPECT_THAT(bad_input([&] { (void)basis_of_entry(entries[0], "lecture"); }),
              Names("asymptotic_extended", "asymptotic_cubic", "asymptotic_quartic"));
}

TEST(ScaledPairFit, HasTheResistancesOfTheSameGapInRadii) {
  const auto fit = read_pair_fit(kPlane);
  const double ratio = 5e-4 / fit.radius, viscous = 0.1 / fit.viscosity;
  const auto scaled = scaled_to(fit, 0.1, 5e-4);
  EXPECT_EQ(scaled.radius, 5e-4);
  EXPECT_EQ(scaled.viscosity, 0.1);
  EXPECT_DOUBLE_EQ(scaled.gap_interval[1], fit.gap_interval[1] * ratio);
  // Force per velocity, torque per velocity, torque per angular velocity (2.12).
  const std::map<PairEntry, int> powers = {{PairEntry::kSqueeze, 1},
                                           {PairEntry::kSlide, 1},
                                           {PairEntry::kSlideRoll, 2},
                                           {PairEntry::kRoll, 3},
                                           {PairEntry::kSpin, 3}};
  for (const auto& [entry, power] : powers)
    for (const double gap : {1e-3, 0.03, 1.0})
      EXPECT_NEAR(entry_value(scaled, entry, gap * ratio) / entry_value(fit, entry, gap) /
                      (viscous * std::pow(ratio, power)),
                  1, 1e-12)
          << static_cast<int>(entry) << " " << gap;
  // Theory's coefficients scale as the fitted ones: a fit of them is at the same distance.
  for (const auto& [entry, one] : fit.entries)
    if (one.theory) {
      const auto leading = pair_entries()[static_cast<std::size_t>(entry)].leading_term;
      const auto coefficient = [&](const EntryFit& of) {
        for (const auto& term : of.fit.terms)
          if (term.name == leading) return term.coefficient;
        return 0.0;
      };
      EXPECT_NEAR(*scaled.entries.at(entry).theory * coefficient(one),
                  *one.theory * coefficient(scaled.entries.at(entry)),
                  1e-12 * std::abs(*one.theory * coefficient(scaled.entries.at(entry))));
    }
  EXPECT_EQ(write_pair_fit(scaled_to(fit, fit.viscosity, fit.radius)), write_pair_fit(fit));
}

TEST(PairFitFile, IsReadAsItWasWritten) {
  const auto fit = read_pair_fit(kPlane);
  const TemporaryFolder folder;
  const auto copy = read_pair_fit(folder.file("copy.json", write_pair_fit(fit)));
  EXPECT_EQ(write_pair_fit(copy), write_pair_fit(fit));
  EXPECT_EQ(fit.entries.size(), 5U);
  EXPECT_TRUE(is_pair_fit(kPlane));
  EXPECT_FALSE(is_pair_fit(std::string(VISCONTACT_SOURCE_FOLDER) + "/data/fits/lecture.json"));
}

TEST(PairFitFile, IsRefusedWithTheKey) {
  const auto text = read_file(kPlane);
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& from, const std::string& to) {
    auto other = text;
    other.replace(other.find(from), from.size(), to);
    return bad_input([&] { (void)read_pair_fit(folder.file("fit.json", other)); });
  };
  EXPECT_THAT(refused("\"slide\":", "\"glide\":"), IsAt("fit.json:215", "entries.glide"));
  EXPECT_THAT(refused("\"pair fit\"", "\"fit\""), IsAt("fit.json:3", "kind"));
  EXPECT_THAT(refused("\"reference_velocity\": -1.0", "\"reference_velocity\": -2.0"),
              IsAt("fit.json:14", "entries.squeeze.reference_velocity"));
  EXPECT_THAT(refused("\"radius\": 1.0", "\"radius\": 2.0"),
              IsAt("fit.json:16", "entries.squeeze.radius"));
}

TEST(PairFit, LacksEntriesOfWhichThereWasNoTable) {
  auto fit = read_pair_fit(kPlane);
  fit.entries.erase(PairEntry::kSpin);
  EXPECT_THAT(bad_input([&] { (void)entry_value(fit, PairEntry::kSpin, 0.1); }), Names("spin"));
}

}  // namespace
}  // namespace viscontact::motions
