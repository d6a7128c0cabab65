// Mouse, pen and fingers on the plan: clicks, drags of marks, shifting, pinching.

const STILL_PX = 6;  // a pointer that has moved less than this has clicked

/** Call back with places in pixels from the corner of `surface`. */
export function follow(surface, { onClick, onGrab, onDrag, onDrop, onPan, onPinch }) {
  const pointers = new Map();
  let grabbed = null;  // the key of a mark that is dragged
  let moved = false;
  let first = null;

  const at = event => {
    const box = surface.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return { middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], apart: Math.hypot(a[0] - b[0], a[1] - b[1]) };
  };

  surface.addEventListener("pointerdown", event => {
    if (event.button !== 0) return;
    const place = at(event);
    pointers.set(event.pointerId, place);
    surface.setPointerCapture(event.pointerId);
    if (pointers.size > 1) {  // a pinch: no click, and no mark moves
      if (grabbed) onDrop(grabbed, false);
      grabbed = null;
      moved = true;
      return;
    }
    first = place;
    moved = false;
    grabbed = event.target.closest(".mark")?.dataset.key ?? null;
    if (grabbed) onGrab(grabbed, place);
  });

  surface.addEventListener("pointermove", event => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const place = at(event);
    if (pointers.size === 2) {
      const was = spread();
      pointers.set(event.pointerId, place);
      const is = spread();
      onPan(is.middle[0] - was.middle[0], is.middle[1] - was.middle[1]);
      onPinch(is.apart / Math.max(was.apart, 1), ...is.middle);
      return;
    }
    if (pointers.size > 2) return;
    if (!moved && Math.hypot(place[0] - first[0], place[1] - first[1]) < STILL_PX) return;
    if (grabbed) onDrag(grabbed, place);
    else onPan(place[0] - (moved ? before[0] : first[0]), place[1] - (moved ? before[1] : first[1]));
    moved = true;
    surface.classList.toggle("panning", !grabbed);
    pointers.set(event.pointerId, place);
  });

  const release = (event, counts) => {
    if (!pointers.delete(event.pointerId)) return;
    surface.classList.remove("panning");
    if (pointers.size) return;
    if (grabbed) onDrop(grabbed, moved && counts);
    else if (!moved && counts) onClick(at(event));
    grabbed = null;
  };
  surface.addEventListener("pointerup", event => release(event, true));
  surface.addEventListener("pointercancel", event => release(event, false));

  surface.addEventListener("wheel", event => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    onPinch(Math.exp(-event.deltaY * lines * (event.ctrlKey ? 0.01 : 0.0018)), ...at(event));
  }, { passive: false });
}
