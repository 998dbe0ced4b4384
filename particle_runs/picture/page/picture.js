// Draws the whole picture: the flow (flow.js), the obstacles (view.js), discs and spheres, marks of
// their rotation, rigid bodies, links and contacts, in light or dark colours. Positions and radii
// of the motion (motion.js) are in the case's unit of length. Places, radii and widths on the
// canvas are in device pixels, of which a CSS pixel has `dots`; y points downwards. Particles (k)
// and the contacts in `lines` (i) are numbered from 0; numbers are not checked, and nothing is
// thrown. Colours, and limits of widths and sizes without a reason, are free choices. view.js,
// colouring.js, address.js and controls.js, which belong to the same script, use the names of this
// file, for example draw() and redraw(). A change must agree with
// particle_runs/picture/frame_picture.cpp, which draws the still picture.

// Largest diameter of a sphere or disc that is copied (spriteFor()) and not painted [device
// pixels], a free choice.
const kLargestSprite = 512;
const disc = motion.flow ? style.discInFluid : style.disc;
const isInBody = k => bodies !== null && bodies[k] >= 0;

// Paints a disc or a sphere with the pen p, at the centre x, y, with the radius r > 0. Its colour
// `look` is a result of lookOf() (colouring.js).
function paintParticle(p, x, y, r, look) {
  const rim = Math.min(2 * dots, Math.max(0.5, 0.07 * r));
  if (flat) {
    [p.fillStyle, p.strokeStyle] = discColours(look);
  } else {
    const ball = ballColours(look);
    const lightX = x - 0.28 * r, lightY = y - 0.36 * r;
    const light = p.createRadialGradient(lightX, lightY, 0, lightX, lightY, 1.44 * r);
    for (let i = 0; i < 3; ++i) light.addColorStop(i / 2, ball[i]);
    p.fillStyle = light;
    p.strokeStyle = ball[3];
  }
  p.lineWidth = rim;
  p.beginPath();
  p.arc(x, y, Math.max(0, r - rim / 2), 0, 2 * Math.PI);
  p.fill();
  p.stroke();
}

// Copying a picture of a sphere is faster than painting it, which matters for thousands of them.
// There is one picture for each colour and each diameter that is a power of two, so that no picture
// is drawn at less than half of its size. `size` is a diameter [device pixels], `look` a colour.
const sprites = new Map();
function spriteFor(size, look) {
  const side = 2 ** Math.ceil(Math.log2(Math.max(4, size)));
  const key = 1024 * (look + 2) + side;
  if (!sprites.has(key)) {
    const sprite = document.createElement('canvas');
    sprite.width = sprite.height = side;
    paintParticle(sprite.getContext('2d'), side / 2, side / 2, side / 2, look);
    sprites.set(key, sprite);
  }
  return sprites.get(key);
}

// Draws a particle at the centre x, y with the radius r > 0: as a square if r is less than a pixel,
// otherwise as a disc or sphere, which is painted or copied.
function particle(x, y, r, look) {
  if (r < 1) {
    pen.fillStyle = flat ? discColours(look)[0] : ballColours(look)[1];
    const half = Math.max(r, 0.35);
    pen.fillRect(x - half, y - half, 2 * half, 2 * half);
  } else if (2 * r > kLargestSprite) {
    paintParticle(pen, x, y, r, look);
  } else {
    pen.drawImage(spriteFor(2 * r, look), x - r, y - r, 2 * r, 2 * r);
  }
}

// For each particle its place and radius on the canvas (radius 0: it is not shown) and, in space,
// its depth [L] along the line of view (the larger, the nearer to the reader).
const pageX = new Float32Array(count), pageY = new Float32Array(count);
const pageRadius = new Float32Array(count), depths = new Float32Array(count);
const order = new Uint32Array(count);  // the particles from far to near

// Whether particle k exists at the present time; a source of particles may add it later.
const isThere = k => !firstFrames || presentFrame >= firstFrames[k];

function placeParticles() {
  for (let k = 0; k < count; ++k) {
    const x = positions[k * dim], y = positions[k * dim + 1], z = flat ? 0 : positions[k * dim + 2];
    const p = project(x, y, z);
    pageX[k] = p.x;
    pageY[k] = p.y;
    pageRadius[k] = isThere(k) ? p.near * view.scale * radii[k] : 0;
    if (!flat) depths[k] = axes[2][0] * x + axes[2][1] * y + axes[2][2] * z;
  }
  if (!flat) sortByDepth();
}

