#include "viscontact/common/files/descriptor.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <utility>

namespace viscontact {
namespace {

int open_something() { return ::open("/", O_RDONLY | O_CLOEXEC); }

bool is_open(int descriptor) { return ::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF; }

TEST(Descriptor, ClosesItselfAtTheEndOfItsScope) {
  const int number = open_something();
  ASSERT_GE(number, 0);
  {
    const Descriptor descriptor(number);
    EXPECT_EQ(descriptor.get(), number);
    EXPECT_TRUE(is_open(number));
  }
  EXPECT_FALSE(is_open(number));
}

TEST(Descriptor, WithoutAFileHoldsNothing) {
  const Descriptor descriptor;
  EXPECT_EQ(descriptor.get(), -1);
}

TEST(Descriptor, ClosedTwiceClosesNobodyElsesFile) {
  Descriptor first(open_something());
  const int number = first.get();
  first.close();
  EXPECT_EQ(first.get(), -1);
  const Descriptor second(open_something());
  ASSERT_EQ(second.get(), number) << "the system gives the lowest free number";
  first.close();
  EXPECT_TRUE(is_open(number));
}

TEST(Descriptor, MovedFromLeavesTheFileToTheOtherOne) {
  const int number = open_something();
  Descriptor to;
  {
    Descriptor from(number);
    Descriptor between(std::move(from));
    EXPECT_EQ(between.get(), number);
    to = std::move(between);
  }
  EXPECT_EQ(to.get(), number);
  EXPECT_TRUE(is_open(number));
}

TEST(Descriptor, AssignedOverClosesItsOwnFileToo) {
  const int number = open_something();
  {
    Descriptor to(number);
    Descriptor from(open_something());
    to = std::move(from);
    EXPECT_NE(to.get(), number);
  }
  EXPECT_FALSE(is_open(number));
}

}  // namespace
}  // namespace viscontact
