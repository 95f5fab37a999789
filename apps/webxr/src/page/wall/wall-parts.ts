/** What the page with several robots is made of. */
import { texts } from '../../words/language.ts';

/** What a page in a frame may use, as the page alone may. */
const ALLOWED = 'xr-spatial-tracking; gamepad; fullscreen; microphone; autoplay; screen-wake-lock';

export interface WallParts {
  readonly bar: HTMLElement;
  readonly cells: HTMLElement;
  readonly add: HTMLButtonElement;
  readonly stop: HTMLButtonElement;
  /** What became of STOP on all pages. */
  readonly said: HTMLElement;
  /** Where keys go. */
  readonly keys: HTMLElement;
}

export function buildWall(): WallParts {
  const said = texts().wall;
  const parts: WallParts = {
    bar: make('header', { id: 'bar' }),
    cells: make('main', { id: 'cells', ariaLabel: said.region }),
    add: make('button', { type: 'button', id: 'add', className: 'quiet', textContent: said.add }),
    stop: make('button', { type: 'button', id: 'stop-all', title: said.stopAllHint }),
    said: make('span', { id: 'said', role: 'alert' }),
    keys: make('span', { id: 'keys', role: 'status' }),
  };
  parts.stop.textContent = said.stopAll;
  parts.bar.append(make('h1', { textContent: 'Farpoint' }), parts.keys, parts.said, parts.add, parts.stop);
  return parts;
}

/** A page and its heading. */
export interface CellParts {
  readonly element: HTMLElement;
  readonly frame: HTMLIFrameElement;
  readonly name: HTMLElement;
  readonly words: HTMLElement;
  readonly close: HTMLButtonElement;
}

/** @param address of the page */
export function buildCell(address: string): CellParts {
  const parts: CellParts = {
    element: make('section', { className: 'cell' }),
    frame: make('iframe', { src: address, allow: ALLOWED }),
    name: make('h2'),
    words: make('span', { role: 'status' }),
    close: make('button', { type: 'button', className: 'quiet', textContent: '×' }),
  };
  const header = make('header');
  header.append(parts.name, parts.words, parts.close);
  parts.element.append(header, parts.frame);
  return parts;
}

/** A text that is set again, unchanged, would be announced again. */
export function say(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  members: Partial<HTMLElementTagNameMap[K]> = {},
): HTMLElementTagNameMap[K] {
  return Object.assign(document.createElement(tag), members);
}
