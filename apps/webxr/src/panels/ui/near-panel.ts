/** What is near the robot, on the flat page: a picture of it, words for it, and red at the edge of the view. */

import { NEAR_SECTORS, type RobotBody } from '@farpoint/protocol';
import { computed, effect } from '@preact/signals-core';
import { palette } from '../../ground/display/palette.ts';
import { radiusAt, reachOf } from '../../ground/near-field/around-footprint.ts';
import type { NearView } from '../../ground/near-field/near-view.ts';
import { hatchedStretch, hitColour, type NearColours } from '../../scene/view/near-ring.ts';
import type { PageState } from '../../state/page-state.ts';
import { steady } from '../../state/sampler.ts';
import { nearDetails, nearWords } from '../../words/near-words.ts';
import { elements } from './elements.ts';

/**
 * What is farther from the robot's edge is not drawn, metres. Chosen: its words begin at 1 m (near-words.ts).
 */
const SHOWN_M = 1.5;
/** Circles for the eye, metres from the robot's edge. */
const MARKS_M = [0.5, 1];
const SECTOR = (2 * Math.PI) / NEAR_SECTORS;

/** The theme's. */
function nearColours(): NearColours {
  const { near, far, drop, stale, quiet } = palette;
  return { veryNear: palette['very-near'], near, far, drop, stale, unseen: quiet };
}

/** Draws the view; without one, only the robot. */
function drawNear(canvas: HTMLCanvasElement, body: RobotBody, view: NearView | null): void {
  const context = canvas.getContext('2d');
  if (context === null) return;
  const { footprint } = body;
  const colours = nearColours();
  const reach = reachOf(footprint);
  const middle = canvas.width / 2;
  const perMetre = (middle - 2) / (reach + SHOWN_M);
  const lineWidth = canvas.width / 48;
  context.clearRect(0, 0, canvas.width, canvas.height);
  /** Follows the outline at a distance, over some sectors. */
  const trace = (metres: number, from: number, to: number) => {
    for (let i = from; i <= to; i += 0.5) {
      const radius = radiusAt(footprint, i * SECTOR, metres) * perMetre;
      context.lineTo(middle - radius * Math.sin(i * SECTOR), middle - radius * Math.cos(i * SECTOR));
    }
  };
  context.strokeStyle = palette.line;
  context.lineWidth = 1;
  for (const metres of [...MARKS_M, SHOWN_M]) {
    context.beginPath();
    trace(metres, 0, NEAR_SECTORS);
    context.stroke();
  }
  if (view !== null) {
    const hatch = hatching(context, canvas.width, view.stale);
    for (const [i, sector] of view.sectors.entries()) {
      const stretch = hatchedStretch(sector);
      if (stretch === null || stretch.fromM >= SHOWN_M) continue;
      const to = Math.min(SHOWN_M, stretch.toM);
      context.beginPath();
      trace(stretch.fromM, i - 0.5, i + 0.5);
      // Back at the other distance.
      for (const side of [0.5, -0.5]) {
        const radius = radiusAt(footprint, (i + side) * SECTOR, to) * perMetre;
        const bearing = (i + side) * SECTOR;
        context.lineTo(middle - radius * Math.sin(bearing), middle - radius * Math.cos(bearing));
      }
      context.fillStyle = hatch;
      context.fill();
    }
    context.lineWidth = 3 * lineWidth;
    for (const [i, { hit }] of view.sectors.entries()) {
      if (hit === null || hit.metres > SHOWN_M) continue;
      context.strokeStyle = hitColour(hit, view.stale, colours);
      context.beginPath();
      trace(hit.metres + (1.5 * lineWidth) / perMetre, i - 0.5, i + 0.5);
      context.stroke();
    }
  }
  context.beginPath();
  for (const { x, y } of footprint) context.lineTo(middle - y * perMetre, middle - x * perMetre);
  context.closePath();
  context.fillStyle = view === null || view.stale ? colours.stale : palette.good;
  context.fill();
}

let [pattern, patternKey]: [CanvasPattern | null, string] = [null, ''];

/** Diagonal stripes: not to be taken for free floor, even where colours are not told apart. */
function hatching(context: CanvasRenderingContext2D, size: number, stale: boolean): CanvasPattern | string {
  const key = `${size} ${stale} ${palette.version}`;
  if (pattern !== null && key === patternKey) return pattern;
  const tile = document.createElement('canvas');
  const side = Math.max(4, Math.round(size / 20));
  [tile.width, tile.height] = [side, side];
  const lines = tile.getContext('2d');
  if (lines === null) return palette.quiet;
  lines.strokeStyle = stale ? palette.stale : palette.quiet;
  lines.globalAlpha = stale ? 0.5 : 0.7;
  lines.lineWidth = side / 4;
  lines.beginPath();
  for (const at of [-side, 0, side]) {
    lines.moveTo(at - 1, side + 1);
    lines.lineTo(at + side + 1, -1);
  }
  lines.stroke();
  pattern = context.createPattern(tile, 'repeat');
  patternKey = key;
  return pattern ?? palette.quiet;
}

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
  #version = 0;
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
    const { version } = palette;
    const isBefore = sectors === this.#shown && stale === this.#stale && body === this.#body;
    const isSame = isBefore && version === this.#version;
    if (size === 0 || body === null || (isSame && size === this.#size)) return;
    this.#shown = sectors;
    this.#stale = stale;
    this.#body = body;
    this.#version = version;
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
