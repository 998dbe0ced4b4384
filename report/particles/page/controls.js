// The time of the motion, and what the controls under the picture and the keys do. This file is the
// last of the script and starts the page. report/particles/particles_page.cpp writes the controls,
// and report/particles/flow/flow_page.cpp those of the flow.

const kSeconds = 10;  // duration of the whole motion at speed 1
const slider = document.getElementById('time'), clock = document.getElementById('clock');
const button = document.getElementById('play');
const speed = document.getElementById('speed');
const digits = Math.min(9, Math.max(0, 2 - Math.floor(Math.log10((lastTime - firstTime) || 1))));
let lastTick = 0;

const player = {
  time: firstTime,
  playing: false,
  seek(time) {
    player.time = Math.min(lastTime, Math.max(firstTime, time));
    slider.value = player.time;
    clock.textContent = `t = ${player.time.toFixed(digits).replace('-', '\u2212')}`;
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
  first: firstTime,
  last: lastTime,
};

function tick(now) {
  if (!player.playing) return;
  // A page that was hidden continues at the time at which it was hidden.
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
  // Buttons, boxes and lists use keys themselves.
  const own = event.target.closest('button, select, input:not([type=range])');
  if (own || event.ctrlKey || event.metaKey || event.altKey || !frames || !kKeys[event.key]) return;
  event.preventDefault();
  kKeys[event.key]();
});

player.seek(firstTime);
resize();
new ResizeObserver(() => { if (!matchMedia('print').matches) resize(); }).observe(canvas);
window.viscontactPlayer = player;
