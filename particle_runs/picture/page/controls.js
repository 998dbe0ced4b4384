// Reacts to pointers, controls and keys. On the canvas, the values of the particle at the pointer
// are shown; one pointer moves or turns the view (view.js), and two pointers or a wheel zoom. The
// controls under the picture, and keys, change the time of the motion and what is drawn. Places of
// pointers are in device pixels of the canvas, times in the unit of the case. Speeds of pointers
// and of the wheel, and factors of keys, are free choices. particle_runs/picture/particles_page.cpp
// writes the elements with these ids. Nothing is checked or thrown; times outside the motion are
// limited to it. This file ends the script and starts the page. A change must keep the members of
// window.viscontactPlayer, which tests use.

const readout = document.getElementById('readout');
const pointer = {x: 0, y: 0, inside: false};
let hovered = -1;  // number of the particle at the pointer; -1: none
// The names of the units of the case, each after a blank; empty if the case names none.
const [lengthUnit, timeUnit] = motion.units.areSaid
  ? [` ${motion.units.length}`, ` ${motion.units.time}`] : ['', ''];

// Finds the particle at the pointer and shows its values.
function readPointer() {
  hovered = -1;
  if (pointer.inside && frames) {
    placeParticles();
    const reach = 3 * dots;  // least radius of a target, so that small particles can be hit
    for (let j = count - 1; j >= 0 && hovered < 0; --j) {
      const k = flat ? j : order[j], r = Math.max(reach, pageRadius[k]);
      const dx = pageX[k] - pointer.x, dy = pageY[k] - pointer.y;
      if (pageRadius[k] > 0 && dx ** 2 + dy ** 2 <= r * r) hovered = k;
    }
  }
  if (hovered < 0) { readout.textContent = ''; return; }
  const contacts = presentContacts().filter(
    i => pairs[2 * lines.pair[i]] === hovered || pairs[2 * lines.pair[i] + 1] === hovered).length;
  // The first coordinate of a particle on an axis is always 0 and is not shown.
  const first = hovered * dim + (motion.hasAxis ? 1 : 0);
  const place = [...positions.subarray(first, hovered * dim + dim)].map(number).join(', ');
  const name = ids ? ids[hovered] : hovered * motion.every;
  const body = isInBody(hovered) ? ` of body ${bodies[hovered]}` : '';
  readout.textContent = `particle ${name}${body}: radius ${number(radii[hovered])}` +
      `${lengthUnit}, at (${place})${lengthUnit}, ` +
      `${contacts} contact${contacts === 1 ? '' : 's'}`;
}

// The pointers that are pressed: for the id of each the place where it was last.
const held = new Map();
const onCanvas = event => {
  const box = canvas.getBoundingClientRect();
  return {
    x: (event.clientX - box.left) * canvas.width / box.width,
    y: (event.clientY - box.top) * canvas.height / box.height,
  };
};

canvas.addEventListener('pointerdown', event => {
  // setPointerCapture() fails for an event that a script has made, as in tests.
  if (event.isTrusted) canvas.setPointerCapture(event.pointerId);
  held.set(event.pointerId, onCanvas(event));
  Object.assign(pointer, onCanvas(event), {inside: true});
  redraw();
});

canvas.addEventListener('pointermove', event => {
  const now = onCanvas(event), before = held.get(event.pointerId);
  Object.assign(pointer, now, {inside: true});
  if (before) {
    const dx = now.x - before.x, dy = now.y - before.y;
    const others = [...held].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    if (others.length) {
      const gap = (a, b) => Math.hypot(a.x - b.x, a.y - b.y) || 1;
      const factor = gap(now, others[0]) / gap(before, others[0]);
      zoom(factor, (before.x + others[0].x) / 2, (before.y + others[0].y) / 2);
      view.x += dx / 2;
      view.y += dy / 2;
    } else if (flat || event.shiftKey) {
      view.x += dx;
      view.y += dy;
    } else {
      const quarter = Math.PI / 2, full = 300 * dots;
      view.turn -= dx / full * quarter;
      view.above = Math.min(quarter, Math.max(-quarter, view.above + dy / full * quarter));
    }
    view.moved = true;
    held.set(event.pointerId, now);
  }
  redraw();
});

const letGo = event => {
  held.delete(event.pointerId);
  // When a finger is lifted, the values of the particle that it pointed at remain.
  if (event.type === 'pointerleave' && event.pointerType === 'mouse') pointer.inside = false;
  redraw();
};
for (const name of ['pointerup', 'pointercancel', 'pointerleave'])
  canvas.addEventListener(name, letGo);
