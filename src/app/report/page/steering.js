// Mouse, touch and keys.

/** Mouse, touch and keys move the camera, after which `moved` is called; `choose(patch)` is called for a click. */
function steer(view, choose, moved = () => view.redraw()) {
  const { canvas, camera } = view;
  const pointers = new Map();
  let travelled = 0, spread = 0;
  const pickAt = (clientX, clientY) => {
    const box = canvas.getBoundingClientRect();
    const x = (2 * (clientX - box.left)) / box.width - 1, y = 1 - (2 * (clientY - box.top)) / box.height;
    choose(view.pick(camera.ray(x, y, view.aspect)));
  };
  const spreadOf = ([a, b]) => Math.hypot(a.x - b.x, a.y - b.y);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture?.(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    travelled = pointers.size > 1 ? Infinity : 0; // a pinch is no click
    if (pointers.size === 2) spread = spreadOf([...pointers.values()]);
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const dx = event.clientX - last.x, dy = event.clientY - last.y, height = canvas.clientHeight;
    Object.assign(last, { x: event.clientX, y: event.clientY });
    travelled += Math.hypot(dx, dy);
    if (pointers.size === 2) {
      camera.move(-dx / (2 * height), dy / (2 * height));
      const now = spreadOf([...pointers.values()]);
      if (now > 0 && spread > 0) camera.zoom(spread / now);
      spread = now;
    } else if (event.shiftKey || (event.buttons & 6)) camera.move(-dx / height, dy / height);
    else camera.turn((-4 * dx) / height, (4 * dy) / height);
    moved();
  });
  const release = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    if (event.type === "pointerup" && event.button === 0 && travelled < 5) pickAt(event.clientX, event.clientY);
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    camera.zoom(Math.exp(0.0015 * event.deltaY * (event.deltaMode === 1 ? 16 : 1)));
    moved();
  }, { passive: false });
  const actions = {
    ArrowLeft: (moving) => (moving ? camera.move(-0.05, 0) : camera.turn(-0.1, 0)),
    ArrowRight: (moving) => (moving ? camera.move(0.05, 0) : camera.turn(0.1, 0)),
    ArrowUp: (moving) => (moving ? camera.move(0, 0.05) : camera.turn(0, 0.1)),
    ArrowDown: (moving) => (moving ? camera.move(0, -0.05) : camera.turn(0, -0.1)),
    "+": () => camera.zoom(1 / 1.15), "=": () => camera.zoom(1 / 1.15), "-": () => camera.zoom(1.15),
    Home: () => camera.reset(), Enter: () => choose(view.pick(camera.ray(0, 0, view.aspect))),
    Escape: () => choose(null),
  };
  canvas.addEventListener("keydown", (event) => {
    if (!actions[event.key] || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    actions[event.key](event.shiftKey);
    moved();
  });
}