// Sorts the particles into 4096 layers of depth; within a layer they keep their order. Only very
// small particles that overlap on the page can be in one layer, because the layers are thin.
function sortByDepth() {
  const layers = 4096, start = new Uint32Array(layers + 1);
  const half = diagonal / 2, centre = dot(axes[2], middle);
  const layerOf = k => {
    const layer = Math.floor(layers * ((depths[k] - centre) / half + 1) / 2);
    return Math.min(layers - 1, Math.max(0, layer)) || 0;
  };
  for (let k = 0; k < count; ++k) ++start[layerOf(k) + 1];
  for (let i = 0; i < layers; ++i) start[i + 1] += start[i];
  for (let k = 0; k < count; ++k) order[start[layerOf(k)]++] = k;
}

// Whether a part of particle k is on the canvas.
const isSeen = k => {
  const r = pageRadius[k];
  return r > 0 && pageX[k] > -r && pageX[k] < canvas.width + r &&
         pageY[k] > -r && pageY[k] < canvas.height + r;
};

// `rank` has for each sphere its place in `order`. `chain` has for each sphere the first contact
// that is drawn after it, and `chained` has for each contact the next one that is drawn after the
// same sphere; -1 means that there is none.
const rank = new Uint32Array(flat ? 0 : count), chain = new Int32Array(flat ? 0 : count);
const chained = new Int32Array(flat ? 0 : lines.pair.length);

const isBulk = !flat && periodX > 0 && periodY > 0 && periodZ > 0;

const middleOfCell = [cellX + periodX / 2, cellY + periodY / 2, cellZ + periodZ / 2];

// imagesOfSpheres() in a cell that a flow strains.
function imagesInLattice() {
  const found = [], [a, b, c] = lattice, volume = inner(crossed(a, b), c);
  const normals = [crossed(b, c), crossed(c, a), crossed(a, b)].map(x => x.map(y => y / volume));
  for (let k = 0; k < count; ++k) {
    if (!isThere(k)) continue;
    const here = [...positions.subarray(3 * k, 3 * k + 3)], r = radii[k];
    const at = normals.map(normal => inner(normal, plus(here, -1, middleOfCell)));
    const margins = normals.map(normal => 0.5 + r * Math.hypot(...normal));
    for (let n = 0; n < 27; ++n) {
      const counts = [n % 3 - 1, Math.floor(n / 3) % 3 - 1, Math.floor(n / 9) - 1];
      if (n === 13 || counts.some((m, d) => Math.abs(at[d] + m) >= margins[d])) continue;
      const place = plus(here, 1, shiftIn(lattice, counts)), p = project(...place);
      found.push({k, depth: dot(axes[2], place), x: p.x, y: p.y, r: p.near * view.scale * r});
    }
  }
  return found.sort((x, y) => x.depth - y.depth);
}

// In space: the images of spheres of which a part is in the cell, from far to near. Each is {k, depth,
// x, y, r}: the particle, its depth [L], and its place and radius on the canvas.
function imagesOfSpheres() {
  const found = [];
  if (!(periodX || periodY || periodZ)) return found;
  if (lattice) return imagesInLattice();
  const from = [cellX, cellY, cellZ], periods = [periodX, periodY, periodZ];
  // The shifts, in periods along axis d, with which a sphere has a part in the cell.
  const shifts = (d, x, r) => {
    if (!periods[d]) return [0];
    const inside = -Math.floor((x - from[d]) / periods[d]);
    const beyond = x + inside * periods[d] - from[d];
    return [inside, ...beyond < r ? [inside + 1] : [],
            ...beyond > periods[d] - r ? [inside - 1] : []];
  };
  for (let k = 0; k < count; ++k) {
    if (!isThere(k)) continue;
    const [x, y, z] = positions.subarray(3 * k, 3 * k + 3), r = radii[k];
    for (const alongY of shifts(1, y, r))
      for (const alongZ of shifts(2, z, r))
        for (const alongX of shifts(0, x + imageShift([0, alongY, 0])[0], r)) {
          if (!alongX && !alongY && !alongZ) continue;
          const place = plus([x, y, z], 1, imageShift([alongX, alongY, alongZ]));
          const p = project(...place);
          found.push({k, depth: dot(axes[2], place), x: p.x, y: p.y, r: p.near * view.scale * r});
        }
  }
  return found.sort((a, b) => a.depth - b.depth);
}

