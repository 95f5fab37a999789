import type { Stage } from '../../scene/view/stage.ts';

/** Looking around with mouse, fingers and wheel. */
export function startLook(stage: HTMLCanvasElement, { look, camera }: Pick<Stage, 'look' | 'camera'>): void {
  const pointers = new Map<number, { x: number; y: number }>();
  stage.addEventListener('pointerdown', (event) => {
    stage.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  stage.addEventListener('pointermove', (event) => {
    const before = pointers.get(event.pointerId);
    if (before === undefined) return;
    const [dx, dy] = [event.clientX - before.x, event.clientY - before.y];
    if (pointers.size === 1) {
      look.drag(dx, dy, ((camera.fov / 180) * Math.PI) / stage.clientHeight);
    } else {
      const [a, b] = [...pointers.values()] as [{ x: number; y: number }, { x: number; y: number }];
      const spread = Math.hypot(a.x - b.x, a.y - b.y);
      before.x = event.clientX;
      before.y = event.clientY;
      const spreadNow = Math.hypot(a.x - b.x, a.y - b.y);
      if (spread > 0 && spreadNow > 0) look.zoom(spread / spreadNow);
    }
    before.x = event.clientX;
    before.y = event.clientY;
  });
  for (const end of ['pointerup', 'pointercancel'] as const) {
    stage.addEventListener(end, (event) => pointers.delete(event.pointerId));
  }
  stage.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      look.zoom(Math.exp(event.deltaY * 0.001));
    },
    { passive: false },
  );
  stage.addEventListener('dblclick', () => look.recentre());
  stage.addEventListener('contextmenu', (event) => event.preventDefault());
}
