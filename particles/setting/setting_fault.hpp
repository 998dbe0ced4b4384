// Why a simulation cannot have a setting.
#pragma once

#include <string>
#include <string_view>

namespace viscontact::particles {

struct SettingFault {
  std::string_view key;  ///< of the case
  std::string message;   ///< goes on after the name of the key
};

}  // namespace viscontact::particles
