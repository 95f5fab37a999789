/** The dashboard beside the picture: tiles with the robot's telemetry, arranged by the operator. Loaded when opened. */
import './dashboard.css';
import 'uplot/dist/uPlot.min.css';
import type { RobotSession } from '@farpoint/operator';
import { effect, type ReadonlySignal, signal } from '@preact/signals-core';
import type { MapTiles } from '../../ground/telemetry/map-tiles.ts';
import type { Moment } from '../../ground/telemetry/moment.ts';
import type { TelemetryRecorder } from '../../ground/telemetry/recorder.ts';
import { laterTexts } from '../../words/language.ts';
import type { Words } from '../../words/words.ts';
import { followKey } from '../ui/key-title.ts';
import { quietButton, selectOf } from '../ui/panel-parts.ts';
import {
  changed,
  DEFAULT_LAYOUT,
  type Layout,
  layoutText,
  moved,
  parseLayout,
  placed,
  TILE_SIZES,
  type TileSize,
  WINDOWS_S,
} from './layout.ts';
import { ageText, spanText } from './number-words.ts';
import type { StageSources } from './stages-tile.ts';
import { part, setText, type Tile, type TileFrame } from './tile.ts';
import { STAGES_TILE, type TileKind, tileKinds } from './tile-kinds.ts';

export interface TileActions {
  move(by: -1 | 1): void;
  /** To the next size. */
  resize(): void;
  hide(): void;
}

export interface ShownTile {
  readonly title: string;
  readonly size: TileSize;
  /** Whether the buttons are shown. */
  readonly arranging: boolean;
}

/** The frame of a tile: its title, and the buttons that arrange it. Draws the tile only while it can be seen. */
class TileFrameView {
  readonly element = document.createElement('section');
  readonly #tile: Tile;
  readonly #title = document.createElement('h3');
  readonly #buttons = part('arrange');
  readonly #watching: IntersectionObserver;
  #named: readonly (readonly [HTMLButtonElement, (tile: string) => string])[];
  #inView = true;
  #dueMs = 0;

