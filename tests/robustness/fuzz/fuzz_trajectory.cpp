// Any bytes as a trajectory file: read, written, read again, compared.
#include <string>

#include "tests/robustness/fuzz/fuzz_target.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {
namespace {

/// What is written must be read again, and be the same.
void check_round_trip(const reduced_model::Trajectory& trajectory) {
  const std::string text = reduced_model::write_trajectory(trajectory);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  const reduced_model::Trajectory again =
      reduced_model::read_trajectory(file_of_bytes(bytes, text.size(), "trajectory.csv"));
  require(reduced_model::write_trajectory(again) == text,
          "a trajectory that is written and read is another one");
}

}  // namespace
}  // namespace viscontact

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace viscontact;
  reduced_model::Trajectory trajectory;
  if (!is_let_in([&] {
        trajectory = reduced_model::read_trajectory(file_of_bytes(data, size, "trajectory.csv"));
      }))
    return 0;
  check_round_trip(trajectory);
  reduced_model::Trajectory other = trajectory;
  other.model += "_again";
  for (auto& row : other.rows) row.gap /= 2;
  can_be([&] {
    const std::string text = reduced_model::write_comparison(
        reduced_model::compare_trajectories({trajectory, other}, trajectory.model));
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
    const auto again =
        reduced_model::read_comparison(file_of_bytes(bytes, text.size(), "comparison.json"));
    require(reduced_model::write_comparison(again) == text,
            "a comparison that is written and read is another");
  });
  return 0;
}
