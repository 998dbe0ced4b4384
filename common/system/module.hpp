// Modules: shared libraries that belong to the program, which loads one when it first calls a
// function of it. A module links a library that takes long to load and that few commands need.
#pragma once

#include <string_view>

namespace viscontact {

/// The address of the function `function` of the module `name`, a file of the folder lib/viscontact
/// beside the program (build tree) or one folder above it (installed). The module stays loaded.
/// Throws Error(kExternalProgram) if the module is missing, if the system cannot load it, or if it
/// lacks the function.
void* address_in_module(std::string_view name, const char* function);

/// The same address as a pointer to a function of the type `Function`.
template <class Function>
Function* function_of_module(std::string_view name, const char* function) {
  return reinterpret_cast<Function*>(address_in_module(name, function));
}

}  // namespace viscontact
