// Draws the discs and spheres of the motion (motion.js) into the view (view.js).
// report/particles/page_data.cpp writes their radii, positions and angles.

const kLargestSprite = 512;  // [device pixels]
const kDisc = {fill: '#a9c3da', edge: '#4f728f'};
const kDiscInFluid = {fill: '#f1ece0', edge: '#3c3a34'};
const kDiscOfBody = {fill: '#e0cda6', edge: '#8a713b'};
// From the brightest point to the rim.
const kBall = ['#e3eef7', '#a3bfd8', '#5b7f9f', '#34536e'];
const kBallOfBody = ['#f6ead0', '#dcc79c', '#a98d55', '#7a6231'];
const disc = motion.flow ? kDiscInFluid : kDisc;
const isInBody = k => bodies !== null && bodies[k] >= 0;

function paintParticle(p, x, y, r, inBody) {
  const rim = Math.min(2 * dots, Math.max(0.5, 0.07 * r));
  if (flat) {
    const colours = inBody ? kDiscOfBody : disc;
    p.fillStyle = colours.fill;
    p.strokeStyle = colours.edge;
  } else {
    const ball = inBody ? kBallOfBody : kBall;
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

// Copying a picture is faster than drawing thousands of spheres. There is one picture for each
// power of two in size, so that none is reduced to less than half its size; negative sizes are
// those of particles of bodies.
const sprites = new Map();
function spriteFor(size, inBody) {
  const side = 2 ** Math.ceil(Math.log2(Math.max(4, size)));
  const key = inBody ? -side : side;
  if (!sprites.has(key)) {
    const sprite = document.createElement('canvas');
    sprite.width = sprite.height = side;
    paintParticle(sprite.getContext('2d'), side / 2, side / 2, side / 2,
                  inBody);
    sprites.set(key, sprite);
  }
  return sprites.get(key);
}

function particle(x, y, r, inBody) {
  if (r < 1) {
    pen.fillStyle = flat ? (inBody ? kDiscOfBody : disc).fill : (inBody ? kBallOfBody : kBall)[1];
    const half = Math.max(r, 0.35);
    pen.fillRect(x - half, y - half, 2 * half, 2 * half);
  } else if (2 * r > kLargestSprite) {
    paintParticle(pen, x, y, r, inBody);
  } else {
    pen.drawImage(spriteFor(2 * r, inBody), x - r, y - r, 2 * r, 2 * r);
  }
}

const pageX = new Float32Array(count), pageY = new Float32Array(count);
const pageRadius = new Float32Array(count), depths = new Float32Array(count);
const order = new Uint32Array(count);  // from far to near

function placeParticles() {
  for (let k = 0; k < count; ++k) {
    const x = positions[k * dim], y = positions[k * dim + 1], z = flat ? 0 : positions[k * dim + 2];
    const p = project(x, y, z);
    pageX[k] = p.x;
    pageY[k] = p.y;
    pageRadius[k] = p.near * view.scale * radii[k];
    if (!flat) depths[k] = axes[2][0] * x + axes[2][1] * y + axes[2][2] * z;
  }
  if (!flat) sortByDepth();
}

/**
 * Sorts the particles into 4096 layers of depth; within a layer they keep their order. Particles
 * that overlap on the page are in different layers, unless they are very small.
 */
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

const isSeen = k => {
  const r = pageRadius[k];
  return r > 0 && pageX[k] > -r && pageX[k] < canvas.width + r &&
         pageY[k] > -r && pageY[k] < canvas.height + r;
};

const rank = new Uint32Array(flat ? 0 : count), chain = new Int32Array(flat ? 0 : count);
const chained = new Int32Array(flat ? 0 : lines.pair.length);

/**
 * Draws the spheres from far to near. A contact is drawn with the nearer of its particles: over
 * both particles, and under everything in front of them.
 */
function drawSpheres() {
  chain.fill(-1);
  if (withContacts) {
    order.forEach((k, i) => { rank[k] = i; });
    for (let i = 0; i < lines.count; ++i) {
      const first = pairs[2 * lines.pair[i]], second = pairs[2 * lines.pair[i] + 1];
      const k = first >= 0 && rank[first] > rank[second] ? first : second;
      chained[i] = chain[k];
      chain[k] = i;
    }
  }
  for (let j = 0; j < count; ++j) {
    const k = order[j];
    if (isSeen(k)) {
      particle(pageX[k], pageY[k], pageRadius[k], isInBody(k));
      if (orientations.length) drawAxes(k);
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
}

function drawDiscs() {
  for (let k = 0; k < count; ++k) {
    const x = positions[2 * k], y = positions[2 * k + 1], r = radii[k];
    // The image at the other side of the cell, if the disc sticks out of it.
    const besideX = !periodX ? 0 : x - r < cellX ? periodX : x + r > cellX + periodX ? -periodX : 0;
    const besideY = !periodY ? 0 : y - r < cellY ? periodY : y + r > cellY + periodY ? -periodY : 0;
    for (const shiftX of besideX ? [0, besideX] : [0])
      for (const shiftY of besideY ? [0, besideY] : [0]) {
        const pageAtX = pageX[k] + view.scale * shiftX, pageAtY = pageY[k] - view.scale * shiftY;
        const size = pageRadius[k];
        if (pageAtX < -size || pageAtX > canvas.width + size) continue;
        if (pageAtY < -size || pageAtY > canvas.height + size) continue;
        particle(pageAtX, pageAtY, size, isInBody(k));
        if (angles.length) drawMark(k, pageAtX, pageAtY);
      }
  }
}
