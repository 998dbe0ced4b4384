#include "viscontact/common/system/memory.hpp"

#include <malloc.h>

#include <cassert>

namespace viscontact {

void keep_freed_memory() {
  // Larger values of the first are not allowed. Above the second, freed memory is given back.
  constexpr int kLargestBlock = 32 << 20, kMost = 512 << 20;
  [[maybe_unused]] const bool is_set =
      mallopt(M_MMAP_THRESHOLD, kLargestBlock) == 1 && mallopt(M_TRIM_THRESHOLD, kMost) == 1;
  assert(is_set);
}

}  // namespace viscontact
