// Any bytes as a fit file: read, written, read again, evaluated, exported.
#include <cmath>
#include <string>

#include "tests/robustness/fuzz/fuzz_target.hpp"
#include "viscontact/fitting/export/export_fit.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"

namespace viscontact {
namespace {

void check_round_trip(const lubrication::Fit& fit) {
  const std::string text = lubrication::write_fit(fit);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  const lubrication::Fit again =
      lubrication::read_fit(file_of_bytes(bytes, text.size(), "fit.json"));
  require(lubrication::write_fit(again) == text, "a fit that is written and read is another one");
}

/// Where the force says that it may be asked, it answers with a number or refuses.
void evaluate(const lubrication::LubricationForce& force, const lubrication::Fit& fit) {
  const auto [smallest, largest] = fit.gap_interval;
  for (const double gap : {smallest, std::lerp(smallest, largest, 0.5), largest, smallest / 2,
                           largest * 2, fit.radius}) {
    can_be([&] {
      require(std::isfinite(force.resistance(gap)), "a resistance is no number");
      (void)force.resistance_log_slope(gap);
      (void)force.regular_resistance(gap);
      (void)force.regular_impulse(gap);
      const double impulse = force.impulse(gap);
      const double back = force.gap_of_impulse(impulse);
      require(back >= force.interval()[0] && back <= force.interval()[1],
              "an impulse within the interval has a gap without");
    });
  }
  can_be([&] { (void)force.leading_coefficient(); });
}

}  // namespace
}  // namespace viscontact

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace viscontact;
  lubrication::Fit fit;
  if (!is_let_in([&] { fit = lubrication::read_fit(file_of_bytes(data, size, "fit.json")); }))
    return 0;
  check_round_trip(fit);
  can_be([&] { evaluate(lubrication::LubricationForce(fit), fit); });
  can_be([&] {
    evaluate(lubrication::LubricationForce(fit, lubrication::OutsideInterval{}.with_limits()), fit);
  });
  can_be([&] {
    evaluate(lubrication::LubricationForce(fit, {lubrication::BelowInterval::kTheoryLimit}), fit);
  });
  for (const auto& target : fitting::export_targets())
    can_be([&] {
      (void)fitting::export_fit(lubrication::with_viscosity(fit, fit.viscosity / 3), target.name);
    });
  return 0;
}
