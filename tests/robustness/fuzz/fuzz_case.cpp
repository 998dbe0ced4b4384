// Any bytes as a case file: read, and what it asks for prepared, or done if it is short.
#include <array>
#include <filesystem>
#include <string>
#include <utility>

#include "tests/robustness/fuzz/fuzz_target.hpp"
#include "viscontact/case_file/case_file.hpp"
#include "viscontact/freefem_axi/motion_table_plan.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/reduced_model/trajectory.hpp"
#include "viscontact/sweep/variation.hpp"

namespace viscontact {
namespace {

void prepare(const freefem_axi::Tabulation& tabulation) {
  for (const auto group : freefem_axi::motion_groups(tabulation))
    (void)freefem_axi::motion_table_plan(tabulation, group,
                                         [](auto) { return std::filesystem::path(); });
  (void)freefem_axi::geometry_in_words(tabulation);
  (void)freefem_axi::container_in_words(tabulation);
  for (const auto& [name, motion] : lubrication::all_motions())
    (void)freefem_axi::neighbour_ratio(tabulation, motion);
  (void)freefem_axi::leading_coefficient(tabulation);
  for (const double gap : {tabulation.gaps.front(), tabulation.gaps.back()})
    (void)freefem_axi::row_arguments(tabulation, gap, tabulation.reference_velocities.front());
}

void ask(const reduced_model::ExternalForce& force, double end) {
  for (const double time : {0.0, end / 3, end, 2 * end}) {
    (void)force.value(time);
    (void)force.slope(time);
    (void)force.impulse(time);
    (void)force.impulse_integral(time);
    (void)force.mean(time, time + end);
    (void)reduced_model::ForceWalk(force).mean(time, time + end / 7);
  }
  (void)force.jumps();
}

/// A model may refuse; a trajectory that it makes can be written and read.
void move(const case_file::Case& c) {
  const reduced_model::Motion& motion = *c.motion;
  constexpr int kManySteps = 500;  // of them a fuzzer learns nothing more
  if (reduced_model::step_count(motion.end_time,
                                motion.parameter(reduced_model::kContactTimeStep)) > kManySteps ||
      reduced_model::step_count(motion.end_time,
                                motion.parameter(reduced_model::kReferenceTimeStep)) > kManySteps)
    return;
  const auto force = lubrication::LubricationForce::exact_plane(c.viscosity, c.radius);
  for (const char* model : {"reference", "viscous_contact", "viscous_contact_exact_smooth",
                            "viscous_contact_threshold", "explicit_euler"}) {
    reduced_model::Trajectory made;
    if (!can_be([&] {
          made = reduced_model::simulate(reduced_model::find_model(model), motion, force);
        }))
      continue;
    const std::string text = reduced_model::write_trajectory(made);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
    (void)reduced_model::read_trajectory(file_of_bytes(bytes, text.size(), "trajectory.csv"));
  }
}

}  // namespace
}  // namespace viscontact

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace viscontact;
  const auto path = file_of_bytes(data, size, "case.toml");
  case_file::Case c;
  if (!is_let_in([&] { c = case_file::read_case(path); })) return 0;
  if (c.tabulation) prepare(*c.tabulation);
  if (c.motion) {
    can_be([&] { ask(c.motion->external_force, c.motion->end_time); });
    can_be([&] { move(c); });
  }
  if (c.fit && c.fit->file) can_be([&] { (void)lubrication::read_fit(*c.fit->file); });
  // As a sweep makes a case of each point.
  const case_file::CaseTemplate<case_file::Case> pattern(path);
  const std::array fluid = {std::pair<std::string, double>{"fluid.viscosity", 2.5}};
  can_be([&] { (void)pattern.with(fluid); });
  if (!c.sweep) return 0;
  for (const auto& text : c.sweep->vary)
    can_be([&] {
      const auto variation = sweep::parse_variation(text);
      const std::array point = {std::pair{variation.key, variation.value(variation.count - 1)}};
      (void)pattern.with(point);
    });
  return 0;
}