canvas.addEventListener('wheel', event => {
  event.preventDefault();
  const at = onCanvas(event), lineHeight = event.deltaMode === 1 ? 16 : 1;
  zoom(Math.exp(-0.0015 * Math.max(-400, Math.min(400, event.deltaY * lineHeight))), at.x, at.y);
}, {passive: false});
canvas.addEventListener('dblclick', () => { showAll(); redraw(); });

const kSeconds = 10;  // time in which the whole motion plays at speed 1 [s], a free choice
const slider = document.getElementById('time'), clock = document.getElementById('clock');
const button = document.getElementById('play');
const speed = document.getElementById('speed');
// Digits after the point of a shown time; the motion is at least 100 steps of the last digit long.
const digits = Math.min(9, Math.max(0, 2 - Math.floor(Math.log10((lastTime - firstTime) || 1))));
let lastTick = 0;

const player = {
  time: firstTime,
  playing: false,
  seek(time) {
    player.time = Math.min(lastTime, Math.max(firstTime, time));
    slider.value = player.time;
    clock.textContent = `t = ${player.time.toFixed(digits).replace('-', '\u2212')}` + timeUnit;
    slider.setAttribute('aria-valuetext', clock.textContent);
    if (frames) setTime(player.time);
    redraw();
  },
  play() {
    if (frames < 2 || player.playing) return;
    if (player.time >= lastTime) player.seek(firstTime);
    player.playing = true;
    lastTick = performance.now();
    button.textContent = 'Pause';
    requestAnimationFrame(tick);
  },
  pause() {
    player.playing = false;
    button.textContent = 'Play';
  },
  draw,
  makeFilm,
  address: addressOfView,
  // The choice of colours, the ends of its scale, and the values in the shown frame.
  colouring: () => ({...colouring, values: [...colouring.values]}),
  // Width [device pixels] and colour of the line of each contact at the present time.
  contacts: () => presentContacts().map(i => ({width: widthOf(i), colour: colours[colourOf(i)]})),
  particles: () => pageRadius.filter(r => r > 0).length,  // number of the shown ones
  first: firstTime,
  last: lastTime,
};

function tick(now) {
  if (!player.playing) return;
  // A step is at most 0.25 s long, so that a page that was hidden goes on where it was hidden.
  const seconds = Math.min(0.25, Math.max(0, (now - lastTick) / 1000));
  lastTick = now;
  player.seek(player.time + seconds * Number(speed.value) * (lastTime - firstTime) / kSeconds);
  if (player.time >= lastTime) player.pause(); else requestAnimationFrame(tick);
}

function stepFrame(by) {
  player.pause();
  const {frame, share} = placeOf(player.time);
  const next = by > 0 ? frame + (share >= 1 ? 2 : 1) : share > 0 ? frame : frame - 1;
  player.seek(times[Math.min(frames - 1, Math.max(0, next))]);
}

slider.min = firstTime;
slider.max = lastTime;
slider.disabled = button.disabled = frames < 2;
slider.addEventListener('input', () => player.seek(Number(slider.value)));
button.addEventListener('click', () => (player.playing ? player.pause() : player.play()));
document.getElementById('films').addEventListener('change', event => {
  withContacts = event.target.checked;
  redraw();
});
if (flow) {
  flowField.addEventListener('change', () => {
    for (const field of ['speed', 'pressure']) {
      const scale = document.getElementById(`${field}-scale`);
      if (scale) scale.hidden = flowField.value !== field;
    }
    redraw();
  });
  streamlines.addEventListener('change', redraw);
}
colourChoice.addEventListener('change', () => { setColouring(colourChoice.value); redraw(); });
for (const [name, isThere] of [['mass', masses], ['speed', speeds], ['force', motion.allForces]])
  if (!isThere) colourChoice.querySelector(`[value=${name}]`).remove();
document.getElementById('whole').addEventListener('click', () => {
  Object.assign(view, {turn: Math.PI / 6, above: Math.PI / 9});
  showAll();
  redraw();
});

const kKeys = {
  ' ': () => (player.playing ? player.pause() : player.play()),
  ArrowLeft: () => stepFrame(-1),
  ArrowRight: () => stepFrame(1),
  Home: () => player.seek(firstTime),
  End: () => player.seek(lastTime),
  '+': () => zoom(1.25),
  '-': () => zoom(0.8),
};
document.addEventListener('keydown', event => {
  // Buttons, check boxes and lists have their own use of keys.
  const own = event.target.closest('button, select, input:not([type=range])');
  if (own || event.ctrlKey || event.metaKey || event.altKey || !frames || !kKeys[event.key]) return;
  event.preventDefault();
  kKeys[event.key]();
});

player.seek(firstTime);
resize();
showAddress();
window.addEventListener('hashchange', showAddress);
new ResizeObserver(() => { if (!matchMedia('print').matches) resize(); }).observe(canvas);
window.viscontactPlayer = player;
