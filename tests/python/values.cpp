// Prints numbers that the libraries compute, as hexadecimal floating-point numbers, which keep all
// bits. The tests of the Python module compare them with its own.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/contact_dynamics/simulation.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/motions/pair_fit.hpp"
#include "viscontact/particle_runs/case/particles_case.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/rolling/case/rolling_case.hpp"

namespace viscontact {
namespace {

// The words of the command line:
//
//   python_values fit FILE GAP...            for each gap: R, Gamma
//   python_values pair FILE GAP...           for each gap: the entries
//   python_values simulate CASE FIT MODEL    for each row: time, gap, velocity
//   python_values rolling CASE MODEL         for each row: time, gap, position, angular velocity
//   python_values particles CASE STEPS       for each particle: position, velocity after the steps

void print(std::initializer_list<double> numbers) {
  for (const double number : numbers) std::printf("%a ", number);
  std::printf("\n");
}

void print_values(const std::vector<std::string>& words) {
  const auto& what = words.at(0);
  const auto& file = words.at(1);
  const auto number = [&](std::size_t i) { return std::strtod(words.at(i).c_str(), nullptr); };
  if (what == "fit") {
    const lubrication::LubricationForce force(lubrication::read_fit(file));
    for (std::size_t i = 2; i < words.size(); ++i)
      print({force.resistance(number(i)), force.impulse(number(i))});
  } else if (what == "pair") {
    const auto fit = motions::read_pair_fit(file);
    for (std::size_t i = 2; i < words.size(); ++i) {
      for (std::size_t e = 0; e < motions::pair_entries().size(); ++e)
        if (const auto entry = static_cast<motions::PairEntry>(e); fit.entries.contains(entry))
          std::printf("%a ", motions::entry_value(fit, entry, number(i)));
      std::printf("\n");
    }
  } else if (what == "simulate") {
    const auto c = case_file::read_case(file);
    const lubrication::LubricationForce force(lubrication::read_fit(words.at(2)),
                                              c.fit.value().outside);
    const auto trajectory =
        reduced_model::simulate(reduced_model::find_model(words.at(3)), c.motion.value(), force);
    for (const auto& row : trajectory.rows) print({row.time, row.gap, row.velocity});
  } else if (what == "rolling") {
    const auto c = rolling::read_rolling_case(file);
    const auto fit = rolling::fit_for(c, motions::read_pair_fit(c.fit.value()), c.fit.value());
    for (const auto& model : rolling::rolling_models())
      if (model.name == words.at(2))
        for (const auto& row : model.run(c.motion, fit))
          print({row.time, row.gap, row.position, row.angular_velocity});
  } else if (what == "particles") {
    auto c = particles::read_particles_case(file);
    particles::State state;
    state.particles = c.particles;
    particles::Simulation simulation(c.setting, std::move(state), 1);
    for (int n = std::stoi(words.at(2)); n > 0; --n) (void)simulation.step(c.end_time);
    const auto& p = simulation.state().particles;
    for (std::size_t k = 0; k < p.count(); ++k) {
      const auto x = p.position(k), v = p.velocity(k);
      for (int d = 0; d < p.dimension; ++d) std::printf("%a ", x[static_cast<std::size_t>(d)]);
      for (int d = 0; d < p.dimension; ++d) std::printf("%a ", v[static_cast<std::size_t>(d)]);
      std::printf("\n");
    }
  }
}

}  // namespace
}  // namespace viscontact

int main(int argc, char** argv) {
  try {
    viscontact::print_values({argv + 1, argv + argc});
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
