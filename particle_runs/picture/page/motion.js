// Reads a motion of particles from the page and gives positions, obstacles (planes and circles) and
// contacts at any time. Lengths and times are in the units of the case, angles in radians. A frame
// is the state at one of the times `times`. Frames, particles, pairs of particles and coordinates
// are counted from 0. particle_runs/picture/particles_page.cpp writes the settings as JSON, and
// page_data.cpp the arrays as blocks of base64, whose formats particle_runs/picture/page_data.hpp has.
// A change of their layout must be made there and here. Nothing is checked; a block that is missing
// stops the script with a TypeError. particle_runs/picture/CMakeLists.txt joins this file as the first
// with the others of this folder, except flow.js, into one script, so that they use all its names.

// A number as a text with four significant digits.
const number = x => String(Number(x.toPrecision(4))).replace('-', '\u2212');
const text = id => document.getElementById(id).textContent;
function bytes(id) {
  const binary = atob(text(id)), array = new Uint8Array(binary.length);
  for (let i = 0; i < array.length; ++i) array[i] = binary.charCodeAt(i);
  return array.buffer;
}
const motion = JSON.parse(text('motion'));
const dim = motion.dimension, flat = dim === 2;
const style = motion.style;  // colours and proportions: SceneStyle of particle_runs/picture/scene.hpp
// The corner of the periodic cell with the smallest coordinates, and the lengths of its sides; a
// length is 0 if the motion is not periodic along this axis.
const [cellX, cellY, cellZ, periodX, periodY, periodZ] = motion.cell;
// In a sheared cell the images of a particle (copies that are shifted by periods) move relative to
// it, with the velocity gradient motion.gradient = du/dx, du/dy, dv/dx, dv/dy.
const isSheared = motion.gradient.some((g, i) => g * (i % 2 ? periodY : periodX) !== 0);
const radii = new Float32Array(bytes('radii')), times = new Float64Array(bytes('times'));
// The id of each particle in the files of the case; null if the id of particle k is k.
const ids = document.getElementById('ids') ? new Int32Array(bytes('ids')) : null;
// Coordinates as the page has them: frame by frame and particle by particle, motion.dimension
// numbers for each. A number stands for the coordinate motion.low + motion.step * number [L], with
// the entries of low and step for its axis (writtenPlace()).
const written = motion.bytes === 2 ? new Uint16Array(bytes('positions'))
                                   : new Float32Array(bytes('positions'));
// For each frame and plane six numbers: a point of the plane and its unit normal into the side of
// the particles. For a circle: its centre, then 0, 0 and its radius.
const planeNumbers = new Float32Array(bytes('planes'));
const optional = (id, Kind) => (document.getElementById(id) ? new Kind(bytes(id)) : null);
// For each frame and disc its angle [rad], if discs turn.
const writtenAngles = optional('angles', Float32Array);
// For each frame and sphere a unit quaternion (w, x, y, z), if spheres turn.
const writtenOrientations = optional('orientations', Float32Array);
// For each particle the number of its rigid body, or -1 if it has none.
const bodies = optional('bodies', Int32Array);
// For each particle the first frame in which it exists, if particles are added during the motion.
const firstFrames = optional('firstFrames', Int32Array);
// Two semi-axes for each particle [L], the first along its angle, if not all are discs. Those of a
// rounded polygon are the radius of the largest disc in it and the radius of its corners.
const semiAxes = optional('semiAxes', Float32Array);
// For each particle the number of its corners if it is a rounded polygon, 2 for a plate, else 0.
const cornerCounts = optional('cornerCounts', Int8Array);
// The places of all corners, counter-clockwise, x and y relative to the centre and angle of the
// particle [L]. Those of particle k begin at firstCorners[k].
const corners = optional('corners', Float32Array);
const firstCorners = [0];
for (const n of cornerCounts || []) firstCorners.push(firstCorners[firstCorners.length - 1] + n);
// In a periodic motion the contact of a pair is with an image of the second particle, a copy that
// is shifted by x, y and z periods, each -1, 0 or 1. For each pair: the number x + 3 y + 9 z.
const images = optional('images', Int8Array);
// `pairs` has for each pair the numbers of its two particles; for obstacle j the first number is
// -1 - j. `offsets` has the place in contactBytes at which the contacts of each frame begin, and
// then the length of contactBytes.
const pairs = new Int32Array(bytes('pairs')), offsets = new Uint32Array(bytes('offsets'));
const contactBytes = new Uint8Array(bytes('contacts'));
const count = radii.length, frames = times.length;
const planeCount = frames ? planeNumbers.length / 6 / frames : 0;
const low = flat ? [...motion.roomLow, 0] : motion.roomLow;
const high = flat ? [...motion.roomHigh, 0] : motion.roomHigh;
const middle = low.map((l, d) => (l + high[d]) / 2);
const diagonal = Math.hypot(...low.map((l, d) => high[d] - l));
const firstTime = frames ? times[0] : 0, lastTime = frames ? times[frames - 1] : 0;

