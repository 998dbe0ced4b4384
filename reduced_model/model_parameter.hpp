// Parameters of models of motion: numbers of the case file that a model declares, in the units of
// the case. A new parameter is declared beside its model and in no other file; a parameter of
// several models is in motion.hpp. The reader of case files, their documentation, sweeps and the
// report find it in the table of models (models.cpp). Nothing is thrown. A change must keep the
// keys, which users' case files contain.
#pragma once

#include <string_view>

#include "viscontact/common/allowed.hpp"

namespace viscontact::reduced_model {

struct Motion;

/// The part SECTION of a key SECTION.NAME in the case file; without a point, the whole key.
constexpr std::string_view section_of(std::string_view key) { return key.substr(0, key.find('.')); }
/// The part NAME of a key SECTION.NAME in the case file; without a point, the whole key.
constexpr std::string_view name_of(std::string_view key) { return key.substr(key.find('.') + 1); }

/// A parameter of one or several models of motion. A model lists its parameters in its row of the
/// table of models and reads their values by Motion::parameter().
struct ModelParameter {
  std::string_view key;          ///< SECTION.NAME in the case file
  std::string_view description;  ///< for the report
  std::string_view dimension;    ///< dimension of the values, such as "L"; for the report
  Allowed allowed;               ///< the finite values that are accepted
  /// Value for a case without this key, one that `allowed` accepts; never null. It must not depend
  /// on parameters of `motion`, which are not set yet; `radius` > 0 is that of the sphere [L].
  double (*fallback)(const Motion& motion, double radius);
  /// True for a time step: it must be at most Motion::end_time, and the key motion.time_scale of a
  /// case multiplies it.
  bool is_time_step = false;
  /// The fallback in words, for docs/case-file.md.
  std::string_view fallback_words = "see the model";

  constexpr std::string_view section() const { return section_of(key); }  ///< SECTION of `key`
  constexpr std::string_view name() const { return name_of(key); }        ///< NAME of `key`
};

}  // namespace viscontact::reduced_model
