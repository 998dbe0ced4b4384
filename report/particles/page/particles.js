// Plays the motion of particles that the page contains. report/particles/particles_page.cpp writes
// the data; the layout of the data must be changed there and here together.
'use strict';
(() => {
  const kSeconds = 10;        // duration of the whole motion at speed 1
  const kLargestSprite = 512; // [device pixels]
  const kThemes = {
    light: {paper: '#fbfbf9', solid: '#d8d8d4', edge: '#333', patch: 'rgba(120,120,105,.16)', grid: 'rgba(90,90,80,.35)', mark: '#d55e00'},
    dark: {paper: '#1f2326', solid: '#3b4044', edge: '#c8c8c4', patch: 'rgba(200,200,190,.10)', grid: 'rgba(200,200,190,.25)', mark: '#ffb000'},
  };
  const kDisc = {fill: '#a9c3da', edge: '#4f728f'};
  const kDiscInFluid = {fill: '#f1ece0', edge: '#3c3a34', mark: '#4a4a44'};
  const kBall = ['#e3eef7', '#a3bfd8', '#5b7f9f', '#34536e'];  // from the brightest point to the rim

  // ---- The motion

  const text = id => document.getElementById(id).textContent;
  function bytes(id) {
    const binary = atob(text(id)), array = new Uint8Array(binary.length);
    for (let i = 0; i < array.length; ++i) array[i] = binary.charCodeAt(i);
    return array.buffer;
  }
  const motion = JSON.parse(text('motion'));
  const dim = motion.dimension, flat = dim === 2;
  const disc = motion.flow ? kDiscInFluid : kDisc;
  // Lower left corner and lengths of the cell; a length is 0 where the motion has no period.
  const [cellX, cellY, periodX, periodY] = motion.cell;
  const radii = new Float32Array(bytes('radii')), times = new Float64Array(bytes('times'));
  // The ids of the particles in the files. Without this block, the id of particle k is k.
  const ids = document.getElementById('ids') ? new Int32Array(bytes('ids')) : null;
  const written = motion.bytes === 2 ? new Uint16Array(bytes('positions')) : new Float32Array(bytes('positions'));
  const planeNumbers = new Float32Array(bytes('planes'));
  const optional = (id, Kind) => (document.getElementById(id) ? new Kind(bytes(id)) : null);
  const writtenAngles = optional('angles', Float32Array);
  // Of each pair: x + 3 y, where the second particle is shifted by x and y periods.
  const images = optional('images', Int8Array);
  const pairs = new Int32Array(bytes('pairs')), offsets = new Uint32Array(bytes('offsets')), contactBytes = new Uint8Array(bytes('contacts'));
  const count = radii.length, frames = times.length, planeCount = frames ? planeNumbers.length / 6 / frames : 0;
  const low = flat ? [...motion.roomLow, 0] : motion.roomLow, high = flat ? [...motion.roomHigh, 0] : motion.roomHigh;
  const middle = low.map((l, d) => (l + high[d]) / 2);
  const diagonal = Math.hypot(...low.map((l, d) => high[d] - l));
  const firstTime = frames ? times[0] : 0, lastTime = frames ? times[frames - 1] : 0;

  const positions = new Float32Array(count * dim);  // at the present time
  const angles = new Float32Array(writtenAngles ? count : 0);
  // At the present time: {point, normal, radius}. With a radius > 0 it is a circle about `point`, whose
  // normal is 0.
  let planes = [];
  const lines = {frame: -1, count: 0, pair: new Int32Array(pairs.length / 2), level: new Uint8Array(pairs.length / 2)};

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

  /** Interpolates positions and planes between two frames; contacts are those of the nearer frame. */
  function setTime(time) {
    const {frame, share} = placeOf(time), n = count * dim;
    const from = frame * n, to = Math.min(frame + 1, frames - 1) * n;
    for (let d = 0; d < dim; ++d) {
      const period = [periodX, periodY, 0][d], begin = [cellX, cellY, 0][d];
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
    for (let k = 0; k < angles.length; ++k) angles[k] = (1 - share) * writtenAngles[fromAngle + k] + share * writtenAngles[toAngle + k];
    const m = planeCount * 6, fromPlane = frame * m, toPlane = Math.min(frame + 1, frames - 1) * m;
    planes = [];
    for (let i = 0; i < m; i += 6) {
      const x = [0, 1, 2, 3, 4, 5].map(j => (1 - share) * planeNumbers[fromPlane + i + j] + share * planeNumbers[toPlane + i + j]);
      const length = Math.hypot(x[3], x[4], x[5]) || 1, radius = dim === 2 ? x[5] : 0;
      planes.push({point: x.slice(0, 3), normal: x.slice(3).map(v => (radius ? 0 : v / length)), radius});
    }
    readContacts(Math.min(frames - 1, frame + Math.round(share)));
  }

  /** Decodes a frame's contacts: distance in the list of pairs (seven bits a byte), level of gamma. */
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
      lines.level[lines.count++] = contactBytes[at++];
    }
  }

  // ---- The view, in device pixels with y downwards

  const canvas = document.getElementById('stage'), pen = canvas.getContext('2d');
  const view = {scale: 1, x: 0, y: 0, turn: Math.PI / 6, above: Math.PI / 9, moved: false};
  let axes;  // unit vectors to the right, upwards and towards the reader
  let dots = 1;  // device pixels in a CSS pixel
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const plus = (a, s, b) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];

  function setAxes() {
    const c = Math.cos(view.turn), s = Math.sin(view.turn), ca = Math.cos(view.above), sa = Math.sin(view.above);
    axes = flat ? [[1, 0, 0], [0, 1, 0], [0, 0, 1]] : [[c, s, 0], [-s * sa, c * sa, ca], [s * ca, -c * ca, sa]];
  }

  /** The magnification by perspective, seen from four diagonals away; 0 behind the reader. */
  function nearness(depth) {
    if (flat) return 1;
    const distance = 4 * diagonal;
    return depth < 0.8 * distance ? distance / (distance - depth) : 0;
  }

  const onPage = {x: 0, y: 0, near: 0};  // result of project(); each call overwrites it
  function project(px, py, pz) {
    const x = px - middle[0], y = py - middle[1], z = pz - middle[2], [r, u, t] = axes;
    onPage.near = nearness(t[0] * x + t[1] * y + t[2] * z);
    const s = view.scale * onPage.near;
    onPage.x = canvas.width / 2 + view.x + s * (r[0] * x + r[1] * y + r[2] * z);
    onPage.y = canvas.height / 2 + view.y - s * (u[0] * x + u[1] * y + u[2] * z);
    return onPage;
  }

  /** Sets the view in which the box of the motion fills the canvas. */
  function showAll() {
    setAxes();
    Object.assign(view, {scale: 1, x: 0, y: 0, moved: false});
    let left = Infinity, right = -Infinity, top = Infinity, bottom = -Infinity;
    for (let corner = 0; corner < 8; ++corner) {
      const p = project(...low.map((l, d) => (corner >> d & 1 ? high[d] : l)));
      left = Math.min(left, p.x - canvas.width / 2);
      right = Math.max(right, p.x - canvas.width / 2);
      top = Math.min(top, p.y - canvas.height / 2);
      bottom = Math.max(bottom, p.y - canvas.height / 2);
    }
    view.scale = Math.min(canvas.width / (right - left), canvas.height / (bottom - top));
    view.x = -view.scale * (left + right) / 2;
    view.y = -view.scale * (top + bottom) / 2;
  }

  function zoom(factor, x = canvas.width / 2, y = canvas.height / 2) {
    const most = 1e6 * Math.max(canvas.width, canvas.height) / diagonal, next = Math.min(most, Math.max(1e-9 * most, view.scale * factor));
    factor = next / view.scale;
    view.scale = next;
    view.x = x - canvas.width / 2 + factor * (view.x - (x - canvas.width / 2));
    view.y = y - canvas.height / 2 + factor * (view.y - (y - canvas.height / 2));
    view.moved = true;
    redraw();
  }

  function resize() {
    const box = canvas.getBoundingClientRect();
    dots = window.devicePixelRatio || 1;
    const width = Math.max(1, Math.round(box.width * dots)), height = Math.max(1, Math.round(box.height * dots));
    if (width === canvas.width && height === canvas.height) return;
    const factor = Math.min(width / canvas.width, height / canvas.height);
    canvas.width = width;
    canvas.height = height;
    if (view.moved) { view.scale *= factor; view.x *= factor; view.y *= factor; } else showAll();
    draw();
  }

  // ---- Drawing

  let theme = kThemes.light, hovered = -1, withContacts = true;
  const flow = motion.flow ? viscontactFlow(motion.flow, bytes, (x, y) => project(x, y, 0)) : null;
  const flowField = document.getElementById('flow'), streamlines = document.getElementById('streamlines');

  function paintParticle(p, x, y, r) {
    const rim = Math.min(2 * dots, Math.max(0.5, 0.07 * r));
    if (flat) {
      p.fillStyle = disc.fill;
      p.strokeStyle = disc.edge;
    } else {
      const light = p.createRadialGradient(x - 0.28 * r, y - 0.36 * r, 0, x - 0.28 * r, y - 0.36 * r, 1.44 * r);
      for (let i = 0; i < 3; ++i) light.addColorStop(i / 2, kBall[i]);
      p.fillStyle = light;
      p.strokeStyle = kBall[3];
    }
    p.lineWidth = rim;
    p.beginPath();
    p.arc(x, y, Math.max(0, r - rim / 2), 0, 2 * Math.PI);
    p.fill();
    p.stroke();
  }

  // Copying a picture is faster than drawing thousands of spheres. There is one picture for each
  // power of two in size, so that none is reduced to less than half its size.
  const sprites = new Map();
  function spriteFor(size) {
    const side = 2 ** Math.ceil(Math.log2(Math.max(4, size)));
    if (!sprites.has(side)) {
      const sprite = document.createElement('canvas');
      sprite.width = sprite.height = side;
      paintParticle(sprite.getContext('2d'), side / 2, side / 2, side / 2);
      sprites.set(side, sprite);
    }
    return sprites.get(side);
  }

  function particle(x, y, r) {
    if (r < 1) pen.fillRect(x - Math.max(r, 0.35), y - Math.max(r, 0.35), 2 * Math.max(r, 0.35), 2 * Math.max(r, 0.35));
    else if (2 * r > kLargestSprite) paintParticle(pen, x, y, r);
    else pen.drawImage(spriteFor(2 * r), x - r, y - r, 2 * r, 2 * r);
  }

  /** The part of a polygon, or of a line with two ends, with normal.(x - point) >= -slack. */
  function clip(polygon, point, normal, slack = 0) {
    const kept = [];
    polygon.forEach((a, i) => {
      const b = polygon[(i + 1) % polygon.length];
      const u = dot(normal, plus(a, -1, point)) + slack, v = dot(normal, plus(b, -1, point)) + slack;
      if (u >= 0) kept.push(a);
      if ((u >= 0) !== (v >= 0)) kept.push(plus(a, u / (u - v), plus(b, -1, a)));
    });
    return kept;
  }

  function clipByPlanes(polygon, own) {
    planes.forEach((plane, i) => { if (i !== own) polygon = clip(polygon, plane.point, plane.normal, 1e-4 * diagonal); });
    return polygon;
  }

  function clipByRoom(polygon) {
    for (let d = 0; d < 3; ++d) {
      const axis = [0, 1, 2].map(e => (e === d ? 1 : 0));
      polygon = clip(clip(polygon, low, axis), high, axis.map(v => -v));
    }
    return polygon;
  }

  function trace(polygon) {
    polygon.forEach((x, i) => {
      const p = project(...x);
      if (i) pen.lineTo(p.x, p.y); else pen.moveTo(p.x, p.y);
    });
  }

  /** In two dimensions: the part of space that the canvas shows, as a polygon. */
  function seen() {
    const at = (x, y) => [middle[0] + (x - canvas.width / 2 - view.x) / view.scale, middle[1] - (y - canvas.height / 2 - view.y) / view.scale, 0];
    return [at(0, 0), at(canvas.width, 0), at(canvas.width, canvas.height), at(0, canvas.height)];
  }

  function traceCircle(point, radius) {
    const p = project(...point);
    pen.moveTo(p.x + radius * view.scale, p.y);
    pen.arc(p.x, p.y, radius * view.scale, 0, 2 * Math.PI);
  }

  function drawSolids() {
    const all = seen();
    pen.fillStyle = theme.solid;
    for (const {point, normal, radius} of planes) {
      pen.beginPath();
      if (radius) {
        trace([...all, all[0]]);
        traceCircle(point, radius);
      } else {
        trace(clip(all, point, normal.map(v => -v)));
      }
      pen.fill('evenodd');
    }
  }

  function drawLines() {
    const all = seen(), far = corner => Math.hypot(...plus(corner, -1, middle));
    pen.strokeStyle = theme.edge;
    pen.lineWidth = 2 * dots;
    planes.forEach(({point, normal, radius}, i) => {
      if (radius) {
        pen.beginPath();
        traceCircle(point, radius);
        pen.stroke();
        return;
      }
      const reach = Math.max(...all.map(far)) + Math.hypot(...plus(point, -1, middle)), along = [-normal[1], normal[0], 0];
      pen.beginPath();
      trace(clipByPlanes([plus(point, -reach, along), plus(point, reach, along)], i));
      pen.stroke();
    });
  }

  /**
   * In three dimensions: a plane seen from its free side is a patch with a grid; of a plane seen from
   * behind, only the edges are drawn.
   */
  function drawPatches(fromFreeSide) {
    const step = 10 ** Math.round(Math.log10(diagonal / 8));
    planes.forEach(({point, normal}, i) => {
      if ((dot(normal, axes[2]) > 0) !== fromFreeSide) return;
      const size = normal.map(Math.abs), least = size.indexOf(Math.min(...size));
      const axis = [0, 1, 2].map(d => (d === least ? 1 : 0) - normal[least] * normal[d]), length = Math.hypot(...axis);
      const u = axis.map(v => v / length);
      const v = [normal[1] * u[2] - normal[2] * u[1], normal[2] * u[0] - normal[0] * u[2], normal[0] * u[1] - normal[1] * u[0]];
      const foot = plus(middle, -dot(normal, plus(middle, -1, point)), normal), reach = diagonal;
      const at = (a, b) => plus(plus(foot, a, u), b, v);
      const patch = clipByPlanes(clipByRoom([at(-reach, -reach), at(reach, -reach), at(reach, reach), at(-reach, reach)]), i);
      if (patch.length < 3) return;
      pen.lineWidth = dots;
      pen.strokeStyle = theme.grid;
      pen.fillStyle = theme.patch;
      pen.beginPath();
      trace(patch);
      pen.closePath();
      if (fromFreeSide) {
        pen.fill();
        for (let k = Math.ceil(-reach / step); k * step < reach; ++k)
          for (const line of [[at(k * step, -reach), at(k * step, reach)], [at(-reach, k * step), at(reach, k * step)]])
            trace(clipByPlanes(clipByRoom(line), i));
      }
      pen.stroke();
    });
  }

  const pageX = new Float32Array(count), pageY = new Float32Array(count), pageRadius = new Float32Array(count), depths = new Float32Array(count);
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
   * Sorts the particles into 4096 layers of depth; within a layer they keep their order. Particles that
   * overlap on the page are in different layers, unless they are very small.
   */
  function sortByDepth() {
    const layers = 4096, start = new Uint32Array(layers + 1), half = diagonal / 2, centre = dot(axes[2], middle);
    const layerOf = k => Math.min(layers - 1, Math.max(0, Math.floor(layers * ((depths[k] - centre) / half + 1) / 2))) || 0;
    for (let k = 0; k < count; ++k) ++start[layerOf(k) + 1];
    for (let i = 0; i < layers; ++i) start[i + 1] += start[i];
    for (let k = 0; k < count; ++k) order[start[layerOf(k)]++] = k;
  }

  const isSeen = k => {
    const r = pageRadius[k];
    return r > 0 && pageX[k] > -r && pageX[k] < canvas.width + r && pageY[k] > -r && pageY[k] < canvas.height + r;
  };

  // The colours of contacts: index 0 is for gamma = 0, the others for gamma < 0 from light to dark.
  const colours = [motion.touching, ...motion.colours];
  const colourOf = level => (level === 0 ? 0 : 1 + Math.round(level / 255 * (motion.colours.length - 1)));

  /** The line of a contact, from a centre to the other centre or to the foot on the plane. */
  function traceContact(i) {
    const image = images ? images[lines.pair[i]] : 0;
    const first = pairs[2 * lines.pair[i]], second = pairs[2 * lines.pair[i] + 1];
    if (first < 0) {
      const {point, normal, radius} = planes[-1 - first];
      const x = [0, 1, 2].map(d => (d < dim ? positions[second * dim + d] : 0)), from = plus(x, -1, point);
      const foot = radius ? plus(point, radius / (Math.hypot(...from) || 1), from) : plus(x, -dot(normal, from), normal);
      const p = project(...foot);
      pen.moveTo(p.x, p.y);
    } else if (image) {
      // Across a period the line is drawn at both sides of the cell.
      const x = ((image + 4) % 3 - 1) * periodX * view.scale, y = -(Math.floor((image + 4) / 3) - 1) * periodY * view.scale;
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
    return lines.level[i] === 0 ? Math.min(1.5 * dots, Math.max(0.5, 0.08 * r)) : Math.min(9 * dots, Math.max(1, 0.3 * r));
  }

  const contactSeen = i => {
    const first = pairs[2 * lines.pair[i]], second = pairs[2 * lines.pair[i] + 1];
    return isSeen(second) || (first >= 0 && isSeen(first));
  };

  /** Draws the contacts, one colour after the other; the width is that for a particle of mean size. */
  function drawContacts() {
    for (let c = 0; c < colours.length; ++c) {
      let width = 0, drawn = 0;
      pen.beginPath();
      for (let i = 0; i < lines.count; ++i)
        if (colourOf(lines.level[i]) === c && contactSeen(i)) {
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

  const rank = new Uint32Array(flat ? 0 : count), chain = new Int32Array(flat ? 0 : count), chained = new Int32Array(flat ? 0 : lines.pair.length);

  /**
   * Draws the spheres from far to near. A contact is drawn with the nearer of its particles: over both
   * particles, and under everything in front of them.
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
        pen.fillStyle = kBall[1];
        particle(pageX[k], pageY[k], pageRadius[k]);
      }
      for (let i = chain[k]; i >= 0; i = chained[i]) {
        if (!contactSeen(i)) continue;
        pen.strokeStyle = colours[colourOf(lines.level[i])];
        pen.lineWidth = widthOf(i);
        pen.beginPath();
        traceContact(i);
        pen.stroke();
      }
    }
  }

  /** A dot at the rim, which shows how far a disc has turned. */
  function drawMark(k, x, y) {
    const r = pageRadius[k];
    if (r < 4 * dots) return;
    pen.beginPath();
    pen.arc(x + 0.66 * r * Math.cos(angles[k]), y - 0.66 * r * Math.sin(angles[k]), 0.13 * r, 0, 2 * Math.PI);
    pen.fillStyle = disc.mark || disc.edge;
    pen.fill();
  }

  function drawDiscs() {
    for (let k = 0; k < count; ++k) {
      const x = positions[2 * k], y = positions[2 * k + 1], r = radii[k];
      // The image at the other side of the cell, if the disc sticks out of it.
      const besideX = !periodX ? 0 : x - r < cellX ? periodX : x + r > cellX + periodX ? -periodX : 0;
      const besideY = !periodY ? 0 : y - r < cellY ? periodY : y + r > cellY + periodY ? -periodY : 0;
      for (const shiftX of besideX ? [0, besideX] : [0])
        for (const shiftY of besideY ? [0, besideY] : [0]) {
          const pageAtX = pageX[k] + view.scale * shiftX, pageAtY = pageY[k] - view.scale * shiftY, size = pageRadius[k];
          if (pageAtX < -size || pageAtX > canvas.width + size || pageAtY < -size || pageAtY > canvas.height + size) continue;
          pen.fillStyle = disc.fill;
          particle(pageAtX, pageAtY, size);
          if (angles.length) drawMark(k, pageAtX, pageAtY);
        }
    }
  }

  /** Draws only in the cell, where the motion has periods. */
  function clipToCell() {
    const from = {...project(cellX, cellY, 0)}, to = {...project(cellX + periodX, cellY + periodY, 0)};
    pen.beginPath();
    pen.rect(periodX ? from.x : 0, periodY ? to.y : 0, periodX ? to.x - from.x : canvas.width, periodY ? from.y - to.y : canvas.height);
    pen.clip();
  }

  /** The sides of the cell that are one, as dashed lines. */
  function drawPeriods() {
    const from = {...project(cellX, cellY, 0)}, to = {...project(cellX + periodX, cellY + periodY, 0)};
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
      drawLines();
      if (withContacts) drawContacts();
      pen.restore();
      if (periodX || periodY) drawPeriods();
    } else {
      drawPatches(true);
      drawSpheres();
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

  // ---- The particle at the pointer

  const readout = document.getElementById('readout');
  const pointer = {x: 0, y: 0, inside: false};
  const number = x => String(Number(x.toPrecision(4))).replace('-', '\u2212');

  function readPointer() {
    hovered = -1;
    if (pointer.inside && frames) {
      placeParticles();
      const reach = 3 * dots;  // so that very small particles can be hit
      for (let j = count - 1; j >= 0 && hovered < 0; --j) {
        const k = flat ? j : order[j], r = Math.max(reach, pageRadius[k]);
        if (pageRadius[k] > 0 && (pageX[k] - pointer.x) ** 2 + (pageY[k] - pointer.y) ** 2 <= r * r) hovered = k;
      }
    }
    if (hovered < 0) { readout.textContent = ''; return; }
    let contacts = 0;
    for (let i = 0; i < lines.count; ++i)
      if (pairs[2 * lines.pair[i]] === hovered || pairs[2 * lines.pair[i] + 1] === hovered) ++contacts;
    // On an axis, the first coordinate is 0 for all particles.
    const place = [...positions.subarray(hovered * dim + (motion.hasAxis ? 1 : 0), hovered * dim + dim)].map(number).join(', ');
    readout.textContent = `particle ${ids ? ids[hovered] : hovered * motion.every}: radius ${number(radii[hovered])}, at (${place}), ` +
        `${contacts} contact${contacts === 1 ? '' : 's'}`;
  }

  // ---- Time

  const slider = document.getElementById('time'), clock = document.getElementById('clock'), button = document.getElementById('play');
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
  document.getElementById('films').addEventListener('change', event => { withContacts = event.target.checked; redraw(); });
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

  // ---- Pointers: one pointer moves or turns the view, two pointers zoom

  const held = new Map();
  const onCanvas = event => {
    const box = canvas.getBoundingClientRect();
    return {x: (event.clientX - box.left) * canvas.width / box.width, y: (event.clientY - box.top) * canvas.height / box.height};
  };

  canvas.addEventListener('pointerdown', event => {
    // Pointers of events that a script made cannot be captured.
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
        zoom(gap(now, others[0]) / gap(before, others[0]), (before.x + others[0].x) / 2, (before.y + others[0].y) / 2);
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
    // After a finger is lifted, the values that it read stay.
    if (event.type === 'pointerleave' && event.pointerType === 'mouse') pointer.inside = false;
    redraw();
  };
  for (const name of ['pointerup', 'pointercancel', 'pointerleave']) canvas.addEventListener(name, letGo);
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    const at = onCanvas(event), lineHeight = event.deltaMode === 1 ? 16 : 1;
    zoom(Math.exp(-0.0015 * Math.max(-400, Math.min(400, event.deltaY * lineHeight))), at.x, at.y);
  }, {passive: false});
  canvas.addEventListener('dblclick', () => { showAll(); redraw(); });

  // ---- Light and dark colours; printed pages are light

  const dark = matchMedia('(prefers-color-scheme: dark)');
  const setTheme = isDark => { theme = isDark ? kThemes.dark : kThemes.light; draw(); };
  dark.addEventListener('change', () => setTheme(dark.matches));
  window.addEventListener('beforeprint', () => setTheme(false));
  window.addEventListener('afterprint', () => setTheme(dark.matches));

  player.seek(firstTime);
  theme = dark.matches ? kThemes.dark : kThemes.light;
  resize();
  new ResizeObserver(() => { if (!matchMedia('print').matches) resize(); }).observe(canvas);
  window.viscontactPlayer = player;
})();