// The following variables belong to the time that was given to setTime(): first the positions [L],
// the angles [rad] of discs and the orientations (unit quaternions) of spheres.
const positions = new Float32Array(count * dim);
const angles = new Float32Array(writtenAngles ? count : 0);
const orientations = new Float32Array(writtenOrientations ? 4 * count : 0);
// The obstacles as objects {point, normal, radius}. A plane has the radius 0. A circle has a radius
// > 0 [L], its centre as `point` and the normal 0; the particles are inside the circle.
let planes = [];
let presentFrame = 0;  // the last frame that is not after the time
// With lubrication: the displacement along x, at the time, of the image across the period y.
let offset = 0;
// In a cell that a flow strains: its three period vectors [L], with nine numbers for each frame in
// motion.periods.
let lattice = null;
const latticeOf = frame => [0, 3, 6].map(k => motion.periods.slice(9 * frame + k, 9 * frame + k + 3));
let strain = [0, 0, 0, 0];  // strain of the cell until the time, in the order of motion.gradient
// The contacts of frame number `frame` (-1: none read yet), as readContacts() decodes them. Each
// array has an entry for each of `count` contacts; entries beyond are not used.
const lines = {
  frame: -1,
  count: 0,
  pair: new Int32Array(pairs.length / 2),
  level: new Uint8Array(pairs.length / 2),
  // Friction divided by its bound, the coefficient of friction times the normal force: 0 to 254
  // for 0 to 1. 255: the contact slides.
  friction: new Uint8Array(pairs.length / 2),
  force: new Uint8Array(pairs.length / 2),  // normal force: 0 to 255 for 0 to motion.topForce
};

// The last frame that is not after a time, but before the last frame of all, and the share (0 to 1)
// of the way to the next frame.
function placeOf(time) {
  let a = 0, b = frames - 1;
  while (b - a > 1) {
    const c = (a + b) >> 1;
    if (times[c] <= time) a = c; else b = c;
  }
  const length = times[b] - times[a];
  return {frame: a, share: length > 0 ? Math.min(1, Math.max(0, (time - times[a]) / length)) : 0};
}

// Coordinate d of particle k in a frame.
const writtenPlace = (frame, k, d) =>
  motion.low[d] + motion.step[d] * written[(frame * count + k) * dim + d];

const crossed = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];
const inner = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const shiftIn = (vectors, counts) =>
  [0, 1, 2].map(d => vectors.reduce((sum, vector, k) => sum + counts[k] * vector[d], 0));
// The numbers of period vectors of the image whose shift is the nearest one to a vector [L].
const nearestIn = ([a, b, c], apart) => {
  const volume = inner(crossed(a, b), c);
  return [crossed(b, c), crossed(c, a), crossed(a, b)].map(
    normal => Math.round(inner(normal, apart) / volume));
};

// The present shift [L] of a periodic image, for its numbers of periods along x, y and z.
function imageShift([alongX, alongY, alongZ]) {
  if (lattice) return shiftIn(lattice, [alongX, alongY, alongZ]);
  const x = periodX * alongX, y = periodY * alongY, [a, b, c, d] = strain;
  return [x + (a * x + b * y) + offset * alongY, y + (c * x + d * y), periodZ * alongZ];
}

// The numbers of periods of the image whose shift is the nearest one to a vector [L], in a cell with
// offsets.
function nearestWithOffset([x, y, z]) {
  const alongY = periodY ? Math.round(y / periodY) : 0;
  return [periodX ? Math.round((x - alongY * offset) / periodX) : 0, alongY,
          periodZ ? Math.round(z / periodZ) : 0];
}

// The numbers of periods of the image whose shift is the nearest one to the vector (x, y, z) [L].
// In a sheared cell the vectors are compared as they were before the motion of the cell, as in
// periods_towards() of particles/domain/periods.hpp.
function nearestPeriods([x, y, z]) {
  const [a, b, c, d] = strain, determinant = (1 + a) * (1 + d) - b * c;
  const atStart = [((1 + d) * x - b * y) / determinant, ((1 + a) * y - c * x) / determinant, z];
  return [periodX, periodY, periodZ].map((period, i) =>
    (period ? Math.round(atStart[i] / period) : 0));
}

