#!/bin/sh
# A logarithmic axis has no place for 0 and for negative numbers. One would expect that uPlot leaves them
# out, as gnuplot does, or leaves a gap. It draws both as if they were a tenth of the lower end of the axis,
# so that a curve that reaches 0, or changes its sign, dives below the plot at the same finite place.
# Packages: uplot 1.6.32 (npm), in Debian's chromium of any version.
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
npm_package uplot 1.6.32

browser node_modules/uplot/dist/uPlot.iife.min.js >"$folder/output" <<'END'
const plot = new uPlot({width: 800, height: 400, scales: {x: {time: false}, y: {distr: 3}}, series: [{}, {stroke: "red"}]},
                       [[1, 2, 3, 4], [1, 0, -5, 100]], plots);
setTimeout(() => {
  const {min, max} = plot.scales.y, place = (y) => plot.valToPos(y, "y").toFixed(1);
  const low = place(min / 10);
  show([`axis from ${min} to ${max}`,
        `0 and -5 are drawn where ${min / 10} is: ${place(0) === low && place(-5) === low}`]);
}, 100);
END
verdict "axis from 1 to 100
0 and -5 are drawn where 0.1 is: true"
