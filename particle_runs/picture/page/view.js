// Determines which part of the motion (motion.js) the canvas shows, and from which direction; and
// draws the obstacles, which are planes and circles around the particles. Places on the canvas are
// in device pixels with y downwards, points and lengths of the motion in the case's unit of length
// [L]. Nothing is checked or thrown: the box of the motion must have a size > 0, and points have
// three coordinates. picture.js, controls.js and address.js, which belong to the same script, use
// all names. The angles of the view at the start and the drawing of planes must agree with
// view_of() and the planes in particle_runs/picture/frame_picture.cpp, which draws the still picture.

const canvas = document.getElementById('stage'), pen = canvas.getContext('2d');
// `scale` is in device pixels per unit of length, > 0. `x` and `y` are the coordinates of the
// middle of the box on the canvas, from the middle of the canvas [device pixels]. `turn` is the
// angle of the view about the axis that points upwards, and `above`, from -pi/2 to pi/2, is its angle
// above the plane of the other two axes [rad]. `moved` is true if the reader has moved the picture.
const view = {scale: 1, x: 0, y: 0, turn: Math.PI / 6, above: Math.PI / 9, moved: false};
let axes;  // unit vectors of the motion to the right, upwards and towards the reader
let dots = 1;  // device pixels in a CSS pixel
// dot() is the inner product of two vectors, plus() the vector a + s b.
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const plus = (a, s, b) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];