// Draws the spheres and their images from far to near. A contact is drawn just after the nearer of
// its particles: over both particles, and under everything in front of them. In a cell that is
// periodic in three directions spheres are translucent if contacts with forces are shown, and all
// contacts are drawn over them.
function drawSpheres() {
  const isClear = isBulk && motion.hasForces && withContacts, beside = imagesOfSpheres();
  if (isBulk) drawCell(true);
  if (isClear) pen.globalAlpha = style.clearBall;
  chain.fill(-1);
  if (withContacts && !isClear) {
    order.forEach((k, i) => { rank[k] = i; });
    for (let i = 0; i < lines.count; ++i) {
      const first = pairs[2 * lines.pair[i]], second = pairs[2 * lines.pair[i] + 1];
      const k = first >= 0 && rank[first] > rank[second] ? first : second;
      chained[i] = chain[k];
      chain[k] = i;
    }
  }
  let next = 0;
  const drawImages = depth => {
    for (; next < beside.length && beside[next].depth < depth; ++next)
      particle(beside[next].x, beside[next].y, beside[next].r, lookOf(beside[next].k));
  };
  for (let j = 0; j < count; ++j) {
    const k = order[j];
    drawImages(depths[k]);
    if (isSeen(k)) {
      particle(pageX[k], pageY[k], pageRadius[k], lookOf(k));
      if (orientations.length && !isClear) drawAxes(k);
    }
    for (let i = chain[k]; i >= 0; i = chained[i]) {
      if (!contactSeen(i)) continue;
      pen.strokeStyle = colours[colourOf(i)];
      pen.lineWidth = widthOf(i);
      pen.beginPath();
      traceContact(i);
      pen.stroke();
    }
  }
  drawImages(Infinity);
  pen.globalAlpha = 1;
  if (isClear) drawContacts();
  if (isBulk) drawCell(false);
}

function drawDiscs() {
  for (let k = 0; k < count; ++k) {
    const x = positions[2 * k], y = positions[2 * k + 1], r = radii[k];
    // The periods to the opposite side of the cell, if a part of the disc is outside of one side.
    const besideX = !periodX ? 0 : x - r < cellX ? 1 : x + r > cellX + periodX ? -1 : 0;
    const besideY = !periodY ? 0 : y - r < cellY ? 1 : y + r > cellY + periodY ? -1 : 0;
    for (const alongX of isSheared ? [0, 1, -1] : besideX ? [0, besideX] : [0])
      for (const alongY of isSheared ? [0, 1, -1] : besideY ? [0, besideY] : [0]) {
        const [shiftX, shiftY] = imageShift([alongX, alongY, 0]);
        const pageAtX = pageX[k] + view.scale * shiftX, pageAtY = pageY[k] - view.scale * shiftY;
        const size = pageRadius[k];
        if (!size) continue;
        if (pageAtX < -size || pageAtX > canvas.width + size) continue;
        if (pageAtY < -size || pageAtY > canvas.height + size) continue;
        if (semiAxes) drawShape(k, pageAtX, pageAtY);
        else particle(pageAtX, pageAtY, size, lookOf(k));
        if (angles.length && !hasCorners(k)) drawMark(k, pageAtX, pageAtY);
      }
  }
}

const hasCorners = k => Boolean(cornerCounts && cornerCounts[k]);

// The corners of particle k, whose centre is at `place` on the canvas. Without corners the centre
// takes their place.
function cornersOf(k, place) {
  if (!hasCorners(k)) return [[place.x, place.y]];
  const scale = pageRadius[k] / radii[k], c = Math.cos(angles[k]), s = Math.sin(angles[k]);
  return Array.from({length: cornerCounts[k]}, (_, i) => {
    const x = scale * corners[2 * (firstCorners[k] + i)];
    const y = scale * corners[2 * (firstCorners[k] + i) + 1];
    return [place.x + c * x - s * y, place.y - s * x - c * y];
  });
}

