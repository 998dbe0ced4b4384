// The file of a pair's fit, and the bases of its entries.
#include "viscontact/motions/pair_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact::motions {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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
              HasSubstr("asymptotic, asymptotic_extended, asymptotic_cubic, asymptotic_quartic"));
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
  EXPECT_THAT(refused("\"slide\":", "\"glide\":"), HasSubstr("glide"));
  EXPECT_THAT(refused("\"pair fit\"", "\"fit\""), HasSubstr("kind is 'fit'"));
  EXPECT_THAT(refused("\"reference_velocity\": -1.0", "\"reference_velocity\": -2.0"),
              HasSubstr("reference_velocity is -2; it must be -1"));
  EXPECT_THAT(refused("\"radius\": 1.0", "\"radius\": 2.0"), HasSubstr("radius"));
}

TEST(PairFit, LacksEntriesOfWhichThereWasNoTable) {
  auto fit = read_pair_fit(kPlane);
  fit.entries.erase(PairEntry::kSpin);
  EXPECT_THAT(bad_input([&] { (void)entry_value(fit, PairEntry::kSpin, 0.1); }),
              HasSubstr("lacks the entry spin"));
}

}  // namespace
}  // namespace viscontact::motions
