#!/bin/sh
# In FreeFEM 2^-1 is 0 and 2.^-1 is 0.5. That 1/2 of whole numbers is 0 is known from C; but the power
# of two whole numbers is also computed in real numbers and then cut to a whole number, so that a
# viscosity written as 10^-3 is 0, without a word.
# Packages: freefem++ 4.11 (Debian 12) and 4.15 (Debian 13).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian freefem++ 4.11+dfsg1-3 4.11+dfsg1-2 4.15+dfsg-1
command -v FreeFem++ >/dev/null || unavailable "FreeFem++ is not installed"

echo 'cout << "2^-1 " << 2^-1 << ", 10^-3 " << 10^-3 << ", 2.^-1 " << 2.^-1 << ", 2^0.5 " << 2^0.5 << endl;' \
  >"$folder/power.edp"
FreeFem++ -nw -v 0 "$folder/power.edp" >"$folder/output" 2>&1
verdict "2^-1 0, 10^-3 0, 2.^-1 0.5, 2^0.5 1.41421"
