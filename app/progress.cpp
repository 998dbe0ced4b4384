#include "app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace viscontact {
namespace {

constexpr const char* kEraseLine = "\r\033[K";

}  // namespace

void show_progress(const std::string& text) {
  if (::isatty(STDERR_FILENO) == 0) return;
  fmt::print(stderr, "{}{}", kEraseLine, text);
  std::fflush(stderr);
}

void clear_progress() { show_progress(""); }

void say(const std::string& text) { fmt::print(stderr, "{}\n", text); }

}  // namespace viscontact
