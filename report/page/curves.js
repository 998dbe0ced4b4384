// The curves of the plots: their values, their points and their samples in the legend.
// report/report_plot.cpp writes the curves.

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
