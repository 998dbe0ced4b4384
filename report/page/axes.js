// The axes of the plots of a report (ranges, ticks, numbers) and their curves (values, points,
// samples in the legend). uPlot, the library that draws the plots, refuses ranges below 1e-16, and
// its logarithmic axes have whole decades only. Therefore uPlot gets inner values: the decimal
// logarithm of a value on a logarithmic axis; on a linear axis the value divided by a power of ten,
// so that the largest is from 1 to 10. This file places and labels the ticks. Outer values are
// those of the report's files, in the units that the labels of the axes name. Nothing is checked or
// thrown: a missing value is null and has no point. A `curve` has these members: legend (text),
// colour ("#rrggbb"), width (of its line [pixels], 0: points only), dash (lengths [pixels]; empty:
// solid), point ('', 'circle', 'disc', 'square' or 'cross'), pointSize (> 0; a point of size 1 is
// about 7 pixels wide), x and y (outer values, x not decreasing), and inner: {x, y} (inner values,
// x increasing), which panels.js adds. report/page.cpp writes axes and curves as JSON, and a change
// must agree with its json_of(). report/CMakeLists.txt joins this file and panels.js into one
// script, so panels.js uses the names of this file.

const kBlank = '\u2013';  // a dash, shown in place of a missing number

// `described` is an axis as page.cpp writes it: label (text), logarithmic (true or false), and the
// ends low and high (outer values or null). An end that is null is replaced by that of `values`
// (outer) with a margin of 4 %, a free choice; without values it is taken from 1 to 2. The result
// has `described`, functions inner() and outer(), which convert outer values into inner ones and
// back, and the ends `full` of the axis (inner values) before the reader zooms.
function axisOf(described, values) {
  const finite = values.filter(v => Number.isFinite(v) && (!described.logarithmic || v > 0));
  let low = Infinity, high = -Infinity;
  for (const v of finite) { low = Math.min(low, v); high = Math.max(high, v); }
  if (!finite.length) { low = 1; high = 2; }
  const unit = 10 ** Math.floor(Math.log10(Math.max(Math.abs(low), Math.abs(high)) || 1));
  const inner = described.logarithmic ? v => (v > 0 ? Math.log10(v) : null) : v => v / unit;
  const outer = described.logarithmic ? v => 10 ** v : v => v * unit;
  const margin = 0.04 * (inner(high) - inner(low)) || 0.5;
  const full = [described.low === null ? inner(low) - margin : inner(described.low),
                described.high === null ? inner(high) + margin : inner(described.high)];
  return {described, inner, outer, full};
}

const plain = v => (v === null || v === undefined ? null : v);

// About `count` > 0 ticks from low to high > low, with a step of 1, 2 or 5 times a power of ten.
function evenTicks(low, high, count) {
  const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find(m => m * power >= rough);
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
    ticks.push(i * step);
  return ticks;
}

// About `count` ticks (inner values) from low to high (inner). On a logarithmic axis they are
// powers of ten, or even steps of the outer value if the axis covers less than a decade.
function ticksOf(axis, low, high, count) {
  if (!axis.described.logarithmic || high - low < 1)
    return evenTicks(axis.outer(low), axis.outer(high), count)
      .map(axis.inner).map(plain).filter(v => v !== null);
  return evenTicks(low, high, count).filter(v => Number.isInteger(v));
}

const kSuperscripts = '\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079';
const raised = n => String(n).replace('-', '\u207b').replace(/\d/g, d => kSuperscripts[d]);

// A number as a text with `digits` significant digits: 0.002, 150, 3·10⁻⁷.
function short(value, digits) {
  if (value === 0 || !Number.isFinite(value)) return value === 0 ? '0' : kBlank;
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e5)
    return String(Number(value.toPrecision(digits))).replace('-', '\u2212');
  const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
  const factor = String(Number(mantissa)).replace('-', '\u2212');
  const times = factor === '1' ? '' : factor === '\u22121' ? '\u2212' : factor + '\u00b7';
  return times + '10' + raised(Number(exponent));
}

