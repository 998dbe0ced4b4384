// Calls what must fail, and returns the message of its Error, for tests of messages.
#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <string>

#include "viscontact/common/error.hpp"

namespace viscontact {

/// The message of the Error of this kind that `call` throws. Anything else fails the test and gives
/// "".
template <class Call>
std::string failure(ErrorKind kind, Call&& call) {
  try {
    call();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << "not a viscontact::Error: " << error.what();
  }
  return "";
}

/// failure() of the usual kind, Error(kBadInput).
template <class Call>
std::string bad_input(Call&& call) {
  return failure(ErrorKind::kBadInput, call);
}

}  // namespace viscontact
