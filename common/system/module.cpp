// Finds modules by the place of the program. The name of a module's file contains the version,
// because a program that runs while another version is installed must not load that one's module.
#include "viscontact/common/system/module.hpp"

#include <dlfcn.h>

#include <filesystem>

#include "viscontact/common/error.hpp"

namespace viscontact {

void* address_in_module(std::string_view name, const char* function) {
  namespace fs = std::filesystem;
  const auto file = fmt::format("lib/viscontact/{}-{}.so", name, VISCONTACT_VERSION);
  const auto folder = fs::read_symlink("/proc/self/exe").parent_path();
  auto path = folder / file;
  if (!fs::exists(path)) path = folder.parent_path() / file;
  // A function of a library that the module links is looked up at its first call (RTLD_LAZY), as in
  // a program, because a fit calls few of the functions that Ceres links.
  void* const module = ::dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
  void* const address = module == nullptr ? nullptr : ::dlsym(module, function);
  if (address == nullptr)
    throw Error(ErrorKind::kExternalProgram,
                "the program's module {} cannot be loaded ({}); build or install Viscontact again",
                name, ::dlerror());
  return address;
}

}  // namespace viscontact
