#!/bin/sh
# Octave's str2double("1,5") is 15. One would expect 1.5, as in countries with a decimal comma, or
# NaN, which is what str2double gives for texts that are no number: commas are dropped as separators of
# thousands wherever they stand, so that a table with decimal commas is read ten to a million times
# too large.
# Packages: octave 7.3 (Debian 12) and 9.4 (Debian 13).
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
debian octave 7.3.0-2 9.4.0-1
command -v octave-cli >/dev/null || unavailable "octave-cli is not installed"

octave-cli --quiet --no-init-file --eval 'printf("%g ", str2double({"1,5", "0,001", "1,234", "1;5"})); printf("\n")' \
  >"$folder/output" 2>/dev/null
verdict "15 1 1234 NaN "
