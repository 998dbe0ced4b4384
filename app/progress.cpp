#include "app/progress.hpp"

#include <unistd.h>

#include <cstdio>

namespace viscontact {
namespace {

constexpr const char* kEraseLine = "\r\033[K";

}  // namespace

void show_progress(const std::string& text) {
  if (::isatty(STDERR_FILENO) == 0) return;
  std::fputs((kEraseLine + text).c_str(), stderr);
  std::fflush(stderr);
}

void clear_progress() { show_progress(""); }

// Nobody may be listening (a closed or full standard error): then the words are lost, not the work.
void say(const std::string& text) { std::fputs((text + "\n").c_str(), stderr); }

}  // namespace viscontact
