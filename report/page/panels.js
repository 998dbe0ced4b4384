// Draws the plots of a report with uPlot, so that a reader can zoom them and read values by pointer
// or finger: one finger reads values, two fingers zoom, a double tap resets the axes. One finger
// that moves up or down still scrolls the page. Each figure contains its plot as JSON, {name,
// panels: [{title, x, y, rows, curves}]}, which report/page.cpp writes; a change must agree with
// its json_of(). x and y are axes; `rows` has the names of y = 1, 2, ..., or is empty if y is a
// quantity. axes.js, the first part of the same script, describes axes, curves, and inner and outer
// values. Without scripts, and in print, a figure shows its still picture. Nothing is checked or
// thrown. Sizes are in CSS pixels, and those without a reason are free choices. The loop at the end
// draws all plots when the page is loaded.

// Lets fingers read values and zoom in uPlot's object u. A second tap within 300 ms calls reset().
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
      // While the fingers move, the point of the plot under each finger stays under it.
      const x = spots.map(s => u.posToVal(s.x, 'x')), y = spots.map(s => u.posToVal(s.y, 'y'));
      pinch = {spots, x, y};
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
        // Fingers less than 40 pixels apart in this direction do not zoom in it.
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

// Appends an element to `parent` and returns it.
function element(tag, className, parent, text) {
  const made = document.createElement(tag);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  parent.append(made);
  return made;
}

// Makes the legend, which shows the values at the pointer: a row for x, and a row for each curve
// with a legend; a curve without a legend belongs to the row before it. toggle(series, show) must
// show or hide the curve with this number (from 1). Returns the cells for the values: `x`, and
// `curves` with null for a curve that has no row.
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
      for (let j = i; j < panel.curves.length && (j === i || !panel.curves[j].legend); ++j)
        toggle(j + 1, !hidden);
    });
  });
  return cells;
}

// Draws a panel and its legend into the element `parent`. `height` is that of the panel [pixels].
function makePanel(parent, panel, height) {
  const place = element('div', 'panel', parent);
  element('h3', '', place, panel.title);
  const chart = element('div', 'chart', place);
  const x = axisOf(panel.x, panel.curves.flatMap(c => c.x));
  const y = axisOf(panel.y, panel.curves.flatMap(c => c.y));
  const span = x.full[1] - x.full[0];
  for (const curve of panel.curves) {
    const heights = curve.y.map(v => (v === null ? null : y.inner(v)));
    curve.inner = {x: separated(curve.x.map(x.inner), span), y: heights};
  }

  // uPlot needs one list of abscissae for all curves. The value of a curve is undefined at an
  // abscissa where the curve has no point, and null where the curve is interrupted.
  const abscissae = [...new Set(panel.curves.flatMap(c => c.inner.x))].sort((a, b) => a - b);
  const index = new Map(abscissae.map((value, i) => [value, i]));
  const data = [abscissae, ...panel.curves.map(curve => {
    const ys = new Array(abscissae.length).fill(undefined);
    const places = curve.inner.x.map(value => index.get(value));
    places.forEach((at, i) => { ys[at] = curve.inner.y[i]; });
    // uPlot joins the points beside a run of null and undefined values unless all of them are null.
    for (let i = 1; i < places.length; ++i)
      if (curve.inner.y[i - 1] === null || curve.inner.y[i] === null)
        ys.fill(null, places[i - 1] + 1, places[i]);
    return ys;
  })];

  let u = null;
  const cells = makeLegend(place, panel, (series, show) => u.setSeries(series, {show}));
  const rows = panel.rows;
  const numberCell = (axis, v) =>
    (v === null || v === undefined ? kBlank : short(axis.outer(v), 6));
  const nameOfRow = v => rows[Math.round(v) - 1];

  // Shows the values at the pointer in the legend. If two curves of one colour share a row, the row
  // shows the values of both.
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
        cells.curves[i].textContent =
          curve.point ? nameOfRow(value) : numberCell(x, curve.inner.x[0]);
        return;
      }
      const twin = panel.curves[i + 1];
      let text = numberCell(y, value);
      if (value !== null && twin && !twin.legend && curve.colour === twin.colour) {
        const other = valueAt(twin, at, reach);
        if (other !== null) text += ' / ' + numberCell(y, other);
      } else if (value === null && inside && twin && !twin.legend) {
        text = numberCell(y, valueAt(twin, at, reach));
      }
      cells.curves[i].textContent = text;
    });
  }
  const reset = () => u.batch(() => {
    u.setScale('x', {min: x.full[0], max: x.full[1]});
    u.setScale('y', {min: y.full[0], max: y.full[1]});
  });

  const narrow = () => chart.clientWidth < 560;
  const heightOf = () => (narrow() ? Math.min(height, 60 + chart.clientWidth * 0.75) : height);
  const size = () => ({width: chart.clientWidth, height: Math.round(heightOf())});
  const broken = name =>
    (narrow() && name.length > 16 ? name.replace(/^(.{8,}?)_/, '$1_\n') : name);
  // Ticks about `apart` pixels from each other on an axis that is `length` pixels long.
  const ticksAlong = (axis, min, max, length, apart) =>
    ticksOf(axis, min, max, Math.max(2, length / apart || 6));
  const ticksOfX = (self, _, min, max) => ticksAlong(x, min, max, self.over.clientWidth, 90);
  const ticksOfY = (self, _, min, max) => ticksAlong(y, min, max, self.over.clientHeight, 50);
  const axisStyle = {
    stroke: '#333', font: '12px system-ui,sans-serif', labelFont: '13px system-ui,sans-serif',
    grid: {stroke: '#e3e3e3', width: 1}, ticks: {stroke: '#999', width: 1, size: 5},
  };
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
        splits: ticksOfX,
        values: (_, ticks) => tickLabels(x, ticks)},
      {...axisStyle, label: panel.y.label || null, labelSize: panel.y.label ? 24 : 0,
        size: rows.length ? () => (narrow() ? 118 : 210) : 62,
        splits: rows.length ? () => rows.map((_, i) => i + 1) : ticksOfY,
        values: rows.length ? () => rows.map(broken) : (_, ticks) => tickLabels(y, ticks)},
    ],
    series: [{}, ...panel.curves.map(curve => ({
      scale: 'y', stroke: curve.colour, width: curve.width,
      dash: curve.dash.length ? curve.dash : undefined,
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
  // A change of size within the observer would call the observer again without end.
  new ResizeObserver(() => requestAnimationFrame(fit)).observe(chart);
  place.uplot = u;  // tests of reports in a browser read this and the next two members
  place.curves = panel.curves;
  place.full = {x: x.full, y: y.full};
}

for (const figure of document.querySelectorAll('figure[data-plot]')) {
  const plot = JSON.parse(figure.querySelector('script').textContent);
  const zoomable = element('div', 'zoomable', figure);
  figure.querySelector('.still').after(zoomable);
  document.documentElement.classList.add('live');  // shows the plot, which needs a width
  const usual = plot.panels.length > 1 ? 320 : 380;
  for (const panel of plot.panels)
    makePanel(zoomable, panel, panel.rows.length ? 90 + 34 * panel.rows.length : usual);
}
