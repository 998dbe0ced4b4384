// Any bytes as a force table: read, written, read again, fitted.
#include <numeric>
#include <string>

#include "tests/robustness/fuzz/fuzz_target.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact {
namespace {

void check_round_trip(const lubrication::MotionTable& table) {
  const std::string text = lubrication::write_motion_table(table);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  const lubrication::MotionTable again =
      lubrication::read_force_table(file_of_bytes(bytes, text.size(), "table.csv"));
  require(lubrication::write_motion_table(again) == text,
          "a table that is written and read is another one");
}

/// A fit that comes out must be one that `simulate` can read.
void fit(const lubrication::MotionTable& table, const fitting::FitSettings& settings) {
  lubrication::Fit made;
  if (!can_be([&] { made = fitting::fit_force_table(table, settings); })) return;
  const std::string text = lubrication::write_fit(made);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  (void)lubrication::read_fit(file_of_bytes(bytes, text.size(), "fit.json"));
}

}  // namespace
}  // namespace viscontact

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace viscontact;
  lubrication::MotionTable table;
  if (!is_let_in(
          [&] { table = lubrication::read_force_table(file_of_bytes(data, size, "table.csv")); }))
    return 0;
  check_round_trip(table);
  // A fit costs as much as some hundred readings: a sixteenth of the tables are fitted, chosen by
  // their bytes.
  if (std::accumulate(data, data + size, 0U) % 16 != 0) return 0;
  fit(table, {});
  fitting::FitSettings other;
  other.basis = lubrication::find_basis("asymptotic");
  other.weights = lubrication::Weights::kAbsolute;
  other.loss = lubrication::Loss::kHuber;
  other.fix_leading = table.leading_coefficient.has_value();
  fit(table, other);
  return 0;
}
