#include "viscontact/common/text/base64.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace viscontact {
namespace {

std::string encoded(const std::string& text) { return to_base64(std::as_bytes(std::span(text))); }

TEST(Base64, HasTheTestVectorsOfRfc4648) {
  for (const auto& [text, in_base64] :
       std::initializer_list<std::pair<std::string, std::string>>{{"", ""},
                                                                  {"f", "Zg=="},
                                                                  {"fo", "Zm8="},
                                                                  {"foo", "Zm9v"},
                                                                  {"foob", "Zm9vYg=="},
                                                                  {"fooba", "Zm9vYmE="},
                                                                  {"foobar", "Zm9vYmFy"}}) {
    EXPECT_EQ(encoded(text), in_base64);
    EXPECT_EQ(from_base64(in_base64), text);
    EXPECT_EQ(base64_size(text.size()), in_base64.size());
  }
}

TEST(Base64, GivesAllBytesBack) {
  std::string bytes;
  for (int k = 0; k < 256; ++k) {
    EXPECT_EQ(from_base64(encoded(bytes)), bytes);
    bytes += static_cast<char>(k);
  }
  EXPECT_EQ(from_base64("+/+/"), "\xfb\xff\xbf");
}

TEST(Base64, RefusesOtherTexts) {
  for (const char* text : {"Z", "Zg", "Zg=", "Zg=a", "Z===", "Zm9v\n", "Zm-v", "Zm9vYg== "})
    EXPECT_FALSE(from_base64(text)) << text;
}

}  // namespace
}  // namespace viscontact
