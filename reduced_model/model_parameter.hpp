// A parameter of models of motion: a number of the case file that a model declares beside it.
#pragma once

#include <string_view>

#include "viscontact/common/allowed.hpp"

namespace viscontact::reduced_model {

struct Motion;

/// The part SECTION of a key SECTION.NAME in the case file; without a point, the whole key.
constexpr std::string_view section_of(std::string_view key) { return key.substr(0, key.find('.')); }
/// The part NAME; without a point, the whole key.
constexpr std::string_view name_of(std::string_view key) { return key.substr(key.find('.') + 1); }

/// A parameter of one or several models of motion. A model lists its parameters in its row of the
/// table of models and reads their values by Motion::parameter().
struct ModelParameter {
  std::string_view key;          ///< SECTION.NAME in the case file
  std::string_view description;  ///< words for the report
  std::string_view dimension;    ///< "L", "T" or "1"
  Allowed allowed;               ///< values that are accepted
  /// Function for the value in a case without this key; never null. `allowed` must accept the
  /// value. The value must not depend on Motion::parameters, which are not set yet. `radius` > 0 is
  /// the radius of the sphere [L].
  double (*fallback)(const Motion& motion, double radius);
  /// True for a time step: it must be at most Motion::end_time, and the key motion.time_scale of a
  /// case multiplies it.
  bool is_time_step = false;
  /// The fallback in words, for docs/case-file.md.
  std::string_view fallback_words = "see the model";

  constexpr std::string_view section() const { return section_of(key); }  ///< of `key`
  constexpr std::string_view name() const { return name_of(key); }        ///< of `key`
};

}  // namespace viscontact::reduced_model