// The labels of ticks (inner values), with enough digits to tell each from its neighbours.
function tickLabels(axis, ticks) {
  const values = ticks.map(axis.outer);
  let digits = 3;
  if (values.length > 1) {
    const step = Math.abs(values[1] - values[0]), size = Math.max(...values.map(Math.abs));
    digits = Math.max(1, Math.min(15, Math.ceil(Math.log10(size / step) + 1.001)));
    if (axis.described.logarithmic) digits = Math.min(digits, 6);
  }
  return values.map(v => short(v, digits));
}

// The inner values x of a curve, made strictly increasing, as uPlot needs them: at a jump two
// points have the same x, and the second is moved by 1e-12 of the axis, whose length is `span`.
function separated(x, span) {
  const result = x.slice();
  for (let i = 1; i < result.length; ++i)
    if (!(result[i] > result[i - 1])) result[i] = result[i - 1] + 1e-12 * span;
  return result;
}

// The value of a curve at x (both inner values). Between two points of a line it is interpolated
// linearly. A curve with marked points has the value of the nearest point, if that point is at most
// `reach` away (inner value). In all other cases the result is null.
function valueAt(curve, x, reach) {
  const xs = curve.inner.x, ys = curve.inner.y;
  if (!xs.length) return null;
  let low = 0, high = xs.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (xs[middle] <= x) low = middle; else high = middle;
  }
  if (curve.width === 0 || curve.point) {
    const nearest = Math.abs(xs[low] - x) < Math.abs(xs[high] - x) ? low : high;
    return Math.abs(xs[nearest] - x) <= reach ? ys[nearest] : null;
  }
  if (x < xs[0] || x > xs[xs.length - 1]) return null;
  if (ys[low] === null || ys[high] === null)
    return x === xs[low] ? ys[low] : x === xs[high] ? ys[high] : null;
  if (low === high) return ys[low];
  return ys[low] + (ys[high] - ys[low]) * (x - xs[low]) / (xs[high] - xs[low]);
}

// The outline of a marked point with the centre (x, y) and the radius r [device pixels].
function outline(kind, x, y, r) {
  const path = new Path2D();
  if (kind === 'square') path.rect(x - r, y - r, 2 * r, 2 * r);
  else if (kind === 'cross') {
    path.moveTo(x - r, y - r); path.lineTo(x + r, y + r);
    path.moveTo(x - r, y + r); path.lineTo(x + r, y - r);
  } else path.arc(x, y, r, 0, 2 * Math.PI);
  return path;
}

// Draws the marked points of a curve, which is number `series` (from 1) in uPlot's object u. uPlot
// itself could draw circles only.
function drawPoints(u, curve, series) {
  if (!curve.point || !u.series[series].show) return;
  const ratio = devicePixelRatio, box = u.bbox, context = u.ctx;
  context.save();
  context.beginPath(); context.rect(box.left, box.top, box.width, box.height); context.clip();
  context.strokeStyle = context.fillStyle = curve.colour;
  context.lineWidth = 1.5 * ratio; context.setLineDash([]);
  curve.inner.x.forEach((x, i) => {
    if (curve.inner.y[i] === null) return;
    const pageX = u.valToPos(x, 'x', true), pageY = u.valToPos(curve.inner.y[i], 'y', true);
    const path = outline(curve.point, pageX, pageY, 4.5 * curve.pointSize * ratio);
    if (curve.point === 'disc') context.fill(path); else context.stroke(path);
  });
  context.restore();
}

// The sample of a curve in the legend, as SVG.
function sample(curve) {
  const colour = curve.colour, fill = curve.point === 'disc' ? colour : 'none';
  const dash = `stroke-dasharray="${curve.dash.join(' ')}"`;
  const line = curve.width ? `<line x1="1" x2="47" y1="7" y2="7" stroke="${colour}" ` +
                             `stroke-width="${curve.width}" ${dash}/>` : '';
  const stroke = `stroke="${colour}" stroke-width="1.5" fill="${fill}"`;
  const point = {
    '': '',
    disc: `<circle cx="24" cy="7" r="4" ${stroke}/>`,
    circle: `<circle cx="24" cy="7" r="4" ${stroke}/>`,
    square: `<rect x="20" y="3" width="8" height="8" ${stroke}/>`,
    cross: `<path d="M20 3l8 8m-8 0l8-8" ${stroke}/>`,
  }[curve.point];
  return `<svg width="48" height="14" aria-hidden="true">${line}${point}</svg>`;
}