  constructor(tile: Tile, { move, resize, hide }: TileActions) {
    this.#tile = tile;
    this.element.className = 'tile';
    const said = laterTexts().dashboard;
    this.#named = [
      [quietButton('◀', said.earlier, () => move(-1)), said.moveEarlier],
      [quietButton('▶', said.later, () => move(1)), said.moveLater],
      [quietButton('⤢', said.size, resize), said.changeSize],
      [quietButton('✕', said.hide, hide), said.hideTile],
    ];
    this.#buttons.append(...this.#named.map(([button]) => button));
    const head = part('head');
    head.append(this.#title, this.#buttons);
    this.element.append(head, tile.element);
    this.#watching = new IntersectionObserver(([entry]) => {
      this.#inView = entry?.isIntersecting ?? true;
    });
    this.#watching.observe(this.element);
  }

  show({ title, size, arranging }: ShownTile): void {
    setText(this.#title, title);
    this.element.ariaLabel = title;
    this.element.dataset.size = size;
    this.#buttons.hidden = !arranging;
    for (const [button, words] of this.#named) button.ariaLabel = words(title);
    this.#dueMs = 0;
  }

  draw(frame: TileFrame): void {
    if (!this.#inView || frame.nowMs < this.#dueMs) return;
    this.#dueMs = frame.nowMs + this.#tile.everyMs(frame);
    this.#tile.update(frame);
  }

  dispose(): void {
    this.#watching.disconnect();
    this.#tile.dispose();
    this.element.remove();
  }
}

const KEY = 'farpoint.dashboard';

/** The defaults if the page may not use local storage. */
function loadLayout(): Layout {
  try {
    return parseLayout(localStorage.getItem(KEY));
  } catch {
    return parseLayout(null);
  }
}

/** The dashboard's layout that this browser keeps. */
function storeLayout(layout: Layout): void {
  try {
    localStorage.setItem(KEY, layoutText(layout));
  } catch {
    // Private browsing: what is arranged lasts for this visit only.
  }
}

export interface DashboardParts extends StageSources {
  readonly element: HTMLElement;
  readonly recorder: TelemetryRecorder;
  /** Where tiles of the earth come from; an effect that asks runs again when it changes. */
  mapTiles(): MapTiles | null;
  readonly alarms: ReadonlySignal<readonly Words[]>;
  session(): RobotSession;
  /** The instant whose values are shown now. @param nowMs page's clock */
  momentAt(nowMs: number): Moment;
  close(): void;
}

/** How often the header is written, ms. Chosen: four times a second reads as at once. */
const HEADER_MS = 250;

export class Dashboard {
  readonly #parts: DashboardParts;
  readonly #layout = signal(loadLayout());
  readonly #arranging = signal(false);
  readonly #revision = signal(-1);
  readonly #views = new Map<string, TileFrameView>();
  readonly #state = part('state', 'span');
  readonly #grid = part('tiles');
  readonly #hidden = part('hidden-tiles');
  #kinds: readonly TileKind[] = [];
  #headerDueMs = 0;
  #heard = false;
  #frame: number | null = null;

  constructor(parts: DashboardParts) {
    this.#parts = parts;
    parts.element.replaceChildren(this.#header(), this.#alarms(), this.#hidden, this.#grid);
    let first = true;
    effect(() => {
      const layout = this.#layout.value;
      if (!first) storeLayout(layout);
      first = false;
    });
    effect(() => this.#arrange());
  }

  /** Draws while it is open and somebody can look. */
  set visible(visible: boolean) {
    if (!visible && this.#frame !== null) {
      cancelAnimationFrame(this.#frame);
      this.#frame = null;
    } else if (visible && this.#frame === null) this.#frame = requestAnimationFrame(() => this.#draw());
  }

  /** Shows the tile with where the time goes, also if it was hidden. */
  showStages(): void {
    this.#change(STAGES_TILE, { shown: true });
    this.#views.get(STAGES_TILE)?.element.scrollIntoView({ block: 'nearest' });
  }

  #draw(): void {
    this.#frame = requestAnimationFrame(() => this.#draw());
    const nowMs = performance.now();
    const { recorder, momentAt } = this.#parts;
    this.#revision.value = recorder.revision;
    const moment = momentAt(nowMs);
    const { heard } = moment;
    const frame: TileFrame = { nowMs, moment, windowMs: this.#layout.peek().windowS * 1000 };
    for (const view of this.#views.values()) view.draw(frame);
    // A silence that begins or ends is told at once.
    if (nowMs < this.#headerDueMs && heard === this.#heard) return;
    this.#headerDueMs = nowMs + HEADER_MS;
    this.#heard = heard;
    setText(this.#state, stateWords(nowMs - recorder.heardMs, moment));
    this.#state.dataset.tone = heard ? 'neutral' : 'bad';
  }

  #header(): HTMLElement {
    const header = part('heads');
    const said = laterTexts().dashboard;
    const title = document.createElement('h2');
    title.textContent = said.title;
    const spans = WINDOWS_S.map(spanText);
    const shown = Object.fromEntries(spans.map((text) => [text, text]));
    const span = selectOf({ label: said.span, values: spans, texts: shown }, (text) => {
      const windowS = WINDOWS_S[spans.indexOf(text)];
      if (windowS !== undefined) this.#layout.value = { ...this.#layout.peek(), windowS };
    });
    effect(() => {
      span.selectedIndex = WINDOWS_S.indexOf(this.#layout.value.windowS);
    });
    const arrange = quietButton(said.arrange, said.arrangeTitle, () => {
      this.#arranging.value = !this.#arranging.peek();
    });
    const reset = quietButton(said.reset, said.resetTitle, () => {
      this.#layout.value = DEFAULT_LAYOUT;
    });
    effect(() => {
      arrange.ariaPressed = String(this.#arranging.value);
      reset.hidden = !this.#arranging.value;
    });
    const close = quietButton('✕', said.closeTitle, () => this.#parts.close());
    close.ariaLabel = said.close;
    followKey(close, 'dashboard');
    header.append(title, this.#state, span, reset, arrange, close);
    return header;
  }

  #alarms(): HTMLElement {
    const alert = document.createElement('div');
    alert.setAttribute('role', 'alert');
    const list = document.createElement('ul');
    list.className = 'alarms';
    list.ariaLabel = laterTexts().dashboard.alarms;
    alert.append(list);
    effect(() => {
      const alarms = this.#parts.alarms.value;
      list.hidden = alarms.length === 0;
      while (list.children.length > alarms.length) list.lastElementChild?.remove();
      while (list.children.length < alarms.length) list.append(document.createElement('li'));
      alarms.forEach(({ text, tone }, i) => {
        const item = list.children[i] as HTMLElement;
        setText(item, `⚠ ${text}`);
        item.dataset.tone = tone;
      });
    });
    return alert;
  }

  /** Makes, moves and removes tiles, as the layout and what the robot measures ask for. */
  #arrange(): void {
    const arranging = this.#arranging.value;
    void this.#revision.value;
    const layout = this.#layout.value;
    this.#kinds = tileKinds(this.#parts);
    const kinds = new Map(this.#kinds.map((kind) => [kind.id, kind]));
    const tiles = placed(layout, this.#kinds);
    const shown = tiles.filter((tile) => tile.shown);
    for (const [id, view] of this.#views) {
      if (shown.some((tile) => tile.id === id)) continue;
      view.dispose();
      this.#views.delete(id);
    }
    const elements = shown.flatMap(({ id, size }) => {
      const kind = kinds.get(id);
      if (kind === undefined) return [];
      const view = this.#views.get(id) ?? this.#view(kind);
      this.#views.set(id, view);
      view.show({ title: kind.title, size, arranging });
      return [view.element];
    });
    // Moving an element that stays would restart its observers and lose the focus.
    elements.forEach((element, i) => {
      if (this.#grid.children[i] !== element)
        this.#grid.insertBefore(element, this.#grid.children[i] ?? null);
    });
    const hidden = tiles.filter((tile) => !tile.shown);
    this.#hidden.hidden = !arranging || hidden.length === 0;
    this.#hidden.replaceChildren(
      ...hidden.map(({ id }) => {
        const title = kinds.get(id)?.title ?? id;
        return quietButton(`+ ${title}`, laterTexts().dashboard.showTile(title), () =>
          this.#change(id, { shown: true }),
        );
      }),
    );
  }

  #view({ id, make }: TileKind): TileFrameView {
    return new TileFrameView(make(), {
      move: (by) => {
        this.#layout.value = moved(this.#layout.peek(), this.#kinds, id, by);
      },
      resize: () => {
        const size = placed(this.#layout.peek(), this.#kinds).find((tile) => tile.id === id)?.size ?? 'small';
        const next = TILE_SIZES[(TILE_SIZES.indexOf(size) + 1) % TILE_SIZES.length] ?? 'small';
        this.#change(id, { size: next });
      },
      hide: () => this.#change(id, { shown: false }),
    });
  }

  #change(id: string, change: Parameters<typeof changed>[3]): void {
    this.#layout.value = changed(this.#layout.peek(), this.#kinds, id, change);
  }
}

function stateWords(silentMs: number, { instantMs, robotNowMs, heard }: Moment): string {
  const said = laterTexts().dashboard;
  if (silentMs === Number.POSITIVE_INFINITY) return said.noDataYet;
  if (!heard) return said.noDataFor(ageText(silentMs));
  if (instantMs === null) return said.newest;
  return said.inStep(ageText(Math.max(0, robotNowMs - instantMs)));
}
