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
esac
)" + kReadRow + before + R"(
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
