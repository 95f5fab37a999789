/** Drag, pinch, wheel and keys on the map. */
import type { MapProjection } from './map-projection.ts';

const WHEEL = 0.0015;
const KEY_ZOOM = 1.4;
const KEY_PAN_PX = 40;
const PANS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [KEY_PAN_PX, 0],
  ArrowRight: [-KEY_PAN_PX, 0],
  ArrowUp: [0, KEY_PAN_PX],
  ArrowDown: [0, -KEY_PAN_PX],
};

/** @param onMoved called after each change; `panned` if the middle was moved by hand */
export function listenToGestures(
  canvas: HTMLCanvasElement,
  projection: MapProjection,
  onMoved: (panned: boolean) => void,
): void {
  const pointers = new Map<number, { x: number; y: number }>();
  const placeOf = ({ offsetX, offsetY }: MouseEvent) => ({ left: offsetX, top: offsetY });
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
  });
  canvas.addEventListener('pointermove', (event) => {
    const before = pointers.get(event.pointerId);
    if (before === undefined) return;
    const spread = spreadOf(pointers);
    const [dx, dy] = [event.offsetX - before.x, event.offsetY - before.y];
    before.x = event.offsetX;
    before.y = event.offsetY;
    if (pointers.size === 1) projection.pan(dx, dy);
    else if (spread > 0) {
      const [a, b] = [...pointers.values()] as [{ x: number; y: number }, { x: number; y: number }];
      projection.zoom(spreadOf(pointers) / spread, { left: (a.x + b.x) / 2, top: (a.y + b.y) / 2 });
    }
    onMoved(pointers.size === 1 && (dx !== 0 || dy !== 0));
  });
  for (const end of ['pointerup', 'pointercancel'] as const) {
    canvas.addEventListener(end, (event) => {
      pointers.delete(event.pointerId);
      // A map that kept the focus would take the arrow keys from driving.
      canvas.blur();
    });
  }
  canvas.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      projection.zoom(Math.exp(-event.deltaY * WHEEL), placeOf(event));
      onMoved(false);
    },
    { passive: false },
  );
  // Only where the keyboard has brought the focus here.
  canvas.addEventListener('keydown', (event) => {
    const pan = PANS[event.key];
    if (pan !== undefined) projection.pan(...pan);
    else if (event.key === '+' || event.key === '=') projection.zoom(KEY_ZOOM);
    else if (event.key === '-') projection.zoom(1 / KEY_ZOOM);
    else return;
    event.preventDefault();
    event.stopPropagation();
    onMoved(pan !== undefined);
  });
}

function spreadOf(pointers: ReadonlyMap<number, { x: number; y: number }>): number {
  const [a, b] = [...pointers.values()];
  return a === undefined || b === undefined ? 0 : Math.hypot(a.x - b.x, a.y - b.y);
}
