// Let the user move and zoom the map; `chosen` gets the pose of the path that was clicked, `index` gives
// the pose of now. Returns what to call where the camera was changed otherwise.
const listenTo = (view, chosen, index) => {
  const held = new Map();
  let way = 0;
  const at = event => { const box = view.stage.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };
  const changed = () => { view.touched = true; view.forget(); view.moved(); };
  view.stage.addEventListener("pointerdown", event => {
    view.stage.setPointerCapture(event.pointerId);
    if (!held.size) way = 0;
    held.set(event.pointerId, at(event));
  });
  view.stage.addEventListener("pointermove", event => {
    const before = held.get(event.pointerId);
    if (!before) return;
    const now = at(event);
    const others = [...held].filter(([id]) => id !== event.pointerId);
    const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
    way += Math.abs(dx) + Math.abs(dy);
    held.set(event.pointerId, now);
    if (way <= 4) return;
    view.stage.classList.add("dragged");
    if (others.length) {
      const [ox, oy] = others[0][1];
      const reach = point => Math.max(Math.hypot(point[0] - ox, point[1] - oy), 1);
      view.camera.zoom(reach(now) / reach(before), ox, oy);
    } else view.camera.move(dx, dy);
    changed();
  });
  const release = event => {
    const was = held.delete(event.pointerId);
    view.stage.classList.remove("dragged");
    if (!was || way > 4 || event.type !== "pointerup") return;
    const pose = view.poseAt(...at(event), index());
    if (pose >= 0) chosen(pose);
  };
  view.stage.addEventListener("pointerup", release);
  view.stage.addEventListener("pointercancel", release);
  view.stage.addEventListener("wheel", event => {
    event.preventDefault();
    view.camera.zoom(Math.exp(-event.deltaY * 0.0015), ...at(event));
    changed();
  }, { passive: false });
  view.stage.addEventListener("keydown", event => {
    const step = { ArrowLeft: [60, 0], ArrowRight: [-60, 0], ArrowUp: [0, 60], ArrowDown: [0, -60] }[event.key];
    if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    view.camera.move(...step);
    changed();
  });
  return changed;
};
