// Draws the plots of the page with uPlot, so that they can be zoomed and values can be read by
// pointer. Each figure contains its plot as JSON (report/report_plot.hpp). Without this script, and
// in print, the figure shows the still picture.
'use strict';
(() => {
  const kBlank = '\u2013';

  // ---- Axes. uPlot refuses ranges below 1e-16, and its logarithmic axes have whole decades only.
  // Therefore it gets the logarithm of a value, or the value in a unit of the axis' size, and this
  // script places and labels the ticks.

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
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) ticks.push(i * step);
    return ticks;
  }

  function ticksOf(axis, low, high, count) {
    if (!axis.described.logarithmic || high - low < 1)
      return evenTicks(axis.outer(low), axis.outer(high), count).map(axis.inner).map(plain).filter(v => v !== null);
    return evenTicks(low, high, count).filter(v => Number.isInteger(v));
  }

  const kSuperscripts = '\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079';
  const raised = n => String(n).replace('-', '\u207b').replace(/\d/g, d => kSuperscripts[d]);

  /** A number as a short text: 0.002, 150, 3·10⁻⁷. */
  function short(value, digits) {
    if (value === 0 || !Number.isFinite(value)) return value === 0 ? '0' : kBlank;
    const size = Math.abs(value);
    if (size >= 1e-3 && size < 1e5) return String(Number(value.toPrecision(digits))).replace('-', '\u2212');
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    const factor = String(Number(mantissa)).replace('-', '\u2212');
    return (factor === '1' ? '' : factor === '\u22121' ? '\u2212' : factor + '\u00b7') + '10' + raised(Number(exponent));
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

  // ---- Curves.

  /** The values of x, made strictly increasing for uPlot: at a jump, two points have the same x. */
  function separated(x, span) {
    const result = x.slice();
    for (let i = 1; i < result.length; ++i)
      if (!(result[i] > result[i - 1])) result[i] = result[i - 1] + 1e-12 * span;
    return result;
  }

  /**
   * The value of a curve at x, both in the units that uPlot gets. Between two points it is interpolated
   * linearly; for a curve of separate points it is that of the nearest point within `reach`.
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
    if (ys[low] === null || ys[high] === null) return x === xs[low] ? ys[low] : x === xs[high] ? ys[high] : null;
    if (low === high) return ys[low];
    return ys[low] + (ys[high] - ys[low]) * (x - xs[low]) / (xs[high] - xs[low]);
  }

  function outline(kind, x, y, r) {
    const path = new Path2D();
    if (kind === 'square') path.rect(x - r, y - r, 2 * r, 2 * r);
    else if (kind === 'cross') {
      path.moveTo(x - r, y - r); path.lineTo(x + r, y + r); path.moveTo(x - r, y + r); path.lineTo(x + r, y - r);
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
      const path = outline(curve.point, u.valToPos(x, 'x', true), u.valToPos(curve.inner.y[i], 'y', true), 4.5 * curve.pointSize * ratio);
      if (curve.point === 'disc') context.fill(path); else context.stroke(path);
    });
    context.restore();
  }

  // ---- The legend, which shows the values at the pointer.

  function element(tag, className, parent, text) {
    const made = document.createElement(tag);
    if (className) made.className = className;
    if (text !== undefined) made.textContent = text;
    parent.append(made);
    return made;
  }

  function sample(curve) {
    const line = curve.width ? `<line x1="1" x2="47" y1="7" y2="7" stroke="${curve.colour}" stroke-width="${curve.width}" stroke-dasharray="${curve.dash.join(' ')}"/>` : '';
    const fill = curve.point === 'disc' ? curve.colour : 'none', stroke = `stroke="${curve.colour}" stroke-width="1.5" fill="${fill}"`;
    const point = {'': '', disc: `<circle cx="24" cy="7" r="4" ${stroke}/>`, circle: `<circle cx="24" cy="7" r="4" ${stroke}/>`,
      square: `<rect x="20" y="3" width="8" height="8" ${stroke}/>`, cross: `<path d="M20 3l8 8m-8 0l8-8" ${stroke}/>`}[curve.point];
    return `<svg width="48" height="14" aria-hidden="true">${line}${point}</svg>`;
  }

  /** A row for x and one for each curve that has words; other curves belong to the row before. */
  function makeLegend(parent, panel, toggle) {
    const table = element('table', 'legend', parent);
    const row = className => element('tr', className, table);
    const head = row('abscissa');
    element('td', '', head); element('td', '', head, panel.x.label);
    const cells = {x: element('td', 'value', head, kBlank), curves: []};
    panel.curves.forEach((curve, i) => {
      if (!curve.legend && i > 0) { cells.curves.push(null); return; }
      const line = row('curve');
      element('td', '', line).innerHTML = sample(curve);
      element('td', '', line, curve.legend || panel.y.label);
      cells.curves.push(element('td', 'value', line, kBlank));
      line.title = 'show or hide';
      line.addEventListener('click', () => {
        const hidden = line.classList.toggle('hidden');
        for (let j = i; j < panel.curves.length && (j === i || !panel.curves[j].legend); ++j) toggle(j + 1, !hidden);
      });
    });
    return cells;
  }

  // ---- A panel.

  function makePanel(parent, panel, height) {
    const place = element('div', 'panel', parent);
    element('h3', '', place, panel.title);
    const chart = element('div', 'chart', place);
    const x = axisOf(panel.x, panel.curves.flatMap(c => c.x)), y = axisOf(panel.y, panel.curves.flatMap(c => c.y));
    const span = x.full[1] - x.full[0];
    for (const curve of panel.curves)
      curve.inner = {x: separated(curve.x.map(x.inner), span), y: curve.y.map(v => (v === null ? null : y.inner(v)))};

    // uPlot needs all curves on one list of abscissae. A value is undefined where a curve has no
    // point, and null where the curve is interrupted.
    const abscissae = [...new Set(panel.curves.flatMap(c => c.inner.x))].sort((a, b) => a - b);
    const index = new Map(abscissae.map((value, i) => [value, i]));
    const data = [abscissae, ...panel.curves.map(curve => {
      const ys = new Array(abscissae.length).fill(undefined);
      curve.inner.x.forEach((value, i) => { ys[index.get(value)] = curve.inner.y[i]; });
      return ys;
    })];

    let u = null;
    const cells = makeLegend(place, panel, (series, show) => u.setSeries(series, {show}));
    const rows = panel.rows;
    const numberCell = (axis, v) => (v === null || v === undefined ? kBlank : short(axis.outer(v), 6));
    const nameOfRow = v => rows[Math.round(v) - 1];

    function readOff() {
      const {left, top} = u.cursor;
      const inside = left >= 0 && top >= 0;
      const at = inside ? u.posToVal(left, 'x') : null;
      const reach = 12 * (u.scales.x.max - u.scales.x.min) / (u.over.clientWidth || 1);
      cells.x.textContent = numberCell(x, at);
      panel.curves.forEach((curve, i) => {
        if (!cells.curves[i]) return;
        let value = inside ? valueAt(curve, at, reach) : null;
        if (rows.length && value !== null) {
          cells.curves[i].textContent = curve.point ? nameOfRow(value) : numberCell(x, curve.inner.x[0]);
          return;
        }
        const twin = panel.curves[i + 1];
        let text = numberCell(y, value);
        if (value !== null && twin && !twin.legend && curve.colour === twin.colour) {
          const other = valueAt(twin, at, reach);
          if (other !== null) text += ' / ' + numberCell(y, other);
        } else if (value === null && inside && twin && !twin.legend) text = numberCell(y, valueAt(twin, at, reach));
        cells.curves[i].textContent = text;
      });
    }
    const reset = () => u.batch(() => {
      u.setScale('x', {min: x.full[0], max: x.full[1]});
      u.setScale('y', {min: y.full[0], max: y.full[1]});
    });

    const narrow = () => chart.clientWidth < 560;
    const size = () => ({width: chart.clientWidth, height: Math.round(narrow() ? Math.min(height, 60 + chart.clientWidth * 0.75) : height)});
    const broken = name => (narrow() && name.length > 16 ? name.replace(/^(.{8,}?)_/, '$1_\n') : name);
    const axisStyle = {stroke: '#333', font: '12px system-ui,sans-serif', labelFont: '13px system-ui,sans-serif',
      grid: {stroke: '#e3e3e3', width: 1}, ticks: {stroke: '#999', width: 1, size: 5}};
    u = new uPlot({
      ...size(),
      legend: {show: false},
      padding: [10, 14, 0, 0],
      cursor: {
        x: true, y: true, points: {show: false},
        drag: {x: true, y: true, uni: 30, setScale: true},
        bind: {dblclick: () => () => { reset(); return null; }},
      },
      scales: {
        x: {time: false, auto: false, range: (_, min, max) => [min, max]},
        y: {auto: false, range: () => y.full},
      },
      axes: [
        {...axisStyle, label: panel.x.label, labelSize: 24, size: 32,
          splits: (self, _, min, max) => ticksOf(x, min, max, Math.max(2, self.over.clientWidth / 90 || 6)),
          values: (_, ticks) => tickLabels(x, ticks)},
        {...axisStyle, label: panel.y.label || null, labelSize: panel.y.label ? 24 : 0,
          size: rows.length ? () => (narrow() ? 118 : 210) : 62,
          splits: rows.length ? () => rows.map((_, i) => i + 1)
                              : (self, _, min, max) => ticksOf(y, min, max, Math.max(2, self.over.clientHeight / 50 || 6)),
          values: rows.length ? () => rows.map(broken) : (_, ticks) => tickLabels(y, ticks)},
      ],
      series: [{}, ...panel.curves.map(curve => ({
        scale: 'y', stroke: curve.colour, width: curve.width, dash: curve.dash.length ? curve.dash : undefined,
        points: {show: false}, paths: curve.width === 0 ? () => null : undefined,
      }))],
      hooks: {
        setCursor: [readOff],
        draw: [self => panel.curves.forEach((curve, i) => drawPoints(self, curve, i + 1))],
      },
    }, data, chart);
    reset();
    addTouch(u, reset);
    const fit = () => { if (chart.clientWidth && chart.clientWidth !== u.width) u.setSize(size()); };
    // Resizing within the observer itself would be an endless loop, so it is done in the next
    // frame.
    new ResizeObserver(() => requestAnimationFrame(fit)).observe(chart);
    place.uplot = u;  // for tests
    place.full = {x: x.full, y: y.full};
  }

  // ---- Touch: one finger reads values, two fingers zoom, a double tap resets the axes. Moving one
  // finger up or down still scrolls the page.

  function addTouch(u, reset) {
    const over = u.over;
    const spot = touch => {
      const box = over.getBoundingClientRect();
      return {x: touch.clientX - box.left, y: touch.clientY - box.top};
    };
    let pinch = null, lastTap = 0;
    over.addEventListener('touchstart', event => {
      if (event.touches.length === 1) {
        if (event.timeStamp - lastTap < 300) reset();
        lastTap = event.timeStamp;
        const {x, y} = spot(event.touches[0]);
        u.setCursor({left: x, top: y});
      } else if (event.touches.length === 2) {
        const spots = [spot(event.touches[0]), spot(event.touches[1])];
        // The point under each finger stays under it.
        pinch = {spots, x: spots.map(s => u.posToVal(s.x, 'x')), y: spots.map(s => u.posToVal(s.y, 'y'))};
        event.preventDefault();
      }
    }, {passive: false});
    over.addEventListener('touchmove', event => {
      if (event.touches.length === 1 && !pinch) {
        const {x, y} = spot(event.touches[0]);
        u.setCursor({left: x, top: y});
      } else if (event.touches.length === 2 && pinch) {
        event.preventDefault();
        const now = [spot(event.touches[0]), spot(event.touches[1])];
        const along = (name, values, positions, length, upward) => {
          const apart = positions[1] - positions[0];
          // Fingers that are close in this direction (pixels) do not zoom in it.
          if (Math.abs(apart) < 40) return;
          const slope = (values[1] - values[0]) / apart, start = values[0] - slope * positions[0];
          const ends = [start, start + slope * length];
          u.setScale(name, upward ? {min: ends[1], max: ends[0]} : {min: ends[0], max: ends[1]});
        };
        u.batch(() => {
          along('x', pinch.x, now.map(s => s.x), over.clientWidth, false);
          along('y', pinch.y, now.map(s => s.y), over.clientHeight, true);
        });
      }
    }, {passive: false});
    over.addEventListener('touchend', event => { if (event.touches.length === 0) pinch = null; });
  }

  for (const figure of document.querySelectorAll('figure[data-plot]')) {
    const plot = JSON.parse(figure.querySelector('script').textContent);
    const zoomable = element('div', 'zoomable', figure);
    figure.querySelector('.still').after(zoomable);
    document.documentElement.classList.add('live');  // shows the plot, so that it has a width
    for (const panel of plot.panels)
      makePanel(zoomable, panel, panel.rows.length ? 90 + 34 * panel.rows.length : plot.panels.length > 1 ? 320 : 380);
  }
})();
