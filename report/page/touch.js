// What fingers do on a plot of panels.js: one finger reads values, two fingers zoom, a double tap
// resets the axes. Moving one finger up or down still scrolls the page. report/report_plot.cpp
// writes the plot.

function addTouch(u, reset) {
  const over = u.over;
  const spot = touch => {
    const box = over.getBoundingClientRect();
    return {x: touch.clientX - box.left, y: touch.clientY - box.top};
  };
  let pinch = null, lastTap = 0;
  over.addEventListener('touchstart', event => {
    if (event.touches.length === 1) {
      if (event.timeStamp - lastTap < 300) reset();
      lastTap = event.timeStamp;
      const {x, y} = spot(event.touches[0]);
      u.setCursor({left: x, top: y});
    } else if (event.touches.length === 2) {
      const spots = [spot(event.touches[0]), spot(event.touches[1])];
      // The point under each finger stays under it.
      const x = spots.map(s => u.posToVal(s.x, 'x')), y = spots.map(s => u.posToVal(s.y, 'y'));
      pinch = {spots, x, y};
      event.preventDefault();
    }
  }, {passive: false});
  over.addEventListener('touchmove', event => {
    if (event.touches.length === 1 && !pinch) {
      const {x, y} = spot(event.touches[0]);
      u.setCursor({left: x, top: y});
    } else if (event.touches.length === 2 && pinch) {
      event.preventDefault();
      const now = [spot(event.touches[0]), spot(event.touches[1])];
      const along = (name, values, positions, length, upward) => {
        const apart = positions[1] - positions[0];
        // Fingers that are close in this direction (pixels) do not zoom in it.
        if (Math.abs(apart) < 40) return;
        const slope = (values[1] - values[0]) / apart, start = values[0] - slope * positions[0];
        const ends = [start, start + slope * length];
        u.setScale(name, upward ? {min: ends[1], max: ends[0]} : {min: ends[0], max: ends[1]});
      };
      u.batch(() => {
        along('x', pinch.x, now.map(s => s.x), over.clientWidth, false);
        along('y', pinch.y, now.map(s => s.y), over.clientHeight, true);
      });
    }
  }, {passive: false});
  over.addEventListener('touchend', event => { if (event.touches.length === 0) pinch = null; });
}
