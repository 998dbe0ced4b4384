// Expects an Error with its kind and message, for tests of tabulations.
#pragma once

#include <gmock/gmock.h>

#include <string>

#include "tests/common/failure.hpp"

namespace viscontact::freefem_axi {

/// Expects `action()` to throw an Error of this kind whose message satisfies `message`.
template <class Action>
void expect_error(const Action& action, ErrorKind kind,
                  const ::testing::Matcher<std::string>& message) {
  EXPECT_THAT(failure(kind, action), message);
}

}  // namespace viscontact::freefem_axi
