#include "tests/freefem_axi/fake_freefem.hpp"

#include <fstream>
#include <numbers>
#include <utility>

#include "tests/common/temporary_folder.hpp"

namespace viscontact::freefem_axi {

FakeFreeFem::FakeFreeFem(std::filesystem::path folder, const std::string& before)
    : folder_(std::move(folder)) {
  put_text(executable(), "#!/bin/sh\nfolder='" + folder_.string() + "'\n" + R"(
case $4 in
  *version.edp) echo "viscontact-version 0-fake"; exit 0 ;;
  *collinear_spheres.edp) is_matrix=yes ;;
esac
)" + kReadRow + before + R"(
if [ "$is_matrix" ]; then
  awk "BEGIN { a = 1 / $gap1; b = 1 / $gap2
    printf \"viscontact-entry 1 1 %.17g 1e-6\nviscontact-entry 1 2 %.17g 1e-6\n\", 19 + a, -a
    printf \"viscontact-entry 1 3 -0.5 1e-6\nviscontact-entry 2 2 %.17g 1e-6\n\", 19 + a + b
    printf \"viscontact-entry 2 3 %.17g 1e-6\nviscontact-entry 3 3 %.17g 1e-6\n\", -b, 19 + b
    print \"viscontact-result 1e-6 1000 4\" }"
  echo "$gap1 $gap2" >> "$folder/answered"
  exit 0
fi
awk "BEGIN { printf \"viscontact-result %.17g 1e-6 1000 4\n\", \
     -6 * 3.14159265358979323846 * $viscosity * $radius * ($velocity) * ($radius / $gap + 1) }"
echo "$gap $velocity" >> "$folder/answered"
)");
  make_executable(executable());
}

double FakeFreeFem::force(double radius, double viscosity, double gap, double velocity) {
  return -6 * std::numbers::pi * viscosity * radius * velocity * (radius / gap + 1);
}

std::vector<std::string> FakeFreeFem::answered() const {
  std::vector<std::string> lines;
  std::ifstream file(folder_ / "answered");
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

}  // namespace viscontact::freefem_axi