// Draws particle k at the centre x, y as a disc, an ellipse or a rounded polygon, in a motion where
// not all particles are discs.
function drawShape(k, x, y) {
  const scale = pageRadius[k] / radii[k];
  const [a, b] = [Math.max(scale * semiAxes[2 * k], 0.35), Math.max(scale * semiAxes[2 * k + 1], 0.35)];
  pen.beginPath();
  if (hasCorners(k)) {
    // The round corners; the path joins them by the straight sides.
    const all = cornersOf(k, {x, y}), n = all.length;
    const direction = i => Math.atan2(all[(i + 1) % n][1] - all[i % n][1],
                                      all[(i + 1) % n][0] - all[i % n][0]) + Math.PI / 2;
    all.forEach(([atX, atY], i) =>
      pen.arc(atX, atY, b, direction(i + n - 1), direction(i), true));
    pen.closePath();
  } else {
    pen.ellipse(x, y, a, b, -angles[k], 0, 2 * Math.PI);
  }
  [pen.fillStyle, pen.strokeStyle] = colouring.name ? discColours(lookOf(k)) : disc;
  pen.lineWidth = Math.max(1, Math.min(a, b) / 20);
  pen.fill();
  pen.stroke();
}

// Draws a dot on disc k, whose centre is at x, y, in the direction of its angle. The dot shows how
// far the disc has turned; a very small disc gets none.
function drawMark(k, x, y) {
  const r = semiAxes ? pageRadius[k] / radii[k] * semiAxes[2 * k] : pageRadius[k];
  if (r < 4 * dots) return;
  const at = style.markDistance * r;
  const markX = x + at * Math.cos(angles[k]), markY = y - at * Math.sin(angles[k]);
  pen.beginPath();
  pen.arc(markX, markY, style.markRadius * r, 0, 2 * Math.PI);
  pen.fillStyle = style.mark;
  pen.fill();
}

