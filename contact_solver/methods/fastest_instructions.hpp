// Loops that are compiled once more for the vectors and fused operations of newer processors.
#pragma once

namespace viscontact::contact_solver {

// The program must run on processors that have neither. These functions therefore make GCC compile
// `work`, with all that it calls, once more. Clang compiles only the first call anew.
#ifdef __x86_64__
template <class Work>
[[gnu::target("avx512f,fma"), gnu::flatten]] auto with_avx512(const Work& work) {
  return work();
}
template <class Work>
[[gnu::target("avx2,fma"), gnu::flatten]] auto with_avx2(const Work& work) {
  return work();
}
#endif

/// Returns work() by the fastest instructions of this processor. The results of two kinds of
/// processor differ by rounding errors. The source must be compiled with -ffp-contract=fast.
template <class Work>
auto by_fastest_instructions(const Work& work) {
#ifdef __x86_64__
  const bool has_fma = __builtin_cpu_supports("fma");
  if (has_fma && __builtin_cpu_supports("avx512f")) return with_avx512(work);
  if (has_fma && __builtin_cpu_supports("avx2")) return with_avx2(work);
#endif
  return work();
}

}  // namespace viscontact::contact_solver
