#include "viscontact/particles/setting/lubrication_faults.hpp"

#include <fmt/core.h>

#include "viscontact/particles/steps/step_times.hpp"

namespace viscontact::particles {
namespace {

std::optional<SettingFault> fault_of_gradient(const Gradient& gradient, const Vector& periods) {
  constexpr std::string_view kAxes = "xyz";
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (periods[j] > 0 && gradient[i][j] != 0 && !(i == 0 && j == 1))
        return SettingFault{
            "strain_rate",
            fmt::format("makes the velocity along {} change along {}, which is not possible with a "
                        "period there and walls elsewhere; only that along x may change, along y "
                        "(shear_rate), or domain.box.periodic must be true along all axes",
                        kAxes[i], kAxes[j])};
  if (periods[1] > 0 && !(periods[0] > 0) && gradient[0][1] != 0)
    return SettingFault{"shear_rate",
                        "moves the images across the period y along x, where the box has walls; "
                        "domain.box.periodic must be true along x, too"};
  return {};
}

}  // namespace

std::optional<SettingFault> fault_of_flow(const PairLubrication& pairs, const Domain& domain) {
  if (strains_cell(pairs, domain)) return {};
  const auto periods = periods_of(domain);
  auto fault = fault_of_gradient(pairs.gradient, periods);
  for (const auto& piece : pairs.pieces)
    if (!fault) fault = fault_of_gradient(piece.gradient, periods);
  return fault;
}

std::optional<SettingFault> fault_of_stress(const PairLubrication& pairs, bool has_walls) {
  if (!pairs.stress || !has_walls) return {};
  return SettingFault{
      "stress",
      "needs a box without walls, because walls would move at a rate that is a result; "
      "domain.box.periodic must be true along all axes"};
}

std::optional<SettingFault> fault_of_inertia(const PairLubrication& pairs, const Domain& domain) {
  if (!pairs.inertia) return {};
  if (pairs.stress)
    return SettingFault{"inertia",
                        "is true, and velocity has a stress; with inertia the rate must be given"};
  if (!accelerates_images_alike(pairs, domain))
    return SettingFault{
        "inertia",
        "is true in a flow that accelerates the fluid otherwise at a sphere than at its "
        "images; along the periods of the box the flow must be at rest or a shear of "
        "constant rate, or the case must have no such periods"};
  return {};
}

std::optional<SettingFault> fault_of_planes(const PairLubrication& pairs, const Domain& domain) {
  if (strains_cell(pairs, domain))
    return SettingFault{
        "normal",
        "belongs to a plane in a box with three periods whose flow is no shear along x "
        "that changes along y; the case must have one of both"};
  if (pairs.stress)
    return SettingFault{"normal",
                        "belongs to a plane beside lubrication.velocity.stress, whose rate is a "
                        "result; beside planes the rate of the flow must be given"};
  return {};
}

std::optional<SettingFault> fault_of_periods(const Domain& domain, double pair_length) {
  for (const double period : periods_of(domain))
    if (period > 0 && !(period >= 2 * pair_length))
      return SettingFault{
          "to", fmt::format("makes the period {:.6g}, which is too short for the range of "
                            "lubrication and the largest radius; it must be at least {:.6g}, twice "
                            "the largest distance of a pair",
                            period, 2 * pair_length)};
  return {};
}

std::optional<SettingFault> fault_of_piece(double length, double h) {
  const double least = StepGrid::least_piece(h);
  if (length >= least) return {};
  return SettingFault{"until",
                      fmt::format("makes a piece of the length {:.6g}; it must be at least {:.6g} "
                                  "long, because steps pass by a shorter one",
                                  length, least)};
}

}  // namespace viscontact::particles
