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

cat >"$folder/page.html" <<'END'
<html><body><div id="plots"></div><pre id="out"></pre>
<script src="node_modules/uplot/dist/uPlot.iife.min.js"></script>
<script>
const plot = new uPlot({width: 800, height: 400, scales: {x: {time: false}, y: {distr: 3}}, series: [{}, {stroke: "red"}]},
                       [[1, 2, 3, 4], [1, 0, -5, 100]], document.getElementById("plots"));
setTimeout(() => {
  const {min, max} = plot.scales.y, place = (y) => plot.valToPos(y, "y").toFixed(1);
  document.getElementById("plots").remove();
  document.getElementById("out").textContent = `\naxis from ${min} to ${max}\n` +
    `0 and -5 are drawn where ${min / 10} is: ${place(0) === place(min / 10) && place(-5) === place(min / 10)}\n`;
}, 100);
</script></body></html>
END
browser "$folder/page.html" >"$folder/output"
verdict "axis from 1 to 100
0 and -5 are drawn where 0.1 is: true"
