// The address of the page keeps what is seen: after # it has the time, the view as far as it was
// moved, and the colours of particles, so that a copied address shows the same. The file also saves
// the motion as a film.

/** What is seen, as key=value pairs; lengths are in the widths of the canvas and of the motion. */
function addressOfView() {
  const round = x => String(Number(x.toPrecision(5)));
  const parts = {t: round(player.time)};
  if (view.moved) {
    parts.x = round(view.x / canvas.width);
    parts.y = round(view.y / canvas.width);
    parts.zoom = round(view.scale * diagonal / canvas.width);
  }
  if (!flat) Object.assign(parts, {turn: round(view.turn), above: round(view.above)});
  if (colouring.name) parts.colour = colouring.name;
  return '#' + new URLSearchParams(parts).toString();
}

/** Shows what an address says; numbers that are not finite are left out. */
function showAddress() {
  if (!location.hash || location.hash === shownAddress) return;
  const parts = new URLSearchParams(location.hash.slice(1));
  const value = key => (parts.get(key) ? Number(parts.get(key)) : NaN);
  const take = (key, set) => { if (Number.isFinite(value(key))) set(value(key)); };
  take('turn', x => { view.turn = x; });
  take('above', x => { view.above = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, x)); });
  showAll();
  if (value('zoom') > 0) {
    view.scale = value('zoom') * canvas.width / diagonal;
    view.moved = true;
    take('x', x => { view.x = x * canvas.width; });
    take('y', x => { view.y = x * canvas.width; });
  }
  setColouring(parts.get('colour'));
  take('t', t => { player.pause(); player.seek(t); });
  redraw();
}

let shownAddress = '';
let addressTimer = 0;
/** Changes the address a little after the last change of what is seen; a film goes on meanwhile. */
function keepAddress() {
  clearTimeout(addressTimer);
  addressTimer = setTimeout(() => {
    const address = addressOfView();
    if (player.playing || address === shownAddress) return;
    shownAddress = address;
    // The whole address, as the page may stand in another one; replacing it adds no entry to the history.
    location.replace(document.URL.split('#')[0] + address);
  }, 300);
}

/** The kind of film that the browser can record; nothing if it cannot, or if nothing moves. */
function filmType() {
  if (!canvas.captureStream || !window.MediaRecorder || frames < 2) return null;
  return ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm'].find(
    kind => MediaRecorder.isTypeSupported(kind));
}

/**
 * Plays the motion once and saves what the canvas shows as a film (WebM). Resolves to the film, or
 * to nothing if the browser cannot make one or the reader pauses the motion.
 */
async function makeFilm() {
  const type = filmType();
  if (!type) return null;
  const recorder = new MediaRecorder(canvas.captureStream(30), {mimeType: type, videoBitsPerSecond: 8e6});
  const parts = [];
  recorder.ondataavailable = event => parts.push(event.data);
  const ended = new Promise(done => { recorder.onstop = done; });
  player.pause();
  player.seek(firstTime);
  recorder.start();
  player.play();
  await new Promise(done => {
    const wait = () => (player.playing ? requestAnimationFrame(wait) : setTimeout(done, 200));
    wait();
  });
  recorder.stop();
  await ended;
  if (player.time < lastTime) return null;
  return new Blob(parts, {type: 'video/webm'});
}

const filmButton = document.getElementById('film');
filmButton.hidden = !filmType();
filmButton.addEventListener('click', async () => {
  filmButton.disabled = true;
  filmButton.textContent = 'Recording';
  let film = null;
  try {
    film = await makeFilm();
  } finally {
    filmButton.disabled = false;
    filmButton.textContent = film ? 'Save film' : 'No film was made';
  }
  if (!film) return;
  const link = document.createElement('a');
  link.href = URL.createObjectURL(film);
  link.download = `${document.title || 'particles'}.webm`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
});
