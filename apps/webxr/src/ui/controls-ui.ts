/** Buttons, mouse, wheel and keys to what they do. */
import { LatencyError, robotAfter } from '@farpoint/operator';
import type { PageParts } from '../page-parts.ts';
import { elements } from './elements.ts';
import type { EstopUi } from './estop-ui.ts';
import { notify } from './notice.ts';
import type { Action } from './operator-inputs.ts';
import { initRobotSwitcher } from './robot-switcher.ts';
import { initSettingsDialog } from './settings-dialog.ts';

const latencyFailureWords: Record<LatencyError['reason'], string> = {
  timeout: 'No green cloud came: the request or the whole cloud was lost.',
  'no-session': 'Connect to a robot first.',
  'no-lease': 'Someone else drives: only the driver can measure.',
  busy: 'A latency test runs already.',
};

export class ControlsUi {
  readonly #app: PageParts;
  readonly #estop: EstopUi;

  constructor(app: PageParts, estop: EstopUi) {
    this.#app = app;
    this.#estop = estop;
  }

  start(): void {
    const app = this.#app;
    elements.disconnect.addEventListener('click', () => app.client.leave());
    this.#estop.start();
    elements.latency.addEventListener('click', ({ timeStamp }) => this.act('latency-test', timeStamp));
    elements.view.addEventListener('click', () => this.act('view', performance.now()));
    elements.take.addEventListener('click', () => app.client.takeOver());
    elements.release.addEventListener('click', () => app.client.driver.releaseLease());
    // A button that keeps the focus would take the space bar.
    for (const button of document.querySelectorAll<HTMLButtonElement>('#bar button, #drive button')) {
      button.addEventListener('click', () => button.blur());
    }
    initRobotSwitcher((robotId) => app.choose(robotId));
    initSettingsDialog((scale) => {
      app.cloud.sizeScale = scale;
      app.clouds.sizeScale = scale;
    });
    this.#startVr();
    this.#startLook();
  }

  act(action: Action, timeMs: number): void {
    const { stage } = this.#app;
    switch (action) {
      case 'estop':
        this.#estop.stop();
        return;
      case 'latency-test':
        this.#app.client.latencyTest(timeMs).then(
          ({ mtpMs, firstMs }) =>
            notify(`Motion to photon ${mtpMs.toFixed(0)} ms (first points ${firstMs.toFixed(0)} ms)`, 'good'),
          (error: unknown) => {
            if (!(error instanceof LatencyError)) throw error;
            notify(latencyFailureWords[error.reason], 'warning');
          },
        );
        return;
      case 'recentre':
        stage.look.recentre();
        return;
      case 'view':
        stage.look.switchMode();
        return;
      case 'next-robot':
        this.#nextRobot();
    }
  }

  #nextRobot(): void {
    const { chosenRobotId, robots } = this.#app.client;
    if (chosenRobotId === null) return;
    const next = robotAfter(robots, chosenRobotId);
    if (next === null) notify('No other robot is here.');
    else this.#app.choose(next.id);
  }

  #startVr(): void {
    const { vr } = this.#app;
    const offer = async (): Promise<void> => {
      const reason = await vr.unavailable();
      elements.vr.hidden = reason !== null;
      elements.vrReason.hidden = reason === null;
      elements.vrReason.textContent = reason;
    };
    void offer();
    navigator.xr?.addEventListener('devicechange', () => void offer());
    elements.vr.addEventListener('click', () => {
      vr.toggle().catch((error: unknown) => {
        notify(`VR could not be entered: ${error instanceof Error ? error.message : error}`, 'bad');
      });
    });
  }

  #startLook(): void {
    const { stage } = elements;
    const { look, camera } = this.#app.stage;
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
}
