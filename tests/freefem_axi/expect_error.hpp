// The one way to fail, expected.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "common/error.hpp"

namespace viscontact {

/// Expects `action()` to throw an Error of that exit code whose message satisfies `message`.
template <class Action>
void expect_error(const Action& action, ExitCode exit_code,
                  const ::testing::Matcher<std::string>& message) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), exit_code);
    EXPECT_THAT(std::string(error.what()), message);
    return;
  }
  FAIL() << "no Error was thrown";
}

}  // namespace viscontact