// Draws dots on sphere k, on the reader's side, at the ends of the three axes that turn with it.
function drawAxes(k) {
  const r = pageRadius[k];
  if (r < 5 * dots) return;
  const [w, x, y, z] = orientations.subarray(4 * k, 4 * k + 4);
  const sphereAxes = [
    [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
    [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
    [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
  ];
  pen.fillStyle = style.mark;
  for (const axis of sphereAxes)
    for (const side of [1, -1]) {
      const toward = side * dot(axes[2], axis);
      if (toward < style.leastToward) continue;  // near the rim, or on the other side
      pen.beginPath();
      pen.arc(pageX[k] + side * r * dot(axes[0], axis), pageY[k] - side * r * dot(axes[1], axis),
              style.axisRadius * r * Math.sqrt(toward), 0, 2 * Math.PI);
      pen.fill();
    }
}

// The place on the canvas of particle k if it is shifted by sign * shift [L]. Each call overwrites
// the object that the call before returned.
const shifted = (k, shift, sign) =>
  project(...[0, 1, 2].map(d => (d < dim ? positions[k * dim + d] + sign * shift[d] : 0)));

// Calls line(x1, y1, x2, y2) for the line from one particle to the nearest copy of another that is
// shifted by periods; if it is shifted, also for the line that ends at the other particle itself.
function betweenParticles(first, second, line) {
  const apart = [0, 1, 2].map(
    d => (d < dim ? positions[second * dim + d] - positions[first * dim + d] : 0));
  const shift = imageShift(nearestPeriods(apart).map(n => -n));
  const beyond = shifted(second, shift, 1);
  line(pageX[first], pageY[first], beyond.x, beyond.y);
  if (!shift.some(s => s)) return;
  const before = shifted(first, shift, -1);
  line(before.x, before.y, pageX[second], pageY[second]);
}
const traceLine = (x1, y1, x2, y2) => { pen.moveTo(x1, y1); pen.lineTo(x2, y2); };
const between = (low, x, high) => Math.min(high, Math.max(low, x));

// Draws lines that join the discs of each rigid body.
function drawBodies() {
  if (!bodies) return;
  const last = new Map();
  pen.strokeStyle = style.discOfBody[1];
  for (let k = 0; k < count; ++k) {
    if (bodies[k] < 0) continue;
    if (last.has(bodies[k])) {
      const other = last.get(bodies[k]);
      const smaller = Math.min(pageRadius[k], pageRadius[other]);
      pen.lineWidth = between(dots, style.bodyLine * smaller, 8 * dots);
      pen.beginPath();
      betweenParticles(other, k, traceLine);
      pen.stroke();
    }
    last.set(bodies[k], k);
  }
}

// Traces the zigzag line of a spring, whose corners are `width` beside its straight line.
function traceSpring(width, x1, y1, x2, y2) {
  const turns = style.springTurns, end = style.springEnd;
  const length = Math.hypot(x2 - x1, y2 - y1) || 1;
  pen.moveTo(x1, y1);
  for (let i = 0; i <= turns; ++i) {
    const share = end + (1 - 2 * end) * i / turns;
    const side = i === 0 || i === turns ? 0 : i % 2 ? -width : width;
    pen.lineTo(x1 + share * (x2 - x1) - side * (y2 - y1) / length,
               y1 + share * (y2 - y1) + side * (x2 - x1) / length);
  }
  pen.lineTo(x2, y2);
}

// Draws arms (which keep two particles at a prescribed distance) as bars, springs as zigzag lines,
// and hinges (which hold a particle at a place) as rings.
function drawLinks() {
  const smaller = ([first, second]) => Math.min(pageRadius[first], pageRadius[second]);
  pen.strokeStyle = theme.edge;
  for (const ends of motion.arms) {
    pen.lineWidth = between(1.5 * dots, style.arm * smaller(ends), 9 * dots);
    pen.beginPath();
    betweenParticles(...ends, traceLine);
    pen.stroke();
  }
  pen.strokeStyle = style.spring;
  pen.lineWidth = 1.8 * dots;
  for (const ends of motion.springs) {
    const width = between(2 * dots, style.springWidth * smaller(ends), 10 * dots);
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

let withContacts = true;  // whether the reader wants to see contacts

// The colours of contacts. The first ones are for contacts without a film of fluid, from no
// friction to sliding; the others are for contacts with a film, from little to much impulse that
// the film has absorbed. colourOf(i) is the place of the colour of contact i in the list.
const ofFriction = motion.friction.length ? motion.friction : [motion.touching];
const colours = [...ofFriction, ...motion.colours];
const slides = i => lines.friction[i] === 255;
function colourOf(i) {
  const level = lines.level[i];
  return level === 0 || slides(i)
    ? Math.round(lines.friction[i] / 255 * (ofFriction.length - 1))
    : ofFriction.length + Math.round(level / 255 * (motion.colours.length - 1));
}

// The point of the line from a to b that is nearest to the point x; all are places on the canvas.
function nearestOnLine([a, b], x) {
  const along = [b[0] - a[0], b[1] - a[1]], square = along[0] ** 2 + along[1] ** 2;
  const share = square ? ((x[0] - a[0]) * along[0] + (x[1] - a[1]) * along[1]) / square : 0;
  const at = Math.min(1, Math.max(0, share));
  return [a[0] + at * along[0], a[1] + at * along[1]];
}

// Traces the shortest line between the polygons of the corners (cornersOf()) of two particles with
// these centres on the canvas.
function traceBetweenCorners(first, second, firstPlace, secondPlace) {
  const one = cornersOf(first, firstPlace), other = cornersOf(second, secondPlace);
  const sides = all => all.map((x, i) => [x, all[(i + 1) % all.length]]);
  const lines = [...one.flatMap(x => sides(other).map(side => [x, nearestOnLine(side, x)])),
                 ...other.flatMap(x => sides(one).map(side => [nearestOnLine(side, x), x]))];
  const length = ([a, b]) => Math.hypot(a[0] - b[0], a[1] - b[1]);
  const [from, to] = lines.reduce((best, line) => (length(line) < length(best) ? line : best));
  pen.moveTo(...from);
  pen.lineTo(...to);
}

const kNoShift = [0, 0, 0];

// The shift [L] from the second particle of contact i to its periodic image that touches the first
// one. `images` is right at the time of the frame of the contact. Since then a particle may have
// left the cell and come in again at the other side, which adds a period.
function shiftOf(i) {
  if (!images) return kNoShift;
  const image = images[lines.pair[i]];
  const first = pairs[2 * lines.pair[i]], second = pairs[2 * lines.pair[i] + 1];
  if (lattice)
    return imageShift(nearestIn(lattice, [0, 1, 2].map(
      d => positions[first * dim + d] - positions[second * dim + d])));
  if (motion.offsets.length)
    return imageShift(nearestWithOffset([0, 1, 2].map(
      d => positions[first * dim + d] - positions[second * dim + d])));
  return imageShift([periodX, periodY, periodZ].map((period, d) => {
    if (!period) return 0;
    const now = positions[second * dim + d] - positions[first * dim + d];
    const then = writtenPlace(lines.frame, second, d) - writtenPlace(lines.frame, first, d);
    const periods = Math.floor((image + 13) / 3 ** d) % 3 - 1;
    return periods - Math.round((now - then) / period);
  }));
}

// Traces the line of contact i: between the centres or the polygons of the corners of two
// particles, or from a particle to the nearest point of an obstacle.
function traceContact(i) {
  const first = pairs[2 * lines.pair[i]], second = pairs[2 * lines.pair[i] + 1];
  if (first < 0) {
    const {point, normal, radius} = planes[-1 - first];
    const x = [0, 1, 2].map(d => (d < dim ? positions[second * dim + d] : 0));
    const from = plus(x, -1, point);
    const foot = radius ? plus(point, radius / (Math.hypot(...from) || 1), from)
                        : plus(x, -dot(normal, from), normal);
    const p = project(...foot);
    pen.moveTo(p.x, p.y);
    pen.lineTo(pageX[second], pageY[second]);
    return;
  }
  const trace = (from, to) =>
    corners ? traceBetweenCorners(first, second, from, to) : traceLine(from.x, from.y, to.x, to.y);
  const centre = k => ({x: pageX[k], y: pageY[k]});
  const shift = shiftOf(i);
  if (!shift.some(s => s)) return trace(centre(first), centre(second));
  // The line to a shifted image is drawn at both sides of the cell.
  const beyond = {...shifted(second, shift, 1)};
  trace(centre(first), beyond);
  trace(shifted(first, shift, -1), centre(second));
}

// The width of a line for a radius on the canvas. The list is a LineWidth of
// particle_runs/picture/scene.hpp: width over radius, least width and largest width, both in page units
// of style.pageUnit CSS pixels.
const lineWidth = ([share, least, most], radius) => {
  const unit = style.pageUnit * dots;
  return between(unit * least, share * radius, unit * most);
};

// The radius of the largest disc in particle k on the canvas.
const halfThickness = k =>
  semiAxes && pageRadius[k] / radii[k] * (hasCorners(k)
    ? semiAxes[2 * k] : Math.min(semiAxes[2 * k], semiAxes[2 * k + 1])) || pageRadius[k];

// The width of the line of contact i on the canvas.
function widthOf(i) {
  const first = pairs[2 * lines.pair[i]], second = pairs[2 * lines.pair[i] + 1];
  const r = Math.min(halfThickness(second), first < 0 ? Infinity : halfThickness(first));
  const isFilm = lines.level[i] > 0;
  if (!motion.hasForces)
    return lineWidth(isFilm || slides(i) ? style.filmLine : style.touchingLine, r);
  const scale = pageRadius[second] / radii[second];
  const widest = lineWidth(style.forceLine, scale * motion.meanRadius);
  const least = lineWidth(isFilm ? style.filmWithForce : style.touchingWithForce, r);
  return Math.max(least, widest * lines.force[i] / 255);
}

// Whether both bodies of contact i exist at the present time.
const contactThere = i => {
  const first = pairs[2 * lines.pair[i]], second = pairs[2 * lines.pair[i] + 1];
  return isThere(second) && (first < 0 || isThere(first));
};
// The contacts at the present time.
const presentContacts = () => Array.from({length: lines.count}, (_, i) => i).filter(contactThere);

// Whether contact i exists and one of its particles is on the canvas.
const contactSeen = i => {
  const first = pairs[2 * lines.pair[i]], second = pairs[2 * lines.pair[i] + 1];
  return contactThere(i) && (isSeen(second) || (first >= 0 && isSeen(first)));
};

// Draws the contacts, wide lines over thin ones. All contacts with one colour and one width,
// rounded to quarters of a pixel, are drawn together, because that is faster than one by one. There
// may be at most 256 colours, because a kind is 256 times the width plus the number of the colour.
function drawContacts() {
  const kinds = new Map();
  for (let i = 0; i < lines.count; ++i) {
    if (!contactSeen(i)) continue;
    const kind = Math.round(4 * widthOf(i)) * 256 + colourOf(i);
    if (kinds.has(kind)) kinds.get(kind).push(i); else kinds.set(kind, [i]);
  }
  for (const kind of [...kinds.keys()].sort((a, b) => a - b)) {
    pen.beginPath();
    kinds.get(kind).forEach(traceContact);
    pen.strokeStyle = colours[kind % 256];
    pen.lineWidth = Math.floor(kind / 256) / 4;
    pen.stroke();
  }
}

// The colours of the ground, of solids, lines, patches, grids and of the mark at the pointer.
const kThemes = {
  light: {paper: '#fbfbf9', solid: '#d8d8d4', edge: '#333',
          patch: 'rgba(120,120,105,.16)', grid: 'rgba(90,90,80,.35)', mark: '#d55e00'},
  dark: {paper: '#1f2326', solid: '#3b4044', edge: '#c8c8c4',
         patch: 'rgba(200,200,190,.10)', grid: 'rgba(200,200,190,.25)', mark: '#ffb000'},
};
const dark = matchMedia('(prefers-color-scheme: dark)');
let theme = dark.matches ? kThemes.dark : kThemes.light;

const flow = motion.flow ? viscontactFlow(motion.flow, bytes, (x, y) => project(x, y, 0)) : null;
const flowField = document.getElementById('flow');
const streamlines = document.getElementById('streamlines');

// Restricts drawing to the cell along the axes that have periods.
function clipToCell() {
  const from = {...project(cellX, cellY, 0)};
  const to = {...project(cellX + periodX, cellY + periodY, 0)};
  pen.beginPath();
  pen.rect(periodX ? from.x : 0, periodY ? to.y : 0, periodX ? to.x - from.x : canvas.width,
           periodY ? from.y - to.y : canvas.height);
  pen.clip();
}

// Draws the sides of the cell across which the motion is periodic as dashed lines.
function drawPeriods() {
  const from = {...project(cellX, cellY, 0)};
  const to = {...project(cellX + periodX, cellY + periodY, 0)};
  pen.strokeStyle = theme.edge;
  pen.lineWidth = dots;
  pen.setLineDash([6 * dots, 5 * dots]);
  pen.beginPath();
  for (const x of periodX ? [from.x, to.x] : []) {
    pen.moveTo(x, periodY ? from.y : 0);
    pen.lineTo(x, periodY ? to.y : canvas.height);
  }
  for (const y of periodY ? [from.y, to.y] : []) {
    pen.moveTo(periodX ? from.x : 0, y);
    pen.lineTo(periodX ? to.x : canvas.width, y);
  }
  pen.stroke();
  pen.setLineDash([]);
}

function draw() {
  pen.fillStyle = theme.paper;
  pen.fillRect(0, 0, canvas.width, canvas.height);
  if (!frames) return;
  setAxes();
  readColours();
  pen.lineCap = 'round';
  placeParticles();
  if (flat) {
    pen.save();
    if (periodX || periodY) clipToCell();
    if (flow) flow.draw(pen, player.time, flowField.value, streamlines.checked, dots);
    drawSolids();
    drawDiscs();
    drawBodies();
    drawLines();
    if (withContacts) drawContacts();
    drawLinks();
    pen.restore();
    if (periodX || periodY) drawPeriods();
  } else {
    drawPatches(true);
    drawSpheres();
    drawLinks();
    drawPatches(false);
  }
  if (hovered >= 0) {
    pen.strokeStyle = theme.mark;
    pen.lineWidth = 2.5 * dots;
    pen.beginPath();
    pen.arc(pageX[hovered], pageY[hovered], pageRadius[hovered], 0, 2 * Math.PI);
    pen.stroke();
  }
  canvas.dataset.time = player.time;
  canvas.dataset.contacts = withContacts ? presentContacts().length : 0;
  keepAddress();
}

let asked = false;
// Draws the picture at the next refresh of the screen, once for all calls until then.
function redraw() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => { asked = false; readPointer(); draw(); });
}

// A printed page has light colours, whatever the screen has.
const setTheme = isDark => { theme = isDark ? kThemes.dark : kThemes.light; draw(); };
dark.addEventListener('change', () => setTheme(dark.matches));
window.addEventListener('beforeprint', () => setTheme(false));
window.addEventListener('afterprint', () => setTheme(dark.matches));
