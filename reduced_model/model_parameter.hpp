// Describes the parameters of models of motion: numbers of the case file that a model declares, in
// the units of the case. A new parameter is declared beside its model and in no other file, but a
// parameter of several models in motion.hpp. The reader of case files, the documentation of their
// keys, sweeps and the report find all parameters in the table of models (models.cpp). Nothing is
// checked or thrown here; the reader of case files refuses values that are not allowed. A change
// must keep the keys, which users' case files contain. Descriptions are free choices; another
// fallback changes the results of cases without the key.
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
  std::string_view description;  ///< words for the report
  std::string_view dimension;    ///< dimension of the values, "L", "T" or "1"; for the report
  Allowed allowed;               ///< the finite values that are accepted
  /// Function for the value in a case without this key; never null. `allowed` must accept the
  /// value. The value must not depend on Motion::parameters, which are not set yet. `radius` > 0 is
  /// the radius of the sphere [L].
  double (*fallback)(const Motion& motion, double radius);
  /// True for a time step: it must be at most Motion::end_time, and the key motion.time_scale of a
  /// case multiplies it.
  bool is_time_step = false;
  /// The fallback in words, for docs/case-file.md.
  std::string_view fallback_words = "see the model";

  constexpr std::string_view section() const { return section_of(key); }  ///< section_of(key)
  constexpr std::string_view name() const { return name_of(key); }        ///< name_of(key)
};

}  // namespace viscontact::reduced_model
