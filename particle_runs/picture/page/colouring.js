// Colours particles by their speed [L/T], radius [L], mass [M] or force [M L/T^2] (the sum of the
// normal forces of their contacts), as the reader chooses in the list #colour of the page. Values
// are in the units of the case, those of discs in a fluid per length. The scale of speeds and
// forces goes from 0 to the value that 98 % of the particles do not exceed; the scale of radii and
// masses goes from the least to the largest. Nothing is checked or thrown. picture.js, address.js
// and controls.js use this file. A change must agree with particles/picture: page_data.cpp writes
// the blocks of numbers `masses` and `speeds`, and particles_page.cpp the elements with the ids
// colour and particle-scale. Colours, and the 98 % and 40 frames below, are free choices.

// Number of colours; any number >= 2 works.
const kColours = 64;
// The colour, as a text rgb(...), at a level from 0 to kColours - 1. `light` is from -1 to 1: if it
// is < 0, the share |light| of black is mixed in, and if it is > 0, the share `light` of white.
function scaleColour(level, light = 0) {
  // The lightness of this scale (cividis, Nunez et al. 2018) rises from end to end, so that
  // colour-blind readers can read it.
  const nodes = [[0, 34, 78], [53, 69, 108], [124, 123, 120], [188, 174, 108], [254, 232, 56]];
  const at = level / (kColours - 1) * (nodes.length - 1), i = Math.min(nodes.length - 2, Math.floor(at));
  const paper = light > 0 ? 255 : 0;
  const mixed = [0, 1, 2].map(c => nodes[i][c] + (at - i) * (nodes[i + 1][c] - nodes[i][c]));
  return `rgb(${mixed.map(c => Math.round(c + Math.abs(light) * (paper - c))).join(',')})`;
}

const masses = optional('masses', Float32Array);
// The masses [M] are those of each particle; null if they are not known. `speeds` has for each
// frame and particle a number from 0 to 255, which stands for motion.topSpeed [L/T]; null if speeds
// are not known.
const speeds = optional('speeds', Uint8Array);
// The choices in the list, each with its words and its unit. `changes` is true if the values differ
// between frames. read(frame, values) writes the values of all particles in a frame into `values`.
const quantities = {
  speed: {
    words: 'speed', unit: motion.units.speed, changes: true,
    read(frame, values) {
      for (let k = 0; k < count; ++k)
        values[k] = speeds[frame * count + k] / 255 * motion.topSpeed;
    },
  },
  radius: {words: 'radius', unit: motion.units.length, read: (_, values) => values.set(radii)},
  mass: {words: 'mass', unit: motion.units.mass, read: (_, values) => values.set(masses)},
  force: {
    words: 'sum of normal forces', unit: motion.units.force, changes: true,
    read(frame, values) {
      readContacts(frame);
      values.fill(0);
      for (let i = 0; i < lines.count; ++i)
        for (const k of [pairs[2 * lines.pair[i]], pairs[2 * lines.pair[i] + 1]])
          if (k >= 0) values[k] += lines.force[i] / 255 * motion.topForce;
    },
  },
};

// The name of the choice (empty: none), the ends of its scale, and its values in a frame.
const colouring = {name: '', low: 0, high: 0, frame: -1, values: new Float32Array(count)};
const colourChoice = document.getElementById('colour');
const particleScale = document.getElementById('particle-scale');

// Makes the choice with this name: it finds the ends of the scale of its values, from at most 40
// frames to be fast, and shows the scale. A name that the list does not offer turns colouring off.
function setColouring(name) {
  const isOffered = name && [...colourChoice.options].some(option => option.value === name);
  const quantity = isOffered && frames && count ? quantities[name] : null;
  colouring.name = quantity ? name : '';
  colouring.frame = -1;
  colourChoice.value = colouring.name;
  particleScale.hidden = !quantity;
  if (!quantity) return;
  const shown = lines.frame;
  const every = quantity.changes ? Math.max(1, Math.ceil(frames / 40)) : frames;
  const ends = [];
  for (let frame = 0; frame < frames; frame += every) {
    quantity.read(frame, colouring.values);
    const sorted = colouring.values.slice().sort();
    ends.push(sorted[quantity.changes ? Math.ceil(0.98 * (count - 1)) : count - 1]);
    if (!quantity.changes) colouring.low = sorted[0];
  }
  if (shown >= 0) readContacts(shown);
  if (quantity.changes) colouring.low = 0;
  colouring.high = Math.max(...ends);
  const [title, bar, ticks] = ['span', '.bar', '.ticks'].map(x => particleScale.querySelector(x));
  title.textContent = `${quantity.words} [${quantity.unit}]`;
  const colours = Array.from({length: kColours}, (_, level) => scaleColour(level));
  bar.style.background = `linear-gradient(to right,${colours.join(',')})`;
  ticks.replaceChildren(...[0, 0.5, 1].map(share => {
    const tick = document.createElement('span');
    tick.style.left = `${100 * share}%`;
    tick.textContent = number(colouring.low + share * (colouring.high - colouring.low));
    return tick;
  }));
}

// Computes the values of the frame whose contacts are drawn (lines.frame of motion.js).
function readColours() {
  if (!colouring.name || colouring.frame === lines.frame) return;
  quantities[colouring.name].read(lines.frame, colouring.values);
  colouring.frame = lines.frame;
}

// A number that stands for the colour of particle k: its level on the scale, from 0 to kColours -
// 1; or, if no choice is made, -1, and -2 for a particle in a rigid body.
function lookOf(k) {
  if (!colouring.name) return isInBody(k) ? -2 : -1;
  const share = (colouring.values[k] - colouring.low) / (colouring.high - colouring.low || 1);
  return Math.round((kColours - 1) * Math.min(1, Math.max(0, share)));
}
// Colours of the fill and the edge of a disc for `look`, a result of lookOf().
const discColours = look =>
  look >= 0 ? [scaleColour(look), scaleColour(look, -0.45)] : look === -2 ? style.discOfBody : disc;
// Colours of a sphere for a result of lookOf(): three from its brightest point to its rim, and then
// that of its edge.
const ballColours = look =>
  look >= 0 ? [scaleColour(look, 0.6), scaleColour(look), scaleColour(look, -0.3), scaleColour(look, -0.5)]
            : look === -2 ? style.ballOfBody : style.ball;
