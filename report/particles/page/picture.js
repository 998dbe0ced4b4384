// Draws the whole picture in light or dark colours: the flow (flow.js), the obstacles, the
// particles and their contacts, and the sides of a periodic cell.
// report/particles/particles_page.cpp writes the cell, and report/particles/flow/flow_page.cpp the
// flow and the choices of what is drawn of it.

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

/** Draws only in the cell, where the motion has periods. */
function clipToCell() {
  const from = {...project(cellX, cellY, 0)};
  const to = {...project(cellX + periodX, cellY + periodY, 0)};
  pen.beginPath();
  pen.rect(periodX ? from.x : 0, periodY ? to.y : 0, periodX ? to.x - from.x : canvas.width,
           periodY ? from.y - to.y : canvas.height);
  pen.clip();
}

/** The sides of the cell that are one, as dashed lines. */
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
  canvas.dataset.contacts = withContacts ? lines.count : 0;
}

let asked = false;
function redraw() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => { asked = false; readPointer(); draw(); });
}

// Printed pages are light.
const setTheme = isDark => { theme = isDark ? kThemes.dark : kThemes.light; draw(); };
dark.addEventListener('change', () => setTheme(dark.matches));
window.addEventListener('beforeprint', () => setTheme(false));
window.addEventListener('afterprint', () => setTheme(dark.matches));
