// Draws what the picture shows besides discs, spheres and contacts: how far particles have turned,
// which of them are one rigid body, and the links. report/particles/frame_marks.cpp draws the same
// marks in the still picture.

const kMark = '#4a4a44', kBodyLine = '#8a713b', kSpring = '#2b6e3f';

/** A dot at the rim, which shows how far a disc has turned. */
function drawMark(k, x, y) {
  const r = pageRadius[k];
  if (r < 4 * dots) return;
  const markX = x + 0.66 * r * Math.cos(angles[k]), markY = y - 0.66 * r * Math.sin(angles[k]);
  pen.beginPath();
  pen.arc(markX, markY, 0.13 * r, 0, 2 * Math.PI);
  pen.fillStyle = kMark;
  pen.fill();
}

/** Dots on a sphere where its three axes come out of it, as far as they are seen. */
function drawAxes(k) {
  const r = pageRadius[k];
  if (r < 5 * dots) return;
  const [w, x, y, z] = orientations.subarray(4 * k, 4 * k + 4);
  const sphereAxes = [
    [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
    [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
    [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
  ];
  pen.fillStyle = kMark;
  for (const axis of sphereAxes)
    for (const side of [1, -1]) {
      const toward = side * dot(axes[2], axis);
      if (toward < 0.15) continue;  // seen from the side
      pen.beginPath();
      pen.arc(pageX[k] + side * r * dot(axes[0], axis), pageY[k] - side * r * dot(axes[1], axis),
              0.12 * r * Math.sqrt(toward), 0, 2 * Math.PI);
      pen.fill();
    }
}

/**
 * Calls line(x1, y1, x2, y2) for the line on the page from one particle to the nearest image of
 * another; twice if it crosses a period.
 */
function betweenParticles(first, second, line) {
  const shift = [periodX, periodY].map((period, d) => {
    const apart = positions[second * dim + d] - positions[first * dim + d];
    return period ? -period * Math.round(apart / period) : 0;
  });
  const x = shift[0] * view.scale, y = -shift[1] * view.scale;
  line(pageX[first], pageY[first], pageX[second] + x, pageY[second] + y);
  if (x || y) line(pageX[first] - x, pageY[first] - y, pageX[second], pageY[second]);
}
const traceLine = (x1, y1, x2, y2) => { pen.moveTo(x1, y1); pen.lineTo(x2, y2); };
const between = (low, x, high) => Math.min(high, Math.max(low, x));

/** Lines that join the discs of each rigid body. */
function drawBodies() {
  if (!bodies) return;
  const last = new Map();
  pen.strokeStyle = kBodyLine;
  for (let k = 0; k < count; ++k) {
    if (bodies[k] < 0) continue;
    if (last.has(bodies[k])) {
      const other = last.get(bodies[k]);
      pen.lineWidth = between(dots, 0.18 * Math.min(pageRadius[k], pageRadius[other]), 8 * dots);
      pen.beginPath();
      betweenParticles(other, k, traceLine);
      pen.stroke();
    }
    last.set(bodies[k], k);
  }
}

/** A zigzag line with straight ends. */
function traceSpring(width, x1, y1, x2, y2) {
  const turns = 12, end = 0.12, length = Math.hypot(x2 - x1, y2 - y1) || 1;
  pen.moveTo(x1, y1);
  for (let i = 0; i <= turns; ++i) {
    const share = end + (1 - 2 * end) * i / turns;
    const side = i === 0 || i === turns ? 0 : i % 2 ? -width : width;
    pen.lineTo(x1 + share * (x2 - x1) - side * (y2 - y1) / length,
               y1 + share * (y2 - y1) + side * (x2 - x1) / length);
  }
  pen.lineTo(x2, y2);
}

/** Arms as bars, springs as zigzag lines and hinges as rings. */
function drawLinks() {
  const smaller = ([first, second]) => Math.min(pageRadius[first], pageRadius[second]);
  pen.strokeStyle = theme.edge;
  for (const ends of motion.arms) {
    pen.lineWidth = between(1.5 * dots, 0.25 * smaller(ends), 9 * dots);
    pen.beginPath();
    betweenParticles(...ends, traceLine);
    pen.stroke();
  }
  pen.strokeStyle = kSpring;
  pen.lineWidth = 1.8 * dots;
  for (const ends of motion.springs) {
    const width = between(2 * dots, 0.35 * smaller(ends), 10 * dots);
    pen.beginPath();
    betweenParticles(...ends, (...line) => traceSpring(width, ...line));
    pen.stroke();
  }
  pen.strokeStyle = theme.edge;
  pen.fillStyle = theme.paper;
  pen.lineWidth = 2 * dots;
  for (const at of motion.hinges) {
    const {x, y} = project(...at);
    pen.beginPath();
    pen.arc(x, y, 5 * dots, 0, 2 * Math.PI);
    pen.fill();
    pen.stroke();
  }
}
