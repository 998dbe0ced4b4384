// The axes of the plots of a page: ranges, ticks and numbers; and the curves: their values, their
// points and their samples in the legend. uPlot, the library that draws the plots, refuses ranges
// below 1e-16, and its logarithmic axes have whole decades only. Therefore uPlot gets inner values:
// the decimal logarithm of a value, or the value divided by a power of ten of the size of the axis;
// this file places and labels the ticks. Outer values are those of the files, in the units that the
// labels say. Nothing is thrown: a missing value is null, and has no point. report/page.cpp writes
// axes and curves as JSON, and a change must agree with its json_of(). This file and those that
// report/CMakeLists.txt lists after it are one script, so each may use the names of all.

const kBlank = '\u2013';  // is shown in place of a missing number

/**
 * An axis as page.cpp describes it: label, logarithmic, and low, high (outer; null: from `values`,
 * with a margin of 4 %, a free choice). The result has the functions from outer to inner values and
 * back, and the full range of inner values.
 */
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

/** Ticks with a step of 1, 2 or 5 times a power of ten; about `count` of them. */
function evenTicks(low, high, count) {
  const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find(m => m * power >= rough);
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
    ticks.push(i * step);
  return ticks;
}

function ticksOf(axis, low, high, count) {
  if (!axis.described.logarithmic || high - low < 1)
    return evenTicks(axis.outer(low), axis.outer(high), count)
      .map(axis.inner).map(plain).filter(v => v !== null);
  return evenTicks(low, high, count).filter(v => Number.isInteger(v));
}

const kSuperscripts = '\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079';
const raised = n => String(n).replace('-', '\u207b').replace(/\d/g, d => kSuperscripts[d]);

/** A number as a short text: 0.002, 150, 3·10⁻⁷. */
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

/** Labels with enough digits to distinguish each tick from its neighbours. */
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

/** The values of x, made strictly increasing for uPlot: at a jump, two points have the same x. */
function separated(x, span) {
  const result = x.slice();
  for (let i = 1; i < result.length; ++i)
    if (!(result[i] > result[i - 1])) result[i] = result[i - 1] + 1e-12 * span;
  return result;
}

/**
 * The value of a curve at x, both in the units that uPlot gets. Between two points it is
 * interpolated linearly; for a curve of separate points it is that of the nearest point within
 * `reach`.
 */
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

function outline(kind, x, y, r) {
  const path = new Path2D();
  if (kind === 'square') path.rect(x - r, y - r, 2 * r, 2 * r);
  else if (kind === 'cross') {
    path.moveTo(x - r, y - r); path.lineTo(x + r, y + r);
    path.moveTo(x - r, y + r); path.lineTo(x + r, y - r);
  } else path.arc(x, y, r, 0, 2 * Math.PI);
  return path;
}

/** Draws the points of a curve in the curve's shape, because uPlot draws circles only. */
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
