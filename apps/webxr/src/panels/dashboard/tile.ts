/** What a tile of the dashboard is. */
import type { Moment } from '../../ground/telemetry/moment.ts';

export interface TileFrame {
  /** Page's clock, ms. */
  readonly nowMs: number;
  /** The instant whose values are shown. */
  readonly moment: Moment;
  /** How far back curves reach, ms. */
  readonly windowMs: number;
}

export interface Tile {
  /** Its content. */
  readonly element: HTMLElement;
  /** Time between two updates, ms; 0 for each display frame. */
  everyMs(frame: TileFrame): number;
  /** Brings the content up to date. Called only while it can be seen. */
  update(frame: TileFrame): void;
  dispose(): void;
}

export function part(className: string, kind: 'div' | 'p' | 'span' | 'output' = 'div'): HTMLElement {
  const made = document.createElement(kind);
  made.className = className;
  return made;
}

/** Writes only what has changed: most updates change nothing. */
export function setText(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}
