// Draws the obstacles of the motion (motion.js) into the view (view.js): planes, and circles around
// the particles. report/particles/page_data.cpp writes their places.

/** The part of a polygon, or of a line with two ends, with normal.(x - point) >= -slack. */
function clip(polygon, point, normal, slack = 0) {
  const kept = [];
  polygon.forEach((a, i) => {
    const b = polygon[(i + 1) % polygon.length];
    const u = dot(normal, plus(a, -1, point)) + slack, v = dot(normal, plus(b, -1, point)) + slack;
    if (u >= 0) kept.push(a);
    if ((u >= 0) !== (v >= 0)) kept.push(plus(a, u / (u - v), plus(b, -1, a)));
  });
  return kept;
}

function clipByPlanes(polygon, own) {
  planes.forEach((plane, i) => {
    if (i !== own) polygon = clip(polygon, plane.point, plane.normal, 1e-4 * diagonal);
  });
  return polygon;
}

function clipByRoom(polygon) {
  for (let d = 0; d < 3; ++d) {
    const axis = [0, 1, 2].map(e => (e === d ? 1 : 0));
    polygon = clip(clip(polygon, low, axis), high, axis.map(v => -v));
  }
  return polygon;
}

function trace(polygon) {
  polygon.forEach((x, i) => {
    const p = project(...x);
    if (i) pen.lineTo(p.x, p.y); else pen.moveTo(p.x, p.y);
  });
}

/** In two dimensions: the part of space that the canvas shows, as a polygon. */
function seen() {
  const at = (x, y) => [middle[0] + (x - canvas.width / 2 - view.x) / view.scale,
                        middle[1] - (y - canvas.height / 2 - view.y) / view.scale, 0];
  return [at(0, 0), at(canvas.width, 0), at(canvas.width, canvas.height), at(0, canvas.height)];
}

function traceCircle(point, radius) {
  const p = project(...point);
  pen.moveTo(p.x + radius * view.scale, p.y);
  pen.arc(p.x, p.y, radius * view.scale, 0, 2 * Math.PI);
}

function drawSolids() {
  const all = seen();
  pen.fillStyle = theme.solid;
  for (const {point, normal, radius} of planes) {
    pen.beginPath();
    if (radius) {
      trace([...all, all[0]]);
      traceCircle(point, radius);
    } else {
      trace(clip(all, point, normal.map(v => -v)));
    }
    pen.fill('evenodd');
  }
}

function drawLines() {
  const all = seen(), far = corner => Math.hypot(...plus(corner, -1, middle));
  pen.strokeStyle = theme.edge;
  pen.lineWidth = 2 * dots;
  planes.forEach(({point, normal, radius}, i) => {
    if (radius) {
      pen.beginPath();
      traceCircle(point, radius);
      pen.stroke();
      return;
    }
    const reach = Math.max(...all.map(far)) + Math.hypot(...plus(point, -1, middle));
    const along = [-normal[1], normal[0], 0];
    pen.beginPath();
    trace(clipByPlanes([plus(point, -reach, along), plus(point, reach, along)], i));
    pen.stroke();
  });
}

/**
 * In three dimensions: a plane seen from its free side is a patch with a grid; of a plane seen from
 * behind, only the edges are drawn.
 */
function drawPatches(fromFreeSide) {
  const step = 10 ** Math.round(Math.log10(diagonal / 8));
  planes.forEach(({point, normal}, i) => {
    if ((dot(normal, axes[2]) > 0) !== fromFreeSide) return;
    const size = normal.map(Math.abs), least = size.indexOf(Math.min(...size));
    const axis = [0, 1, 2].map(d => (d === least ? 1 : 0) - normal[least] * normal[d]);
    const length = Math.hypot(...axis);
    const u = axis.map(v => v / length);
    const v = [normal[1] * u[2] - normal[2] * u[1], normal[2] * u[0] - normal[0] * u[2],
               normal[0] * u[1] - normal[1] * u[0]];
    const foot = plus(middle, -dot(normal, plus(middle, -1, point)), normal), reach = diagonal;
    const at = (a, b) => plus(plus(foot, a, u), b, v);
    const square = [at(-reach, -reach), at(reach, -reach), at(reach, reach), at(-reach, reach)];
    const patch = clipByPlanes(clipByRoom(square), i);
    if (patch.length < 3) return;
    pen.lineWidth = dots;
    pen.strokeStyle = theme.grid;
    pen.fillStyle = theme.patch;
    pen.beginPath();
    trace(patch);
    pen.closePath();
    if (fromFreeSide) {
      pen.fill();
      for (let k = Math.ceil(-reach / step); k * step < reach; ++k) {
        const across = [at(k * step, -reach), at(k * step, reach)];
        const along = [at(-reach, k * step), at(reach, k * step)];
        for (const line of [across, along]) trace(clipByPlanes(clipByRoom(line), i));
      }
    }
    pen.stroke();
  });
}
