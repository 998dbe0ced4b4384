// The view: which part of the motion (motion.js) the canvas shows, and from where, in device pixels
// with y downwards. report/particles/particles_page.cpp writes the canvas.

const canvas = document.getElementById('stage'), pen = canvas.getContext('2d');
const view = {scale: 1, x: 0, y: 0, turn: Math.PI / 6, above: Math.PI / 9, moved: false};
let axes;  // unit vectors to the right, upwards and towards the reader
let dots = 1;  // device pixels in a CSS pixel
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const plus = (a, s, b) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];

function setAxes() {
  const c = Math.cos(view.turn), s = Math.sin(view.turn);
  const ca = Math.cos(view.above), sa = Math.sin(view.above);
  axes = flat ? [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
              : [[c, s, 0], [-s * sa, c * sa, ca], [s * ca, -c * ca, sa]];
}

/** The magnification by perspective, seen from four diagonals away; 0 behind the reader. */
function nearness(depth) {
  if (flat) return 1;
  const distance = 4 * diagonal;
  return depth < 0.8 * distance ? distance / (distance - depth) : 0;
}

const onPage = {x: 0, y: 0, near: 0};  // result of project(); each call overwrites it
function project(px, py, pz) {
  const x = px - middle[0], y = py - middle[1], z = pz - middle[2], [r, u, t] = axes;
  onPage.near = nearness(t[0] * x + t[1] * y + t[2] * z);
  const s = view.scale * onPage.near;
  onPage.x = canvas.width / 2 + view.x + s * (r[0] * x + r[1] * y + r[2] * z);
  onPage.y = canvas.height / 2 + view.y - s * (u[0] * x + u[1] * y + u[2] * z);
  return onPage;
}

/** Sets the view in which the box of the motion fills the canvas. */
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
