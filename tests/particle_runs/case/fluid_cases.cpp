// Texts of cases of particles in a fluid, for the tests of their keys.
#include "tests/particle_runs/case/fluid_cases.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <stdexcept>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"

namespace viscontact::particles {

const std::string_view kDiscsInDisc = R"(title = "Two discs in a round container"
[space]
dimension = 2
[fluid]
viscosity = 2.0
[domain]
disc = { centre = [0.5, 0.0], radius = 8.0 }
[viscous_contact]
time_step = 0.01
end_time = 1.0
[[particle]]
centre = [0.0, 0.0]
radius = 1.0
force = [0.0, -1.0]
[[particle]]
centre = [3.0, 0.0]
radius = 0.5
mass = 2.0
)";

const std::string_view kDiscsInBox = R"(title = "Two discs in a box"
[space]
dimension = 2
[fluid]
viscosity = 2.0
[domain]
box = { from = [0.0, 0.0], to = [2.0, 6.0] }
[viscous_contact]
time_step = 0.01
end_time = 1.0
[[particle]]
centre = [0.5, 1.0]
radius = 0.25
[[particle]]
centre = [1.2, 3.0]
radius = 0.25
)";

const std::string_view kSpheresOnAxis = R"(title = "Two spheres settle in a cylinder"
[space]
dimension = "axisymmetric"
gravity = [-1.0]
[fluid]
viscosity = 2.0
[domain]
cylinder = { radius = 5.0, height = 10.0 }
[viscous_contact]
time_step = 0.01
end_time = 1.0
[[particle]]
centre = [2.0]
radius = 1.0
mass = 1.0
[[particle]]
centre = [6.0]
velocity = [-0.5]
radius = 0.5
force = [ { until = 0.5, value = [2.0] }, { until = 1.0, value = [3.0] } ]
)";

const std::string_view kDryDiscs = R"(title = "Two discs"
[space]
dimension = 2
[viscous_contact]
time_step = 0.01
end_time = 1.0
[[particle]]
centre = [0.5, 1.0]
radius = 0.25
mass = 1.0
[[particle]]
centre = [1.2, 3.0]
radius = 0.25
mass = 1.0
)";

std::string changed(std::string_view text, std::string_view from, std::string_view to) {
  std::string result(text);
  const auto at = result.find(from);
  if (at == std::string::npos) throw std::logic_error("not in the case: " + std::string(from));
  return result.replace(at, from.size(), to);
}

ParticlesCase read_particles_text(const std::string& text) {
  const TemporaryFolder folder;
  return read_particles_case(folder.file("case.toml", text));
}

void expect_refused_at(const std::string& text, std::string_view at, const std::string& key,
                       const std::vector<std::string>& names) {
  const auto position = text.find(at);
  if (position == std::string::npos) throw std::logic_error("not in the case: " + std::string(at));
  const auto line =
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n');
  EXPECT_THAT(bad_input([&] { (void)read_particles_text(text); }),
              ::testing::AllOf(IsAt("case.toml:" + std::to_string(line), key), NamesAll(names)));
}

}  // namespace viscontact::particles
