// Keeps in the address of the page what the reader sees, so that a copied address shows the same:
// after # it has the time, the view if the reader moved it, and the choice of colours. The file
// also saves the motion as a film. A change must keep the keys t, x, y, zoom, turn, above and
// colour, because readers have saved addresses. Values of an address that are no finite numbers are
// ignored; only the promise of makeFilm() can fail. controls.js, the last file of the script, calls
// showAddress() and offers makeFilm(); picture.js calls keepAddress(). The other names are those of
// motion.js, view.js, colouring.js and controls.js.

// Returns what the reader sees as a text '#key=value&...': the time t [the case's unit]; the shift
// x, y of the view in widths of the canvas; `zoom`, the diagonal of the motion's box in widths of
// the canvas, > 0; the angles of the view `turn` and `above` [rad]; and `colour`, the name of the
// choice of colours. Numbers have five significant digits, a free choice.
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

// Shows what the address of the page says. A value that is no finite number, or a zoom <= 0, is
// ignored; the angle `above` is limited to -pi/2 to pi/2, and the time to that of the motion.
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
// Changes the address when the picture has not changed for 0.3 s (a free choice), if the motion
// does not play.
function keepAddress() {
  clearTimeout(addressTimer);
  addressTimer = setTimeout(() => {
    const address = addressOfView();
    if (player.playing || address === shownAddress) return;
    shownAddress = address;
    // The whole address is given, because "#..." alone could be taken relative to another page in
    // which this page is embedded. replace() adds no entry to the history of the browser.
    location.replace(document.URL.split('#')[0] + address);
  }, 300);
}

// The kind of film that the browser can record, as a MIME type. The result is null or undefined if
// the browser can record none, or if there are fewer than two frames.
function filmType() {
  if (!canvas.captureStream || !window.MediaRecorder || frames < 2) return null;
  return ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm'].find(
    kind => MediaRecorder.isTypeSupported(kind));
}

// Plays the motion once and records what the canvas shows. Returns a promise of the film (a WebM
// Blob), or of null if the browser cannot make a film or if the reader pauses the motion. The
// promise fails if the browser refuses to record. The rate of 30 pictures and 8e6 bits in a second,
// and the 200 ms for which the last picture stays, are free choices.
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