// Sets `axes` for the angles of the view; in the plane they are the axes of the motion. In space the
// axis motion.up, 1 or 2, points upwards.
function setAxes() {
  const c = Math.cos(view.turn), s = Math.sin(view.turn);
  const ca = Math.cos(view.above), sa = Math.sin(view.above);
  axes = flat ? [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
              : [[c, s, 0], [-s * sa, c * sa, ca], [s * ca, -c * ca, sa]];
  if (!flat && motion.up === 1) axes = axes.map(([x, y, z]) => [x, z, -y]);
}

// The magnification of things at a depth [L] in front of the middle of the box, divided by that in
// the middle. The reader is four diagonals of the box away from the middle, a free choice. The
// result is 0 for things that are too near to the reader or behind.
function nearness(depth) {
  if (flat) return 1;
  const distance = 4 * diagonal;
  return depth < 0.8 * distance ? distance / (distance - depth) : 0;
}

const onPage = {x: 0, y: 0, near: 0};  // the result of project(), which each call overwrites
// The place {x, y} on the canvas of the point (px, py, pz) of the motion [L], and `near`, its
// nearness().
function project(px, py, pz) {
  const x = px - middle[0], y = py - middle[1], z = pz - middle[2], [r, u, t] = axes;
  onPage.near = nearness(t[0] * x + t[1] * y + t[2] * z);
  const s = view.scale * onPage.near;
  onPage.x = canvas.width / 2 + view.x + s * (r[0] * x + r[1] * y + r[2] * z);
  onPage.y = canvas.height / 2 + view.y - s * (u[0] * x + u[1] * y + u[2] * z);
  return onPage;
}

// Sets the view in which the box of the motion fills the canvas.
function showAll() {
  setAxes();
  Object.assign(view, {scale: 1, x: 0, y: 0, moved: false});
  let left = Infinity, right = -Infinity, top = Infinity, bottom = -Infinity;
  for (let corner = 0; corner < 8; ++corner) {
    const p = project(...low.map((l, d) => (corner >> d & 1 ? high[d] : l)));
    left = Math.min(left, p.x - canvas.width / 2);
    right = Math.max(right, p.x - canvas.width / 2);
    top = Math.min(top, p.y - canvas.height / 2);
    bottom = Math.max(bottom, p.y - canvas.height / 2);
  }
  view.scale = Math.min(canvas.width / (right - left), canvas.height / (bottom - top));
  view.x = -view.scale * (left + right) / 2;
  view.y = -view.scale * (top + bottom) / 2;
}

// Multiplies the scale by a factor; the point (x, y) of the canvas stays where it is. The largest
// scale, at which a millionth of the box fills the canvas, and the smallest are free choices.
function zoom(factor, x = canvas.width / 2, y = canvas.height / 2) {
  const most = 1e6 * Math.max(canvas.width, canvas.height) / diagonal;
  const next = Math.min(most, Math.max(1e-9 * most, view.scale * factor));
  factor = next / view.scale;
  view.scale = next;
  view.x = x - canvas.width / 2 + factor * (view.x - (x - canvas.width / 2));
  view.y = y - canvas.height / 2 + factor * (view.y - (y - canvas.height / 2));
  view.moved = true;
  redraw();
}

// Adapts the canvas and the view to the size that the canvas has on the page.
function resize() {
  const box = canvas.getBoundingClientRect();
  dots = window.devicePixelRatio || 1;
  const width = Math.max(1, Math.round(box.width * dots));
  const height = Math.max(1, Math.round(box.height * dots));
  if (width === canvas.width && height === canvas.height) return;
  const factor = Math.min(width / canvas.width, height / canvas.height);
  canvas.width = width;
  canvas.height = height;
  if (view.moved) { view.scale *= factor; view.x *= factor; view.y *= factor; } else showAll();
  draw();
}

// The part of a convex polygon, or of a line with two ends, where the inner product of `normal` and
// x - point is at least -slack. A polygon is a list of its corners x [L], which may be empty.
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

// The part of a polygon or line that is on the free side of all planes but number `own`, in which
// it lies. The free side of a plane is that of the particles. With the slack, rounding errors
// remove nothing if planes coincide.
function clipByPlanes(polygon, own) {
  planes.forEach((plane, i) => {
    if (i !== own) polygon = clip(polygon, plane.point, plane.normal, 1e-4 * diagonal);
  });
  return polygon;
}

// The part of a polygon or line in the box of the motion.
function clipByRoom(polygon) {
  for (let d = 0; d < 3; ++d) {
    const axis = [0, 1, 2].map(e => (e === d ? 1 : 0));
    polygon = clip(clip(polygon, low, axis), high, axis.map(v => -v));
  }
  return polygon;
}

// Adds a polygon, or a line with two ends, to the path of the pen.
function trace(polygon) {
  polygon.forEach((x, i) => {
    const p = project(...x);
    if (i) pen.lineTo(p.x, p.y); else pen.moveTo(p.x, p.y);
  });
}

// For motions in the plane: the corners [L] of the part of the plane that the canvas shows.
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

// For motions in the plane: fills the regions behind planes and outside circles.
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

// For motions in the plane: draws the planes and circles as lines.
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

// For motions in a cell that is periodic in three directions: the edges of the cell, the three that
// meet in the farthest corner as dashed lines (`behind`), or the others.
function drawCell(behind) {
  const edges = lattice || [[periodX, 0, 0], [0, periodY, 0], [0, 0, periodZ]];
  const from = lattice ? plus(middleOfCell, -0.5, shiftIn(lattice, [1, 1, 1])) : [cellX, cellY, cellZ];
  const corner = number => plus(from, 1, shiftIn(edges, [0, 1, 2].map(d => number >> d & 1)));
  const farthest = edges.reduce((number, x, d) => number + (dot(x, axes[2]) < 0 ? 1 << d : 0), 0);
  pen.strokeStyle = theme.edge;
  pen.lineWidth = dots;
  pen.setLineDash(behind ? [6 * dots, 5 * dots] : []);
  pen.beginPath();
  for (let number = 0; number < 8; ++number)
    for (const bit of [1, 2, 4]) {
      const other = number | bit;
      if (other === number) continue;
      if (behind === (number === farthest || other === farthest))
        trace([corner(number), corner(other)]);
    }
  pen.stroke();
  pen.setLineDash([]);
}

// For motions in space. If `fromFreeSide` is true, this function draws the planes that are seen
// from their free side, where the particles are, as patches with a grid. Otherwise it draws the
// edges of the other planes. The steps of the grid are a power of ten [L], near an eighth of the
// box's diagonal.
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
