/** Several robots side by side: a page for each, and one STOP for all. */
import { cellWords, stopAllWords, wallWords } from '../status/wall-words.ts';
import { type CellStop, cellStop, type Press } from './stop-all.ts';
import { type CellState, cellStateSchema, type WallStop } from './wall-messages.ts';
import { MOST_CELLS, pageAddress, type WallSettings, wallAddress } from './wall-settings.ts';

/** A page that says nothing for so long does not answer, ms. */
const SILENT_MS = 1500;
const TICK_MS = 100;
const NO_PRESS: Press = { press: 0, atMs: 0 };
/** What a page in a frame may use, as the page alone may. */
const ALLOWED = 'xr-spatial-tracking; gamepad; fullscreen; microphone; autoplay; screen-wake-lock';

export interface WallElements {
  readonly cells: HTMLElement;
  readonly add: HTMLButtonElement;
  readonly stop: HTMLButtonElement;
  readonly said: HTMLElement;
  readonly keys: HTMLElement;
}

interface Cell {
  readonly element: HTMLElement;
  readonly frame: HTMLIFrameElement;
  readonly name: HTMLElement;
  readonly words: HTMLElement;
  readonly close: HTMLButtonElement;
  /** The robot that it was opened for, until it says what it shows. */
  readonly opened: string | null;
  /** The newest press of STOP that it need not have heard: it came later, or heard it before it was loaded again. */
  since: number;
  state: CellState | null;
  heardMs: number;
}

export class Wall {
  readonly #elements: WallElements;
  readonly #settings: WallSettings;
  readonly #now: () => number;
  readonly #cells: Cell[] = [];
  #press = NO_PRESS;

  constructor(elements: WallElements, settings: WallSettings, now: () => number) {
    this.#elements = elements;
    this.#settings = settings;
    this.#now = now;
  }

  start(): void {
    const { add, stop } = this.#elements;
    for (const robot of this.#settings.robots) this.#add(robot);
    add.addEventListener('click', () => this.#add(null));
    // Act on the press: a finger that slides off the button produces no click.
    stop.addEventListener('pointerdown', () => this.#stopAll());
    stop.addEventListener('click', () => this.#stopAll());
    window.addEventListener('keydown', ({ code, repeat }) => {
      if (code === 'KeyX' && !repeat) this.#stopAll();
    });
    window.addEventListener('message', (event) => this.#onMessage(event));
    setInterval(() => this.#show(), TICK_MS);
    this.#show();
  }

  #add(robot: string | null): void {
    if (this.#cells.length >= MOST_CELLS) return;
    const make = <K extends keyof HTMLElementTagNameMap>(
      tag: K,
      more: Partial<HTMLElementTagNameMap[K]> = {},
    ) => Object.assign(document.createElement(tag), more);
    const element = make('section', { className: 'cell' });
    const header = make('header');
    const name = make('h2');
    const words = make('span', { role: 'status' });
    const close = make('button', { type: 'button', className: 'quiet', textContent: '×' });
    const frame = make('iframe', { src: pageAddress(robot, this.#settings.forPages), allow: ALLOWED });
    header.append(name, words, close);
    element.append(header, frame);
    const cell: Cell = {
      element,
      frame,
      name,
      words,
      close,
      opened: robot,
      since: this.#press.press,
      state: null,
      heardMs: this.#now(),
    };
    close.addEventListener('click', () => this.#close(cell));
    // What the page had said, the next one has not.
    frame.addEventListener('load', () => {
      if (cell.state !== null && cell.state.heard >= this.#press.press) cell.since = this.#press.press;
      cell.state = null;
      cell.heardMs = this.#now();
    });
    this.#cells.push(cell);
    this.#elements.cells.append(element);
    this.#show();
  }

  #close(cell: Cell): void {
    this.#cells.splice(this.#cells.indexOf(cell), 1);
    cell.element.remove();
    this.#show();
    this.#elements.add.focus();
  }

  #stopAll(): void {
    this.#press = { press: this.#press.press + 1, atMs: this.#now() };
    const message: WallStop = { farpoint: 'stop', press: this.#press.press };
    for (const { frame } of this.#cells) frame.contentWindow?.postMessage(message, window.location.origin);
    this.#show();
  }

  #onMessage({ source, origin, data }: MessageEvent): void {
    if (origin !== window.location.origin) return;
    const cell = this.#cells.find(({ frame }) => frame.contentWindow === source);
    const state = cellStateSchema.safeParse(data);
    if (cell === undefined || !state.success) return;
    const isOther = cell.state?.robot !== state.data.robot;
    cell.state = state.data;
    cell.heardMs = this.#now();
    if (isOther) this.#keepAddress();
    this.#show();
  }

  /** Whoever loads the page again has the same robots. */
  #keepAddress(): void {
    const robots = this.#cells.flatMap(({ state, opened }) => (state === null ? opened : state.robot) ?? []);
    window.history.replaceState(null, '', wallAddress([...new Set(robots)], this.#settings.forPages));
  }

  #show(): void {
    const nowMs = this.#now();
    const { cells, add, said, keys } = this.#elements;
    cells.dataset.count = String(this.#cells.length);
    add.hidden = this.#cells.length >= MOST_CELLS;
    const stops: CellStop[] = [];
    let active: string | null = null;
    for (const [i, cell] of this.#cells.entries()) {
      const pressed = this.#press.press > cell.since ? this.#press : NO_PRESS;
      const stop = cellStop(cell.state, pressed, nowMs);
      stops.push(stop);
      const { text, tone } = cellWords(cell.state, stop, nowMs - cell.heardMs > SILENT_MS);
      const name = wallWords.cell(cell.state, i + 1);
      say(cell.name, name);
      say(cell.words, text);
      cell.words.dataset.tone = tone;
      cell.frame.title = name;
      cell.close.ariaLabel = wallWords.close(name);
      const isActive = document.activeElement === cell.frame;
      cell.element.dataset.active = String(isActive);
      if (isActive) active = name;
    }
    say(keys, wallWords.keys(active));
    const all = stopAllWords(stops);
    say(said, all?.text ?? '');
    said.dataset.tone = all?.tone ?? 'neutral';
  }
}

/** A text that is set again, unchanged, is announced again. */
function say(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}
