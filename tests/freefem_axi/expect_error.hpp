// Expects an Error with its kind, for tests of tabulations.
#pragma once

#include <gmock/gmock.h>

#include <string>

#include "tests/common/failure.hpp"

namespace viscontact::freefem_axi {

/// Expects `action()` to throw an Error of this kind that satisfies `error`.
template <class Action>
void expect_error(const Action& action, ErrorKind kind,
                  const ::testing::Matcher<const Error&>& error) {
  EXPECT_THAT(failure(kind, action), error);
}

}  // namespace viscontact::freefem_axi
