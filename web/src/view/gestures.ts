// Pointer, touch and wheel on the thing in the picture. What happens beside it is left to the page: scrolling, and the buttons
// of the faces, even where the thing is in front of them.

interface Handlers {
  hits(x: number, y: number): boolean; // shares of width and height, from the top left
  move(dx: number, dy: number): void;
  away(factor: number): void;
  taken(): void;
}

const perWheelPixel = 1.001; // farther, down
const pixelsPerLine = 16;

// Returns what takes the listeners away.
export function followPointer(frame: HTMLElement, handlers: Handlers): () => void {
  let held: { pointer: number; x: number; y: number } | null = null;

  const hit = (at: { clientX: number; clientY: number }) => {
    const box = frame.getBoundingClientRect();
    return handlers.hits((at.clientX - box.left) / box.width, (at.clientY - box.top) / box.height);
  };
  const down = (event: PointerEvent) => {
    if (held || event.button !== 0 || !hit(event)) return;
    held = { pointer: event.pointerId, x: event.clientX, y: event.clientY };
    // From here on all of the pointer's events come to the frame, not to a button under it.
    frame.setPointerCapture(event.pointerId);
    event.preventDefault();
    event.stopPropagation();
    frame.dataset['held'] = 'true';
    handlers.taken();
  };
  const move = (event: PointerEvent) => {
    if (!held) {
      frame.dataset['over'] = String(event.pointerType === 'mouse' && hit(event));
      return;
    }
    if (event.pointerId !== held.pointer) return;
    const box = frame.getBoundingClientRect();
    handlers.move((event.clientX - held.x) / box.width, (event.clientY - held.y) / box.height);
    held = { ...held, x: event.clientX, y: event.clientY };
  };
  const up = (event: PointerEvent) => {
    if (held?.pointer !== event.pointerId) return;
    held = null;
    delete frame.dataset['held'];
  };
  const touch = (event: TouchEvent) => {
    const finger = event.touches[0];
    // Else the page scrolls and the pointer is taken from us.
    if (finger && hit(finger)) event.preventDefault();
  };
  const wheel = (event: WheelEvent) => {
    // With Ctrl the browser zooms.
    if (event.ctrlKey || !hit(event)) return;
    event.preventDefault();
    const pixels = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? event.deltaY : event.deltaY * pixelsPerLine;
    handlers.away(perWheelPixel ** pixels);
  };

  frame.addEventListener('pointerdown', down, { capture: true });
  frame.addEventListener('pointermove', move);
  frame.addEventListener('pointerup', up);
  frame.addEventListener('pointercancel', up);
  frame.addEventListener('touchstart', touch, { passive: false });
  frame.addEventListener('wheel', wheel, { passive: false });
  return () => {
    frame.removeEventListener('pointerdown', down, { capture: true });
    frame.removeEventListener('pointermove', move);
    frame.removeEventListener('pointerup', up);
    frame.removeEventListener('pointercancel', up);
    frame.removeEventListener('touchstart', touch);
    frame.removeEventListener('wheel', wheel);
    delete frame.dataset['over'];
    delete frame.dataset['held'];
  };
}
