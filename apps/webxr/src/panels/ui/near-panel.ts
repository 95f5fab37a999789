/** What is near the robot, on the flat page: a picture of it, words for it, and red at the edge of the view. */
import type { RobotBody } from '@farpoint/protocol';
import { computed, effect } from '@preact/signals-core';
import type { NearView } from '../../ground/near-field/near-view.ts';
import type { PageState } from '../../state/page-state.ts';
import { steady } from '../../state/sampler.ts';
import { nearDetails, nearWords } from '../../words/near-words.ts';
import { elements } from './elements.ts';
import { drawNear } from './near-canvas.ts';

/** The words; the picture follows at its own rate. */
export function showNearWords({ robot }: Pick<PageState, 'robot'>): void {
  const shown = steady(
    computed(() => {
      const near = robot.near.value;
      return { tells: robot.tellsNear.value, line: nearWords(near), details: nearDetails(near) };
    }),
  );
  effect(() => {
    const { tells, line, details } = shown.value;
    const { near, nearLine, nearMore } = elements;
    near.hidden = !tells;
    nearLine.textContent = line.text;
    nearLine.dataset.tone = line.tone;
    nearMore.textContent = details;
    nearMore.hidden = details === '';
  });
  effect(() => {
    const { text, tone } = robot.speed.value ?? { text: '', tone: 'neutral' };
    elements.speed.hidden = text === '';
    elements.speed.textContent = text;
    elements.speed.dataset.tone = tone;
  });
}

/** The picture, and the red edge. */
export class NearPicture {
  #shown: NearView['sectors'] | null = null;
  #stale = false;
  #body: RobotBody | null = null;
  /** Side of the picture that was drawn, pixels. */
  #size = 0;
  /** Side of its place on the page, CSS pixels. */
  #side = 0;

  constructor() {
    // To ask the element at every call would have the browser lay the page out anew, fifty times a second.
    new ResizeObserver(() => {
      this.#side = elements.nearRing.clientWidth;
    }).observe(elements.nearRing);
  }

  /** Call it often: it draws only what has changed. */
  show(body: RobotBody | null, view: NearView | null): void {
    const canvas = elements.nearRing;
    const size = Math.round(this.#side * Math.min(window.devicePixelRatio, 3));
    const [sectors, stale] = [view?.sectors ?? null, view?.stale ?? false];
    const isSame = sectors === this.#shown && stale === this.#stale && body === this.#body;
    if (size === 0 || body === null || (isSame && size === this.#size)) return;
    this.#shown = sectors;
    this.#stale = stale;
    this.#body = body;
    if (size !== this.#size) [canvas.width, canvas.height, this.#size] = [size, size, size];
    drawNear(canvas, body, view);
  }
}

let shownBearing: number | null = null;

/** Call it often. @param bearing on the screen, radians counter-clockwise from up; `null` for nothing */
export function showBlockedEdge(bearing: number | null): void {
  if (bearing === shownBearing) return;
  shownBearing = bearing;
  const { blockedEdge } = elements;
  blockedEdge.hidden = bearing === null;
  if (bearing === null) return;
  // On the edge of the screen, whatever its shape.
  const [x, y] = [-Math.sin(bearing), -Math.cos(bearing)];
  const scale = 50 / Math.max(Math.abs(x), Math.abs(y));
  blockedEdge.style.setProperty('--x', `${(50 + x * scale).toFixed(1)}%`);
  blockedEdge.style.setProperty('--y', `${(50 + y * scale).toFixed(1)}%`);
}