// Interpolates the motion at a time [T] between two frames, and sets `positions`, `angles`,
// `orientations`, `planes`, `presentFrame`, `strain` and `lines`. Before the first and after the
// last frame the motion is that of this frame. Contacts are those of the nearer frame. There must
// be at least one frame.
function setTime(time) {
  const {frame, share} = placeOf(time), n = count * dim;
  const from = frame * n, to = Math.min(frame + 1, frames - 1) * n;
  const offsets = motion.offsets;
  if (offsets.length) {
    let moves = offsets[Math.min(frame + 1, frames - 1)] - offsets[frame];
    if (periodX) moves -= periodX * Math.round(moves / periodX);
    offset = offsets[frame] + share * moves;
  }
  if (motion.periods.length) {
    const next = latticeOf(Math.min(frame + 1, frames - 1));
    lattice = latticeOf(Math.min(frames - 1, frame + Math.round(share)));
    for (let i = 0; i < n; i += 3) {
      const place = (begin, d) => motion.low[d] + motion.step[d] * written[begin + i + d];
      const here = [0, 1, 2].map(d => place(from, d));
      const move = here.map((x, d) => place(to, d) - x);
      // A particle that leaves the cell comes in again at another side.
      const shift = shiftIn(next, nearestIn(next, move));
      for (let d = 0; d < 3; ++d) positions[i + d] = here[d] + share * (move[d] - shift[d]);
    }
  }
  for (let d = 0; d < (lattice ? 0 : dim); ++d) {
    // In a sheared cell particles that leave it are not brought back.
    const period = isSheared ? 0 : [periodX, periodY, periodZ][d], begin = [cellX, cellY, cellZ][d];
    for (let i = d; i < n; i += dim) {
      const here = motion.low[d] + motion.step[d] * written[from + i];
      let move = motion.low[d] + motion.step[d] * written[to + i] - here;
      if (offsets.length && d === 0 && periodY)  // a particle that leaves across y is displaced
        move -= offset * Math.round(motion.step[1] * (written[to + i + 1] - written[from + i + 1]) / periodY);
      // A particle that leaves the cell comes in again at the other side.
      if (period) move -= period * Math.round(move / period);
      const x = here + share * move;
      positions[i] = period ? x - period * Math.floor((x - begin) / period) : x;
    }
  }
  const fromAngle = frame * count, toAngle = Math.min(frame + 1, frames - 1) * count;
  for (let k = 0; k < angles.length; ++k)
    angles[k] = (1 - share) * writtenAngles[fromAngle + k] + share * writtenAngles[toAngle + k];
  setOrientations(frame, Math.min(frame + 1, frames - 1), share);
  const m = planeCount * 6, fromPlane = frame * m, toPlane = Math.min(frame + 1, frames - 1) * m;
  planes = [];
  for (let i = 0; i < m; i += 6) {
    const x = [0, 1, 2, 3, 4, 5].map(
      j => (1 - share) * planeNumbers[fromPlane + i + j] + share * planeNumbers[toPlane + i + j]);
    const length = Math.hypot(x[3], x[4], x[5]) || 1, radius = dim === 2 ? x[5] : 0;
    const normal = x.slice(3).map(v => (radius ? 0 : v / length));
    planes.push({point: x.slice(0, 3), normal, radius});
  }
  presentFrame = frame + (share === 1 ? 1 : 0);
  if (isSheared) strain = motion.gradient.map(g => time * g);
  readContacts(Math.min(frames - 1, frame + Math.round(share)));
}

// Interpolates the orientations between two frames along the shorter way. `share` is from 0 for the
// frame `frame` to 1 for the frame `next`.
function setOrientations(frame, next, share) {
  for (let k = 0; k < orientations.length; k += 4) {
    const from = 4 * count * frame + k, to = 4 * count * next + k;
    let along = 0, length = 0;
    for (let i = 0; i < 4; ++i)
      along += writtenOrientations[from + i] * writtenOrientations[to + i];
    for (let i = 0; i < 4; ++i) {
      const end = Math.sign(along || 1) * writtenOrientations[to + i];
      orientations[k + i] = (1 - share) * writtenOrientations[from + i] + share * end;
      length += orientations[k + i] ** 2;
    }
    for (let i = 0; i < 4; ++i) orientations[k + i] /= Math.sqrt(length) || 1;
  }
}

// Decodes the contacts of a frame into `lines`. The bytes of a contact are, in this order:
// - the number of its pair minus that of the contact before it, seven bits in each byte, the lowest
//   first; the highest bit of a byte says that another byte follows;
// - `level`: minus gamma, the impulse that its film has absorbed, from 0 for none to 255 for the
//   largest of all frames;
// - in a motion with friction, `friction`, and in a motion with forces, `force`, in the form that
//   the comments of `lines` state.
function readContacts(frame) {
  if (lines.frame === frame) return;
  lines.frame = frame;
  lines.count = 0;
  let pair = 0;
  for (let at = offsets[frame]; at < offsets[frame + 1];) {
    let step = 0, shift = 0, byte;
    do {
      byte = contactBytes[at++];
      step |= (byte & 127) << shift;
      shift += 7;
    } while (byte & 128);
    pair += step;
    lines.pair[lines.count] = pair;
    lines.level[lines.count] = contactBytes[at++];
    lines.friction[lines.count] = motion.friction.length ? contactBytes[at++] : 0;
    lines.force[lines.count++] = motion.hasForces ? contactBytes[at++] : 0;
  }
}
