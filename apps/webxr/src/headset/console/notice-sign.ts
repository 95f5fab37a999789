/**
 * Says before the operator's eyes what the flat page says in its middle: below the line of sight, where it hides neither
 * the horizon nor the way ahead.
 */
import { Group } from 'three';
import type { HeadsetNotice } from '../../status/headset-notice-words.ts';
import type { Tone } from '../../status/tone.ts';
import { PANEL_ORDER } from '../../view/panel-order.ts';
import { TextPlate } from '../../view/text-plate.ts';
import { wrapText } from '../../view/wrapped-text.ts';
import { Fade } from './fade.ts';

const WIDTH = 1024;
const HEIGHT = 512;
/** From the eyes, m. */
const DISTANCE_M = 1;
const PIXELS_PER_METRE = 1600;
/** Of the upper edge below the line of sight, degrees. */
const TOP_DEGREES = 20;
const EDGE = 28;
const SIZE = 42;
const ROW = 54;
const OPACITY = 0.94;
/** Height of capital letters, share of a font's size: of the least that system fonts have. */
const CAPITAL = 0.7;
const COLOURS: Readonly<Record<Tone, string>> = {
  good: '#35c9b5',
  neutral: '#e6edf3',
  warning: '#f0b429',
  bad: '#ff8080',
};

interface Row {
  readonly text: string;
  readonly font: string;
  readonly colour: string;
}

export class NoticeSign {
  /** A child of the camera. */
  readonly object = new Group();
  readonly #plate = new TextPlate(
    { width: WIDTH, height: HEIGHT, pixelsPerMetre: PIXELS_PER_METRE },
    PANEL_ORDER.notice,
  );
  readonly #fade = new Fade();
  #rows: readonly Row[] = [];
  #key = '';

  constructor() {
    // Turned towards the eyes, so that the letters are as high as they can be.
    const below = (TOP_DEGREES * Math.PI) / 180;
    this.object.rotation.x = -below;
    this.#plate.mesh.position.z = -DISTANCE_M;
    this.#plate.opacity = 0;
    this.object.add(this.#plate.mesh);
  }

  /** What it shows, and how: for tests. `null` while it shows nothing. */
  get shown(): { rows: string[]; letterDegrees: number; topDegrees: number; widthDegrees: number } | null {
    if (!this.#fade.shown) return null;
    const degrees = (metres: number) => (Math.atan(metres / DISTANCE_M) * 180) / Math.PI;
    return {
      rows: this.#rows.map(({ text }) => text),
      letterDegrees: degrees((SIZE * CAPITAL) / PIXELS_PER_METRE),
      topDegrees: -TOP_DEGREES,
      widthDegrees: 2 * degrees(WIDTH / 2 / PIXELS_PER_METRE),
    };
  }

  /** Redraws only what has changed. */
  say({ standing, passing }: HeadsetNotice): void {
    const key = JSON.stringify([standing, passing]);
    if (key === this.#key) return;
    this.#key = key;
    const rows = [
      ...(standing?.title == null ? [] : this.#rowsOf(standing.title, standing.tone, 700)),
      ...(standing === null
        ? []
        : this.#rowsOf(standing.text, standing.title === null ? standing.tone : 'neutral', 500)),
      ...(passing === null ? [] : this.#rowsOf(passing.text, passing.tone, 500)),
    ];
    this.#fade.shown = rows.length > 0;
    // What it said fades out with its words.
    if (rows.length > 0) this.#draw(rows);
  }

  /** Call this before each display frame in VR. */
  update(elapsedMs: number): void {
    this.#plate.opacity = this.#fade.update(elapsedMs) * OPACITY;
  }

  #rowsOf(text: string, tone: Tone, weight: number): Row[] {
    const font = `${weight} ${SIZE}px system-ui, sans-serif`;
    const measure = (words: string) => this.#plate.measure(words, font);
    return wrapText(text, WIDTH - 2 * EDGE, measure).map((row) => ({
      ...{ text: row, font, colour: COLOURS[tone] },
    }));
  }

  #draw(rows: readonly Row[]): void {
    this.#rows = rows;
    const height = rows.length * ROW + EDGE;
    this.#plate.draw(height, (context) => {
      context.fillStyle = '#0d141b';
      context.beginPath();
      context.roundRect(0, 0, WIDTH, height, 24);
      context.fill();
      context.textAlign = 'center';
      context.textBaseline = 'middle';
      for (const [index, { text, font, colour }] of rows.entries()) {
        context.font = font;
        context.fillStyle = colour;
        context.fillText(text, WIDTH / 2, EDGE / 2 + (index + 0.5) * ROW);
      }
    });
  }
}
