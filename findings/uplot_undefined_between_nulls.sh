#!/bin/sh
# In the data of uPlot null is a gap and undefined is a place without a value of this curve. One would
# expect that what lies between two nulls stays empty. It does if all of it is null, or if single
# undefined places stand between the nulls; several undefined places between two nulls are spanned by a line,
# from the first of them to the last.
# Packages: uplot 1.6.32 (npm), in Debian's chromium of any version.
set -eu
cd "$(dirname "$0")"
# shellcheck source-path=SCRIPTDIR
. ./packages
npm_package uplot 1.6.32

browser node_modules/uplot/dist/uPlot.iife.min.js >"$folder/output" <<'END'
const lines = [];
const none = undefined;
for (const [name, ys] of [["nulls", [1, 2, null, null, null, null, null, 3, 4]],
                          ["one undefined", [1, 2, null, null, none, null, null, 3, 4]],
                          ["three undefined", [1, 2, null, none, none, none, null, 3, 4]]]) {
  const plot = new uPlot({width: 800, height: 400, scales: {x: {time: false}}, axes: [{show: false}, {show: false}],
                          series: [{}, {stroke: "red", width: 2, points: {show: false}}]},
                         [ys.map((_, k) => k + 1), ys], plots);
  setTimeout(() => {
    const {width, height} = plot.ctx.canvas, pixels = plot.ctx.getImageData(0, 0, width, height).data;
    const [begin, end] = [2.05, 7.95].map((x) => Math.round(plot.valToPos(x, "x", true)));
    let drawn = 0;
    for (let x = begin; x < end; ++x) {
      let red = false;
      for (let y = 0; y < height; ++y) {
        const i = 4 * (y * width + x);
        red ||= pixels[i] > 150 && pixels[i + 1] < 100 && pixels[i + 3] > 100;
      }
      drawn += red;
    }
    lines.push(`${name}: a line in ${Math.round(10 * drawn / (end - begin)) * 10} % of the interval`);
  }, 20);
}
setTimeout(() => show(lines), 300);
END
verdict "nulls: a line in 0 % of the interval
one undefined: a line in 0 % of the interval
three undefined: a line in 30 % of the interval"
