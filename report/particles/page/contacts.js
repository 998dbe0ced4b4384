// Draws the contacts of the motion (motion.js) as lines between the particles (particles.js).
// report/particles/page_data.cpp writes the contacts, and report/particles/particles_page.cpp their
// colours.

let withContacts = true;  // whether the reader wants to see them

// The colours of contacts: index 0 is for gamma = 0, the others for gamma < 0 from light to dark.
// The last colour is for contacts that slide.
const colours = [motion.touching, ...motion.colours, ...(motion.sliding ? [motion.sliding] : [])];
function colourOf(i) {
  if (lines.friction[i] === 2) return colours.length - 1;
  const level = lines.level[i];
  return level === 0 ? 0 : 1 + Math.round(level / 255 * (motion.colours.length - 1));
}

/** The line of a contact, from a centre to the other centre or to the foot on the plane. */
function traceContact(i) {
  const image = images ? images[lines.pair[i]] : 0;
  const first = pairs[2 * lines.pair[i]], second = pairs[2 * lines.pair[i] + 1];
  if (first < 0) {
    const {point, normal, radius} = planes[-1 - first];
    const x = [0, 1, 2].map(d => (d < dim ? positions[second * dim + d] : 0));
    const from = plus(x, -1, point);
    const foot = radius ? plus(point, radius / (Math.hypot(...from) || 1), from)
                        : plus(x, -dot(normal, from), normal);
    const p = project(...foot);
    pen.moveTo(p.x, p.y);
  } else if (image) {
    // Across a period the line is drawn at both sides of the cell.
    const x = ((image + 4) % 3 - 1) * periodX * view.scale;
    const y = -(Math.floor((image + 4) / 3) - 1) * periodY * view.scale;
    pen.moveTo(pageX[first], pageY[first]);
    pen.lineTo(pageX[second] + x, pageY[second] + y);
    pen.moveTo(pageX[first] - x, pageY[first] - y);
  } else {
    pen.moveTo(pageX[first], pageY[first]);
  }
  pen.lineTo(pageX[second], pageY[second]);
}

function widthOf(i) {
  const first = pairs[2 * lines.pair[i]], second = pairs[2 * lines.pair[i] + 1];
  const r = first < 0 ? pageRadius[second] : Math.min(pageRadius[first], pageRadius[second]);
  return lines.level[i] === 0 && lines.friction[i] !== 2
    ? Math.min(1.5 * dots, Math.max(0.5, 0.08 * r))
    : Math.min(9 * dots, Math.max(1, 0.3 * r));
}

const contactSeen = i => {
  const first = pairs[2 * lines.pair[i]], second = pairs[2 * lines.pair[i] + 1];
  return isSeen(second) || (first >= 0 && isSeen(first));
};

/**
 * Draws the contacts, one colour after the other; the width is that for a particle of mean size.
 */
function drawContacts() {
  for (let c = 0; c < colours.length; ++c) {
    let width = 0, drawn = 0;
    pen.beginPath();
    for (let i = 0; i < lines.count; ++i)
      if (colourOf(i) === c && contactSeen(i)) {
        traceContact(i);
        width += widthOf(i);
        ++drawn;
      }
    if (!drawn) continue;
    pen.strokeStyle = colours[c];
    pen.lineWidth = width / drawn;
    pen.stroke();
  }
}
