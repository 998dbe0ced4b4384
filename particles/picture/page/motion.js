// Reads the motion of particles from the page, and gives positions, obstacles and contacts at any
// time. Lengths and times are in the units of the case, angles in radians. A frame is the state at
// one of the times `times`; frames, particles and coordinates have numbers from 0. The page was
// written by particles/picture/particles_page.cpp and page_data.cpp: settings as JSON, arrays as
// blocks of base64. Nothing is checked; a change of their layout must be made there and here. This
// file and those that particles/picture/CMakeLists.txt lists after it are one script, so each may
// use the names of all.

// The text of a number with four digits.
const number = x => String(Number(x.toPrecision(4))).replace('-', '\u2212');
const text = id => document.getElementById(id).textContent;
function bytes(id) {
  const binary = atob(text(id)), array = new Uint8Array(binary.length);
  for (let i = 0; i < array.length; ++i) array[i] = binary.charCodeAt(i);
  return array.buffer;
}
const motion = JSON.parse(text('motion'));
const dim = motion.dimension, flat = dim === 2;
const style = motion.style;  // SceneStyle of particles/picture/scene.hpp
// The corner of the periodic cell with the smallest coordinates, and the lengths of the cell; a
// length is 0 if the motion is not periodic in this direction.
const [cellX, cellY, cellZ, periodX, periodY, periodZ] = motion.cell;
const radii = new Float32Array(bytes('radii')), times = new Float64Array(bytes('times'));
// The ids of the particles in the files. Without this block, the id of particle k is k.
const ids = document.getElementById('ids') ? new Int32Array(bytes('ids')) : null;
// Positions as written: frame by frame, particle by particle, motion.dimension numbers each. A
// coordinate is motion.low + motion.step * number (writtenPlace()).
const written = motion.bytes === 2 ? new Uint16Array(bytes('positions'))
                                   : new Float32Array(bytes('positions'));
const planeNumbers = new Float32Array(bytes('planes'));
const optional = (id, Kind) => (document.getElementById(id) ? new Kind(bytes(id)) : null);
const writtenAngles = optional('angles', Float32Array);
// Unit quaternions (w, x, y, z) of spheres, and for each particle the number of its rigid body, or
// -1 if it has none.
const writtenOrientations = optional('orientations', Float32Array);
const bodies = optional('bodies', Int32Array);
// For each particle the first frame that has it, if sources pour in particles during the motion.
const firstFrames = optional('firstFrames', Int32Array);
// Two semi-axes of each particle, the first one along its angle, if there are ellipses.
const semiAxes = optional('semiAxes', Float32Array);
// 1 for each plate with round ends: its semi-axes are half of its length and the radius of its
// ends.
const plates = optional('plates', Int8Array);
// For each pair x + 3 y + 9 z, if the contact is with the image of the second particle that is
// shifted by x, y and z periods, each -1, 0 or 1.
const images = optional('images', Int8Array);
const pairs = new Int32Array(bytes('pairs')), offsets = new Uint32Array(bytes('offsets'));
const contactBytes = new Uint8Array(bytes('contacts'));
const count = radii.length, frames = times.length;
const planeCount = frames ? planeNumbers.length / 6 / frames : 0;
const low = flat ? [...motion.roomLow, 0] : motion.roomLow;
const high = flat ? [...motion.roomHigh, 0] : motion.roomHigh;
const middle = low.map((l, d) => (l + high[d]) / 2);
const diagonal = Math.hypot(...low.map((l, d) => high[d] - l));
const firstTime = frames ? times[0] : 0, lastTime = frames ? times[frames - 1] : 0;

const positions = new Float32Array(count * dim);  // at the present time
const angles = new Float32Array(writtenAngles ? count : 0);
const orientations = new Float32Array(writtenOrientations ? 4 * count : 0);
// The obstacles at the present time: {point, normal, radius}. An obstacle with a radius > 0 is a
// circle about `point`, and its normal is 0; an obstacle with the radius 0 is a plane.
let planes = [];
let presentFrame = 0;  // the last frame that is not after the present time
const lines = {
  frame: -1,
  count: 0,
  pair: new Int32Array(pairs.length / 2),
  level: new Uint8Array(pairs.length / 2),
  // Friction as a share of Coulomb's bound, 0 to 254, or 255 if the contact slides.
  friction: new Uint8Array(pairs.length / 2),
  force: new Uint8Array(pairs.length / 2),  // normal force, 0 to 255 for the widest lines
};

/** The frame at or before a time, and the share (0 to 1) of the way to the next frame. */
function placeOf(time) {
  let a = 0, b = frames - 1;
  while (b - a > 1) {
    const c = (a + b) >> 1;
    if (times[c] <= time) a = c; else b = c;
  }
  const length = times[b] - times[a];
  return {frame: a, share: length > 0 ? Math.min(1, Math.max(0, (time - times[a]) / length)) : 0};
}

/** Coordinate d (from 0) of particle k in a frame. */
const writtenPlace = (frame, k, d) =>
  motion.low[d] + motion.step[d] * written[(frame * count + k) * dim + d];

/** Interpolates positions and planes between two frames; contacts are those of the nearer frame. */
function setTime(time) {
  const {frame, share} = placeOf(time), n = count * dim;
  const from = frame * n, to = Math.min(frame + 1, frames - 1) * n;
  for (let d = 0; d < dim; ++d) {
    const period = [periodX, periodY, periodZ][d], begin = [cellX, cellY, cellZ][d];
    for (let i = d; i < n; i += dim) {
      const here = motion.low[d] + motion.step[d] * written[from + i];
      let move = motion.low[d] + motion.step[d] * written[to + i] - here;
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
  readContacts(Math.min(frames - 1, frame + Math.round(share)));
}

/** Interpolates orientations between two frames, along the shorter way. */
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

/**
 * Decodes the contacts of a frame into `lines`. The bytes of a contact are, in this order:
 * - the index of its pair minus that of the contact before, seven bits in each byte, the lowest
 *   first; the highest bit of a byte says that another byte follows;
 * - the impulse that its film has absorbed, from 0 to 255 for the largest possible one;
 * - in a motion with friction, the friction as lines.friction has it;
 * - in a motion with forces, the normal force, from 0 to 255 for the largest one.
 */
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
