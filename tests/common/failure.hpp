// Calls what must fail, and matches the Error by its facts: kind, file, line and key.
#pragma once

#include <gmock/gmock.h>

#include <exception>
#include <ostream>
#include <string>

#include "tests/common/names.hpp"
#include "viscontact/common/error.hpp"

namespace viscontact {

/// What GoogleTest shows of an Error.
inline std::ostream& operator<<(std::ostream& out, const Error& error) {
  return out << error.what();
}

/// Expects that the message of an Error names the file, the line and the key that it carries.
inline void expect_named_place(const Error& error) {
  const auto at = error.at();
  const std::string message = error.what();
  EXPECT_TRUE(at.file.empty() || message.find(located(at, "")) != std::string::npos) << message;
  EXPECT_NE(message.find(at.key), std::string::npos) << message << ", key " << at.key;
}

/// The Error of this kind that `call` throws. Anything else fails the test and gives an Error with
/// an empty message.
template <class Call>
Error failure(ErrorKind kind, Call&& call) {
  try {
    call();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    expect_named_place(error);
    return error;
  } catch (const std::exception& error) {
    ADD_FAILURE() << "not a viscontact::Error: " << error.what();
  }
  return {kind, ""};
}

/// failure() of the usual kind, Error(kBadInput).
template <class Call>
Error bad_input(Call&& call) {
  return failure(ErrorKind::kBadInput, call);
}

/// Matches an Error at `place`, "FILE" or "FILE:LINE" with or without the folder, whose key is
/// `key`. Any line matches a FILE, and any key an empty one.
MATCHER_P2(IsAt, place, key, "is at " + std::string(place) + ", key '" + std::string(key) + "'") {
  const FilePosition at = arg.at();
  const std::string expected(place);
  const auto is_expected = [&](const std::string& here) {
    return here == expected || here.ends_with("/" + expected);
  };
  const auto line = at.file + ":" + std::to_string(at.line);
  *result_listener << "which is at " << line << ", key '" << at.key << "'";
  return (is_expected(line) || is_expected(at.file)) &&
         (std::string(key).empty() || at.key == std::string(key));
}
template <class Place>
auto IsAt(const Place& place) {
  return IsAt(std::string(place), std::string());
}

}  // namespace viscontact
