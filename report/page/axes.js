// The axes of the plots: ranges, ticks and numbers. uPlot refuses ranges below 1e-16, and its
// logarithmic axes have whole decades only. Therefore it gets the logarithm of a value, or the
// value in a unit of the axis' size, and this file places and labels the ticks.
// report/report_plot.cpp writes the axes. This file and those that report/CMakeLists.txt lists
// after it are one script, so each may use the names of all.

const kBlank = '\u2013';  // stands for a number that there is not

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
