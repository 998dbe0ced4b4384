// Draws the flow behind the particles: its speed or pressure as an image of a grid, and its
// streamlines. Points of the flow [L] and times [T] are in the units of the case, places on the
// canvas in device pixels. Speeds and pressures come as levels, from 0 for the lower to kLevels for
// the upper end of their scale of colours. particle_runs/picture/particles_page.cpp writes the
// settings, and flow_blocks() of page_data.cpp the blocks of numbers, whose formats
// particle_runs/picture/page_data.hpp has; a change of their layout must be made there and here.
// Nothing is checked or thrown. particle_runs/picture/page/picture.js calls viscontactFlow. Colours,
// opacities and the size of arrows are free choices.
'use strict';
const viscontactFlow = (() => {
  const kNothing = 255, kLevels = 254;  // level of a point without flow; highest level of a flow
  // kNoArrow marks a streamline without an arrow. A coordinate is a number of steps, of which there
  // are kSteps across the window of the grid. All four numbers must be those of page_data.cpp.
  const kNoArrow = 65535, kSteps = 65535;

  const rgb = text => [1, 3, 5].map(at => parseInt(text.slice(at, at + 2), 16));

  // Red, green and blue (0 to 255) of each level, interpolated between the colours of a scale.
  function tableOf(colours) {
    const nodes = colours.map(rgb), table = [];
    for (let level = 0; level <= kLevels; ++level) {
      const place = level / kLevels * (nodes.length - 1);
      const i = Math.min(nodes.length - 2, Math.floor(place));
      table.push(nodes[i].map((c, k) => c + (place - i) * (nodes[i + 1][k] - c)));
    }
    return table;
  }

  // Makes the object whose draw() draws the flow of the time that is nearest to a given time.
  // `settings` has `window` (left, right, bottom and top of the grid [L]), `columns` and `rows`
  // (the numbers of its points, >= 2), `hasAxis` (whether the flow is mirrored at x = 0),
  // `lineColour`, and `speed` and `pressure`, lists of at least two colours "#rrggbb" from the
  // lower to the upper end of the scale. bytes(id) returns a block of numbers as an ArrayBuffer.
  // toPage(x, y) returns the place {x, y} on the canvas of a point of the flow.
  return (settings, bytes, toPage) => {
    const [left, right, bottom, top] = settings.window, {columns, rows} = settings;
    const times = new Float64Array(bytes('flow-times'));
    const offsets = new Uint32Array(bytes('flow-offsets'));
    const levels = {
      speed: new Uint8Array(bytes('flow-speed')),
      pressure: new Uint8Array(bytes('flow-pressure')),
    };
    const numbers = new Uint16Array(bytes('flow-lines'));
    const tables = {speed: tableOf(settings.speed), pressure: tableOf(settings.pressure)};
    const image = document.createElement('canvas'), brush = image.getContext('2d');
    image.width = columns;
    image.height = rows;
    let painted = '';  // the field and the number of the flow that the image shows

    // The number of the flow whose time is nearest to `time`.
    function nearest(time) {
      let best = 0;
      for (let i = 1; i < times.length; ++i)
        if (Math.abs(times[i] - time) < Math.abs(times[best] - time)) best = i;
      return best;
    }

    // Paints `field` ("speed" or "pressure") of a flow into `image`, a pixel for each point.
    function paint(flow, field) {
      if (painted === field + flow) return;
      painted = field + flow;
      const pixels = brush.createImageData(columns, rows), first = flow * columns * rows;
      for (let row = 0; row < rows; ++row)
        for (let column = 0; column < columns; ++column) {
          const level = levels[field][first + (rows - 1 - row) * columns + column];
          const at = 4 * (row * columns + column);
          if (level === kNothing) continue;
          const colour = tables[field][level];
          for (let k = 0; k < 3; ++k) pixels.data[at + k] = colour[k];
          pixels.data[at + 3] = 255;
        }
      brush.putImageData(pixels, 0, 0);
    }

    // The streamlines of a flow and their arrows as paths on the canvas; corners are rounded off.
    // `dots` is the number of device pixels in a CSS pixel.
    function lines(flow, dots) {
      const origin = {...toPage(left, bottom)}, end = {...toPage(right, top)};
      const scaleX = (end.x - origin.x) / kSteps, scaleY = (end.y - origin.y) / kSteps;
      const path = new Path2D(), arrows = new Path2D();
      let at = offsets[flow];
      for (let count = numbers[at++]; count > 0; --count) {
        const points = numbers[at], arrow = numbers[at + 1], first = at + 2;
        const x = i => origin.x + scaleX * numbers[first + 2 * i];
        const y = i => origin.y + scaleY * numbers[first + 2 * i + 1];
        path.moveTo(x(0), y(0));
        for (let i = 1; i + 1 < points; ++i)
          path.quadraticCurveTo(x(i), y(i), (x(i) + x(i + 1)) / 2, (y(i) + y(i + 1)) / 2);
        path.lineTo(x(points - 1), y(points - 1));
        if (arrow !== kNoArrow) {
          const dx = x(arrow) - x(arrow - 1), dy = y(arrow) - y(arrow - 1);
          addArrow(arrows, x(arrow), y(arrow), dx, dy, dots);
        }
        at = first + 2 * points;
      }
      return {path, arrows};
    }

    function addArrow(path, x, y, dx, dy, dots) {
      const length = Math.hypot(dx, dy);
      if (!length) return;
      const a = 7 * dots * dx / length, b = 7 * dots * dy / length;
      path.moveTo(x, y);
      path.lineTo(x - a - 0.45 * b, y - b + 0.45 * a);
      path.lineTo(x - a + 0.45 * b, y - b - 0.45 * a);
      path.closePath();
    }

    // Draws the part of the flow that is on the grid: all of it, or one half if the flow has an
    // axis.
    function drawGrid(pen, flow, field, withLines, dots) {
      const from = {...toPage(left, top)}, to = {...toPage(right, bottom)};
      pen.save();
      pen.beginPath();
      pen.rect(from.x, from.y, to.x - from.x, to.y - from.y);
      pen.clip();
      if (field !== 'none') {
        paint(flow, field);
        // The outermost points of the grid are on the sides of the window. They are centres of
        // pixels, so the image is half a pixel larger on each side.
        const width = (to.x - from.x) / (columns - 1), height = (to.y - from.y) / (rows - 1);
        pen.imageSmoothingEnabled = true;
        pen.imageSmoothingQuality = 'high';
        pen.drawImage(image, from.x - width / 2, from.y - height / 2, columns * width,
                      rows * height);
      }
      if (withLines) {
        const {path, arrows} = lines(flow, dots);
        // Without colours of the speed or pressure, the lines are on the ground of the page, which
        // may be dark; this grey can be seen on a light and a dark ground.
        pen.strokeStyle = pen.fillStyle = field === 'none' ? '#7d8794' : settings.lineColour;
        pen.lineWidth = dots;
        pen.globalAlpha = 0.6;
        pen.stroke(path);
        pen.globalAlpha = 0.75;
        pen.fill(arrows);
      }
      pen.restore();
    }

    return {
      // Draws with `pen` the flow whose time is nearest to `time` [T]. `field` is "speed",
      // "pressure" or "none"; `withLines` says whether streamlines are drawn; `dots` is the number
      // of device pixels in a CSS pixel. Without a flow nothing is drawn.
      draw(pen, time, field, withLines, dots) {
        if (!times.length || (field === 'none' && !withLines)) return;
        const flow = nearest(time);
        drawGrid(pen, flow, field, withLines, dots);
        if (!settings.hasAxis) return;
        pen.save();
        pen.translate(2 * toPage(0, 0).x, 0);
        pen.scale(-1, 1);
        drawGrid(pen, flow, field, withLines, dots);
        pen.restore();
      },
    };
  };
})();
