/** Several robots side by side: a page for each, and one STOP for all. */
import { type CellStop, cellStop, type Press } from '../../ground/wall/stop-all.ts';
import { type CellState, cellStateSchema, type WallStop } from '../../ground/wall/wall-messages.ts';
import { MOST_CELLS, pageAddress, type WallSettings, wallAddress } from '../../ground/wall/wall-settings.ts';
import { texts } from '../../words/language.ts';
import { cellName, cellWords, stopAllWords } from '../../words/wall-words.ts';
import { buildCell, type CellParts, say, type WallParts } from './wall-parts.ts';

/**
 * A page that says nothing for so long does not respond, ms. Chosen: it says something twice a second, if its thread is not
 * busy. wall.page.ts holds it.
 */
const SILENT_MS = 1500;
/** How often the headings are brought up to date, ms. Chosen: at once, for people. */
const TICK_MS = 100;
const NO_PRESS: Press = { press: 0, atMs: 0 };
/** Stop all wherever the focus is in this document: in a page they stop its robot. */
const STOP_KEYS: ReadonlySet<string> = new Set(['KeyX', 'F9']);

interface Cell extends CellParts {
  /** The robot that it was opened for, until it says what it shows. */
  readonly opened: string | null;
  /** The newest press of STOP that it need not have heard: it came later, or heard it before it was loaded again. */
  since: number;
  state: CellState | null;
  heardMs: number;
}

export class Wall {
  readonly #parts: WallParts;
  readonly #settings: WallSettings;
  readonly #now: () => number;
  readonly #cells: Cell[] = [];
  #press = NO_PRESS;

  /** @param now this page's clock, ms */
  constructor(parts: WallParts, settings: WallSettings, now: () => number) {
    this.#parts = parts;
    this.#settings = settings;
    this.#now = now;
  }

  start(): void {
    const { add, stop } = this.#parts;
    for (const robot of this.#settings.robots) this.#add(robot);
    add.addEventListener('click', () => this.#add(null));
    // Act on the press: a finger that slides off the button produces no click.
    stop.addEventListener('pointerdown', () => this.#stopAll());
    stop.addEventListener('click', () => this.#stopAll());
    window.addEventListener('keydown', ({ code, repeat }) => {
      if (STOP_KEYS.has(code) && !repeat) this.#stopAll();
    });
    window.addEventListener('message', (event) => this.#onMessage(event));
    setInterval(() => this.#show(), TICK_MS);
    this.#show();
  }

  #add(robot: string | null): void {
    if (this.#cells.length >= MOST_CELLS) return;
    const cell: Cell = {
      ...buildCell(pageAddress(robot, this.#settings.forPages)),
      opened: robot,
      since: this.#press.press,
      state: null,
      heardMs: this.#now(),
    };
    cell.close.addEventListener('click', () => this.#close(cell));
    // What the page has said, the next one in the frame has not.
    cell.frame.addEventListener('load', () => {
      if (cell.state !== null && cell.state.heard >= this.#press.press) cell.since = this.#press.press;
      cell.state = null;
      cell.heardMs = this.#now();
    });
    this.#cells.push(cell);
    this.#parts.cells.append(cell.element);
    this.#show();
  }

  #close(cell: Cell): void {
    this.#cells.splice(this.#cells.indexOf(cell), 1);
    cell.element.remove();
    this.#show();
    this.#parts.add.focus();
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
    const { cells, add, said, keys } = this.#parts;
    cells.dataset.count = String(this.#cells.length);
    add.hidden = this.#cells.length >= MOST_CELLS;
    let active: string | null = null;
    const stops = this.#cells.map((cell, i) => {
      const name = cellName(cell.state, i + 1);
      if (document.activeElement === cell.frame) active = name;
      return this.#showCell(cell, name);
    });
    const { keysNowhere, keysTo } = texts().wall;
    say(keys, active === null ? keysNowhere : keysTo(active));
    const all = stopAllWords(stops);
    say(said, all?.text ?? '');
    said.dataset.tone = all?.tone ?? 'neutral';
  }

  #showCell(cell: Cell, name: string): CellStop {
    const nowMs = this.#now();
    const stop = cellStop(cell.state, this.#press.press > cell.since ? this.#press : NO_PRESS, nowMs);
    const { text, tone } = cellWords(cell.state, stop, nowMs - cell.heardMs > SILENT_MS);
    say(cell.name, name);
    say(cell.words, text);
    cell.words.dataset.tone = tone;
    cell.frame.title = name;
    cell.close.ariaLabel = texts().wall.close(name);
    cell.element.dataset.active = String(document.activeElement === cell.frame);
    return stop;
  }
}
