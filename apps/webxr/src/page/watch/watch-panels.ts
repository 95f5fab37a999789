/** The cameras beside the scene: name, whether it is live, and a button that shows or hides the camera. */
import { computed, effect, type ReadonlySignal } from '@preact/signals-core';
import type { CameraView } from '../../ground/pictures/camera-view.ts';
import type { Enlarged } from '../../state/enlarged.ts';

export interface WatchPanelsParts {
  readonly container: HTMLElement;
  readonly views: ReadonlySignal<readonly CameraView[]>;
  readonly enlarged: Enlarged;
  /** Whether anything arrives. */
  readonly live: ReadonlySignal<boolean>;
  /** Page's clock, ms, a few times a second. */
  readonly sampledAtMs: ReadonlySignal<number>;
}

/** A picture that was drawn longer ago than this is not live, ms. */
const STALE_MS = 1000;

export function showWatchPanels({ container, views, enlarged, live, sampledAtMs }: WatchPanelsParts): void {
  const panels = computed(() => views.value.map((view) => panelOf(view, () => enlarged.toggle(view))));
  effect(() => {
    container.replaceChildren(...panels.value.map(({ figure }) => figure));
    container.hidden = panels.value.length === 0;
  });
  effect(() => {
    const nowMs = sampledAtMs.value;
    for (const { view, figure, status, fault, button } of panels.value) {
      const shown = view.camera.on.value;
      const newest = view.newest.peek();
      const silentMs = newest === null ? null : nowMs - newest.drawnAtMs;
      const isLive = live.value && silentMs !== null && silentMs < STALE_MS;
      const wrong = view.fault.value;
      status.textContent = !shown ? 'hidden' : statusWords(isLive, silentMs);
      fault.textContent = wrong;
      fault.hidden = !shown || wrong === null;
      figure.dataset.state = shown ? stateOf(isLive, newest !== null, wrong !== null) : 'off';
      figure.dataset.enlarged = String(enlarged.view.value === view);
      view.canvas.hidden = !shown || newest === null;
      button.textContent = shown ? '–' : '+';
      button.ariaLabel = `${shown ? 'Hide' : 'Show'} ${view.camera.name}`;
    }
  });
}

/** As on the operator's page: what is not live has no colours. */
function stateOf(isLive: boolean, hasPicture: boolean, isFaulty: boolean): string {
  if (isFaulty) return 'fault';
  if (isLive) return 'live';
  return hasPicture ? 'frozen' : 'waiting';
}

function statusWords(isLive: boolean, silentMs: number | null): string {
  if (isLive) return 'live';
  return silentMs === null ? 'waiting' : `not live, ${(silentMs / 1000).toFixed(0)} s`;
}

function panelOf(view: CameraView, onEnlarge: () => void) {
  const figure = document.createElement('figure');
  figure.dataset.video = String(view.camera.index);
  const caption = document.createElement('figcaption');
  const name = document.createElement('span');
  name.className = 'name';
  name.textContent = view.camera.name;
  name.title = view.camera.name;
  const status = document.createElement('span');
  status.className = 'age';
  const button = document.createElement('button');
  button.type = 'button';
  button.className = 'quiet';
  button.addEventListener('click', () => view.toggle());
  const fault = document.createElement('p');
  fault.className = 'fault';
  view.canvas.title = 'Enlarge or reduce (E)';
  view.canvas.onclick = onEnlarge;
  caption.append(name, status, button);
  figure.append(caption, fault, view.canvas);
  return { view, figure, status, fault, button };
}
