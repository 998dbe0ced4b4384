#include "tests/freefem_axi/scratch_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <system_error>

namespace viscontact {

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "viscontact_test_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw std::system_error(errno, std::generic_category(), name);
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;  // a destructor may not throw; a left folder harms nobody
  std::filesystem::remove_all(path_, ignored);
}

void put_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::system_error(errno, std::generic_category(), path.string());
}

void make_executable(const std::filesystem::path& path) {
  std::filesystem::permissions(path, std::filesystem::perms::owner_exec,
                               std::filesystem::perm_options::add);
}

}  // namespace viscontact
