/** The panels with the cameras' pictures and videos: name, age, and buttons that hide the camera or let it fill the screen. */
import { computed, effect, type ReadonlySignal, signal } from '@preact/signals-core';
import type { Box } from '../../ground/panels/panel-layout.ts';
import type { CameraView } from '../../ground/pictures/camera-view.ts';
import { PRIORITIES } from '../../state/link-priority.ts';
import type { PageState } from '../../state/page-state.ts';
import { cameraWords } from '../../words/camera-words.ts';
import { texts } from '../../words/language.ts';
import { videoReport } from '../../words/video-report.ts';
import { elements } from './elements.ts';
import { followKey } from './key-title.ts';
import { type MovablePanel, PanelMover, type PanelMoverParts, showResetButton } from './panel-mover.ts';
import { quietButton, rowOf, selectOf } from './panel-parts.ts';

/**
 * Below the cameras' panels: whether the videos are in step, and on a click what the compositor did with each, and how the
 * link is divided.
 */
function videoReportPanel({ figures, videos, priority }: PageState): HTMLElement {
  const open = signal(false);
  const panel = document.createElement('section');
  panel.className = 'video-report';
  const button = quietButton('', texts().clouds.reportTitle, () => {
    open.value = !open.peek();
  });
  const list = document.createElement('dl');
  const share = shareControl(priority);
  panel.append(button, share, list);
  effect(() => {
    // Where the strip has no room for it, it is scrolled to.
    if (open.value) requestAnimationFrame(() => panel.scrollIntoView({ block: 'nearest' }));
  });
  effect(() => {
    const names = videos.views.value.map(({ camera }) => camera.name);
    panel.hidden = names.length === 0;
    if (names.length === 0) return;
    const { summary, tone, lines } = videoReport(figures.value.videos, names);
    if (button.textContent !== summary) button.textContent = summary;
    button.dataset.tone = tone;
    button.ariaExpanded = String(open.value);
    list.hidden = !open.value;
    share.hidden = !open.value;
    if (open.value)
      list.replaceChildren(
        ...lines.flatMap(({ name, text, tone }) => [textOf('dt', name), textOf('dd', text, tone)]),
      );
  });
  return panel;
}

/** What comes first where the link does not carry everything. */
function shareControl({ chosen }: PageState['priority']): HTMLElement {
  const said = texts().clouds;
  const choice = { label: said.slowLinkTitle, values: PRIORITIES, texts: said.priorities };
  const select = selectOf(choice, (priority) => {
    chosen.value = priority;
  });
  select.selectedIndex = PRIORITIES.indexOf(chosen.peek());
  const row = rowOf(said.slowLink, select);
  row.classList.add('link-share', 'overlay');
  return row;
}

function textOf(tag: 'dt' | 'dd', text: string, tone = ''): HTMLElement {
  const element = document.createElement(tag);
  element.textContent = text;
  element.dataset.tone = tone;
  return element;
}

/** The text at the top of the screen: which camera it is, and how old its picture. */
const label = document.createElement('p');

/** @param filling the camera that fills the screen */
function showStagedCamera(
  filling: ReadonlySignal<CameraView | null>,
  sampledAtMs: ReadonlySignal<number>,
): void {
  const { world, stage, cameraStage } = elements;
  let shown: CameraView | null = null;
  effect(() => {
    const view = filling.value;
    if (view === shown) return;
    if (shown !== null) {
      stage.replaceWith(shown.canvas);
      world.prepend(stage);
    }
    cameraStage.replaceChildren(label);
    shown = view;
    cameraStage.hidden = view === null;
    if (view === null) return;
    // Its panel has it no longer if there is another session; then it is not staged either.
    view.canvas.replaceWith(stage);
    cameraStage.prepend(view.canvas);
  });
  effect(() => {
    void sampledAtMs.value;
    const view = filling.value;
    if (view === null) return;
    const { state, text, reason } = cameraWords(view);
    const words = `${view.camera.name} · ${reason ?? text}`;
    if (label.textContent !== words) label.textContent = words;
    cameraStage.dataset.state = state;
  });
}

/** On a smaller screen panels stay in their strip: there is no room to move them to. As in layout.css. */
const NARROW = '(max-width: 40em) and (min-height: 30.0625em)';

/** Room around panels that were moved, CSS pixels. Chosen by eye. */
const MARGIN = 8;

/** @returns `null` while panels cannot be moved; follows the window's size */
function panelArea(): ReadonlySignal<Box | null> {
  const area = signal<Box | null>(null);
  const update = () => {
    const next = window.matchMedia(NARROW).matches ? null : measure();
    if (JSON.stringify(next) !== JSON.stringify(area.peek())) area.value = next;
  };
  const observer = new ResizeObserver(update);
  observer.observe(elements.bar);
  observer.observe(elements.drive);
  window.addEventListener('resize', update);
  update();
  return area;
}

function measure(): Box {
  const top = elements.bar.getBoundingClientRect().bottom + MARGIN;
  const { height, top: driveTop } = elements.drive.getBoundingClientRect();
  const bottom = (height === 0 ? window.innerHeight : driveTop) - MARGIN;
  return {
    left: MARGIN,
    top,
    width: Math.max(0, window.innerWidth - 2 * MARGIN),
    height: Math.max(0, bottom - top),
  };
}

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
  const said = texts().clouds;
  const reset = quietButton(said.reset, said.resetTitle, () => undefined);
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
      hide.ariaLabel = shown ? said.hide(name) : said.show(name);
      const fills = filling.value === view;
      swap.ariaLabel = fills ? said.fillWithCloud : said.fillWith(name);
      swap.title = swap.ariaLabel;
      followKey(swap, 'swap');
      swap.hidden = !shown;
    }
  });
  effect(() => {
    for (const { view, figure, caption } of panels.value) {
      figure.dataset.enlarged = String(enlarged.view.value === view);
      const fills = filling.value === view;
      figure.dataset.staged = String(fills);
      caption.textContent = fills ? texts().clouds.cloud : view.camera.name;
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
  caption.title = texts().clouds.moveTitle(name);
  const age = document.createElement('span');
  age.className = 'age';
  const hide = quietButton('', '', () => view.toggle());
  const swap = quietButton('⇄', '', () => state.swap(view));
  swap.classList.add('swap');
  const fault = document.createElement('p');
  fault.className = 'fault';
  view.canvas.title = texts().clouds.enlargeTitle;
  followKey(view.canvas, 'enlarge');
  view.canvas.onclick = () => {
    if (filling.peek() !== view) state.enlarged.toggle(view);
  };
  title.append(caption, age, swap, hide);
  figure.append(title, fault, view.canvas);
  const picture = () => (filling.peek() === view ? elements.stage : view.canvas);
  return { view, name: `${view.kind}:${name}`, figure, title, caption, age, fault, hide, swap, picture };
}
