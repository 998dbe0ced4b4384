#!/bin/sh
# A vector of four doubles, `vector_size(32)`, in C++. GCC 12 lays it out at multiples of 32 bytes in a struct,
# and its own operator __alignof__ says 32; but the standard operator alignof says 16 unless the file is
# compiled for AVX, also of a struct that contains the vector. `new` and std::vector choose their memory by
# alignof, so that such a struct stands at multiples of 16 only. A function for AVX in the same file, made by the
# attribute `target`, takes the 32 for granted. Clang 14 has 32 everywhere.
# Packages: g++-12 12.2.0, clang-14 14.0.6 (Debian 12).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian g++-12 12.2.0-14+deb12u1
debian clang-14 1:14.0.6-12
program g++-12
program clang++-14

cat >"$folder/vector.cpp" <<'END_OF_SOURCE'
#include <cstddef>
#include <cstdio>
using Vector [[gnu::vector_size(32)]] = double;
struct Body {
  double mass;
  Vector place;
};
int main() {
  std::printf("alignof %zu, __alignof__ %zu; in a struct at %zu, whose alignof is %zu\n", alignof(Vector),
              __alignof__(Vector), offsetof(Body, place), alignof(Body));
}
END_OF_SOURCE
for compiler in g++-12 clang++-14; do
  for option in -O1 -mavx; do
    "$compiler" -std=c++17 "$option" "$folder/vector.cpp" -o "$folder/vector" 2>/dev/null ||
      unavailable "$compiler $option does not compile here"
    echo "$compiler $option: $("$folder/vector")"
  done
done >"$folder/output"
verdict "g++-12 -O1: alignof 16, __alignof__ 32; in a struct at 32, whose alignof is 16
g++-12 -mavx: alignof 32, __alignof__ 32; in a struct at 32, whose alignof is 32
clang++-14 -O1: alignof 32, __alignof__ 32; in a struct at 32, whose alignof is 32
clang++-14 -mavx: alignof 32, __alignof__ 32; in a struct at 32, whose alignof is 32"
