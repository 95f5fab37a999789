/** The panels with the cameras' pictures and videos: name, age, and buttons that hide the camera or let it fill the screen. */
import { computed, effect, type ReadonlySignal } from '@preact/signals-core';
import type { CameraView } from '../../ground/pictures/camera-view.ts';
import type { PageState } from '../../state/page-state.ts';
import { cameraWords } from '../../words/camera-words.ts';
import { elements } from './elements.ts';
import { panelArea } from './panel-area.ts';
import { type MovablePanel, PanelMover, type PanelMoverParts, showResetButton } from './panel-mover.ts';
import { quietButton } from './panel-parts.ts';
import { showStagedCamera } from './staged-camera.ts';
import { videoReportPanel } from './video-report-panel.ts';

interface Panel extends MovablePanel {
  view: CameraView;
  caption: HTMLElement;
  age: HTMLElement;
  fault: HTMLElement;
  hide: HTMLButtonElement;
  swap: HTMLButtonElement;
}

export interface PicturePanelsParts {
  readonly inVr: ReadonlySignal<boolean>;
  /** Whether a grip is held, so that the arrow keys drive. */
  isGripped(): boolean;
}

export function showPicturePanels(state: PageState, { inVr, isGripped }: PicturePanelsParts): void {
  const { views, enlarged, placements, sampledAtMs } = state;
  // In VR the headset needs the cloud's canvas as it is.
  const filling = computed(() => (inVr.value ? null : state.staged.view.value));
  const parts: PanelMoverParts = { placements, area: panelArea(), isGripped };
  const mover = new PanelMover(parts);
  const panels = computed(() =>
    views.value.map((view) => {
      const panel = panelOf(view, state, filling);
      mover.attach(panel);
      return panel;
    }),
  );
  const reset = quietButton('Reset panels', 'Put all panels into their usual places', () => undefined);
  showResetButton(reset, parts);
  const tools = document.createElement('div');
  tools.className = 'tools';
  tools.append(videoReportPanel(state), reset);
  effect(() => {
    elements.pictures.replaceChildren(...panels.value.map(({ figure }) => figure), tools);
    elements.pictures.hidden = panels.value.length === 0;
  });
  showStagedCamera(filling, sampledAtMs);
  effect(() => {
    for (const { view, hide, swap } of panels.value) {
      const { name } = view.camera;
      const shown = view.camera.on.value;
      hide.textContent = shown ? '–' : '+';
      hide.ariaLabel = `${shown ? 'Hide' : 'Show'} ${name}`;
      const fills = filling.value === view;
      swap.ariaLabel = fills ? 'Fill the screen with the cloud' : `Fill the screen with ${name}`;
      swap.title = `${swap.ariaLabel} (F)`;
      swap.hidden = !shown;
    }
  });
  effect(() => {
    for (const { view, figure, caption } of panels.value) {
      figure.dataset.enlarged = String(enlarged.view.value === view);
      const fills = filling.value === view;
      figure.dataset.staged = String(fills);
      caption.textContent = fills ? 'Cloud' : view.camera.name;
    }
  });
  effect(() => {
    // The age of a video changes with each of its frames: faster than anybody reads.
    void sampledAtMs.value;
    for (const panel of panels.value) showState(panel, filling.value === panel.view);
    mover.apply(panels.value, ({ figure }) => figure.dataset.enlarged === 'true');
  });
}

function showState({ view, figure, age, fault }: Panel, fills: boolean): void {
  const { state, text, reason } = cameraWords(view);
  const words = fills ? `${view.camera.name} ${text}` : text;
  if (age.textContent !== words) age.textContent = words;
  if (fault.textContent !== reason) fault.textContent = reason;
  fault.hidden = reason === null;
  figure.dataset.state = state;
  view.canvas.hidden = state === 'off' || view.ageMs.peek() === null;
}

function panelOf(view: CameraView, state: PageState, filling: ReadonlySignal<CameraView | null>): Panel {
  const figure = document.createElement('figure');
  figure.dataset[view.kind === 'video' ? 'video' : 'camera'] = String(view.camera.index);
  const { name } = view.camera;
  figure.ariaLabel = name;
  const title = document.createElement('figcaption');
  const caption = document.createElement('span');
  caption.className = 'name';
  caption.title = `${name}: drag to move, or use the arrow keys, + and -`;
  const age = document.createElement('span');
  age.className = 'age';
  const hide = quietButton('', '', () => view.toggle());
  const swap = quietButton('⇄', '', () => state.swap(view));
  swap.classList.add('swap');
  const fault = document.createElement('p');
  fault.className = 'fault';
  view.canvas.title = 'Enlarge or reduce (E)';
  view.canvas.onclick = () => {
    if (filling.peek() !== view) state.enlarged.toggle(view);
  };
  title.append(caption, age, swap, hide);
  figure.append(title, fault, view.canvas);
  const picture = () => (filling.peek() === view ? elements.stage : view.canvas);
  return { view, name: `${view.kind}:${name}`, figure, title, caption, age, fault, hide, swap, picture };
}
