#include "viscontact/results/failed_models.hpp"

#include <gmock/gmock.h>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"

namespace viscontact::results {
namespace {

const std::vector<FailedModel> kFailed = {
    {"reference", "the gap is below the fit", ErrorKind::kBadInput, {{"case", "1"}}},
    {"inertial", "it said \"no\"\nand stopped", ErrorKind::kNotConverged, {{"case", "2"}}}};

TEST(RecordOfFailedModels, IsReadAsItWasWritten) {
  const TemporaryFolder folder;
  const auto read =
      read_failed_models(folder.file("failed_models.json", write_failed_models(kFailed)));
  ASSERT_EQ(read.size(), kFailed.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].model, kFailed[i].model);
    EXPECT_EQ(read[i].reason, kFailed[i].reason);
    EXPECT_EQ(read[i].kind, kFailed[i].kind);
    EXPECT_EQ(read[i].made_from, kFailed[i].made_from);
  }
}

TEST(RecordOfFailedModels, ThatIsAbsentNamesNone) {
  const TemporaryFolder folder;
  EXPECT_TRUE(read_failed_models(folder.path() / "failed_models.json").empty());
}

TEST(RecordOfFailedModels, ThatIsDamagedIsRefused) {
  const TemporaryFolder folder;
  for (const auto* text : {"", "[]", "{\"failed_models\": {\"inertial\": {}}}",
                           "{\"failed_models\": {\"inertial\": {\"reason\": \"r\", \"exit_code\": "
                           "77, \"made_from\": {}}}}"}) {
    const auto file = folder.file("failed_models.json", text);
    EXPECT_THAT(bad_input([&] { read_failed_models(file); }), IsAt("failed_models.json"));
    EXPECT_TRUE(recorded_failures({folder.path()}, {}).empty());
  }
}

TEST(RecordOfFailedModels, CountsForTheInputsThatItWasMadeFrom) {
  const TemporaryFolder folder;
  folder.file("failed_models.json", write_failed_models(kFailed));
  const auto failed = recorded_failures({folder.path()}, {{"case", "2"}});
  ASSERT_EQ(failed.size(), 1U);
  EXPECT_EQ(failed[0].model, "inertial");
}

TEST(FailedModels, EndASimulationWithTheErrorOfTheFirst) {
  const auto error = error_of(kFailed, 2, "case.toml");
  EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
  EXPECT_STREQ(error.what(),
               "case.toml: model reference: the gap is below the fit; 1 more failed (inertial); 2 "
               "other models are computed and written");
}

TEST(FailedModels, AreNotTheReference) {
  EXPECT_EQ(reference_without({"viscous_contact", "inertial"}, {}), "inertial");
  EXPECT_EQ(reference_without({"viscous_contact", "inertial"}, kFailed), "viscous_contact");
  EXPECT_EQ(reference_without({"reference", "inertial"}, kFailed), "inertial");  // nothing is left

  reduced_model::Trajectory computed;
  computed.model = "viscous_contact";
  EXPECT_EQ(reference_among({computed}, {}, ""), "inertial");
  EXPECT_EQ(reference_among({computed}, {{"inertial", "why"}}, ""), "viscous_contact");
  EXPECT_EQ(reference_among({computed}, {{"inertial", "why"}}, "viscous_contact"),
            "viscous_contact");
  EXPECT_THAT(bad_input([&] {
                reference_among({computed}, {{"inertial", "why"}}, "inertial");
              }),
              Names("why"));
}

}  // namespace
}  // namespace viscontact::results
