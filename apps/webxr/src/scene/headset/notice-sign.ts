/**
 * Says before the operator's eyes what the flat page says in its middle: below the line of sight, where it hides neither
 * the horizon nor the way ahead.
 */
import { Group } from 'three';
import type { HeadsetNotice } from '../../words/headset-notice-words.ts';
import type { Tone } from '../../words/words.ts';
import { Fade } from './fade.ts';
import { TextPlate } from './text-plate.ts';
import { wrapText } from './wrapped-text.ts';

/** The picture's width, pixels. Chosen: some 45 letters in a row, which the eye takes in without turning. */
const WIDTH = 1024;
/** Rows at most. Chosen: the longest loss with a notice below it; more would hide the floor before the robot. */
const MOST_ROWS = 10;
/** From the eyes, m. Chosen: where headsets focus, and farther than hands that are held out. */
const DISTANCE_M = 1;
const PIXELS_PER_METRE = 1600;
/** The upper edge is this far below the line of sight, degrees. Chosen: 15 is the least that leaves the way ahead free. */
const TOP_DEGREES = 18;
/** From the edge to the text, and from one row to the next, pixels. Chosen by eye. */
const EDGE = 28;
const ROW = 54;
/** Height of the font, pixels. Chosen: capitals are a degree high, which every headset shows sharply. */
const SIZE = 42;
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

/** What the sign shows, and how: for tests. */
export interface ShownNotice {
  readonly rows: string[];
  /** Height of a capital letter, and where the sign's edges are relative to the line of sight, degrees. */
  readonly letterDegrees: number;
  readonly topDegrees: number;
  readonly bottomDegrees: number;
  readonly widthDegrees: number;
  /** 0 while it has only begun to fade in … 1. */
  readonly opacity: number;
}

export class NoticeSign {
  /** A child of the camera. */
  readonly object = new Group();
  readonly #plate = new TextPlate({
    width: WIDTH,
    height: MOST_ROWS * ROW + EDGE,
    pixelsPerMetre: PIXELS_PER_METRE,
  });
  readonly #fade = new Fade();
  #rows: readonly Row[] = [];
  #key = '';
  #opacity = 0;

  constructor() {
    // Turned towards the eyes, so that the letters are as high as they can be.
    this.object.rotation.x = (-TOP_DEGREES * Math.PI) / 180;
    this.#plate.mesh.position.z = -DISTANCE_M;
    this.#plate.opacity = 0;
    this.object.add(this.#plate.mesh);
  }

  /** `null` while it shows nothing, or fades out. */
  get shown(): ShownNotice | null {
    if (!this.#fade.shown) return null;
    return {
      rows: this.#rows.map(({ text }) => text),
      letterDegrees: degrees(SIZE * CAPITAL),
      topDegrees: -TOP_DEGREES,
      bottomDegrees: -TOP_DEGREES - degrees(heightOf(this.#rows)),
      widthDegrees: 2 * degrees(WIDTH / 2),
      opacity: this.#opacity,
    };
  }

  /** Redraws only what has changed. */
  say({ standing, passing, hint }: HeadsetNotice): void {
    const key = JSON.stringify([standing, passing, hint]);
    if (key === this.#key) return;
    this.#key = key;
    const rows: Row[] = [];
    if (standing !== null) {
      const { title, text, tone } = standing;
      if (title !== null) rows.push(...this.#rowsOf(title, tone, 700));
      rows.push(...this.#rowsOf(text, title === null ? tone : 'neutral', 500));
    }
    if (passing !== null) rows.push(...this.#rowsOf(passing.text, passing.tone, 500));
    if (hint !== null) rows.push(...this.#rowsOf(hint, 'neutral', 400));
    this.#fade.shown = rows.length > 0;
    // What it said fades out with its words.
    if (rows.length > 0) this.#draw(rows.slice(0, MOST_ROWS));
  }

  /** Nobody wears the headset: what comes next fades in anew. */
  clear(): void {
    this.#key = '';
    this.#fade.clear();
    this.update(0);
  }

  /** Call this before each display frame in VR. Allocates nothing. */
  update(elapsedMs: number): void {
    this.#opacity = this.#fade.update(elapsedMs) * OPACITY;
    this.#plate.opacity = this.#opacity;
  }

  #rowsOf(text: string, tone: Tone, weight: number): Row[] {
    const font = `${weight} ${SIZE}px system-ui, sans-serif`;
    const measure = (words: string) => this.#plate.measure(words, font);
    return wrapText(text, WIDTH - 2 * EDGE, measure).map((row) => ({
      text: row,
      font,
      colour: COLOURS[tone],
    }));
  }

  #draw(rows: readonly Row[]): void {
    this.#rows = rows;
    const height = heightOf(rows);
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

/** Pixels. */
function heightOf(rows: readonly Row[]): number {
  return rows.length * ROW + EDGE;
}

/** How large so many pixels are before the eyes. */
function degrees(pixels: number): number {
  return (Math.atan(pixels / PIXELS_PER_METRE / DISTANCE_M) * 180) / Math.PI;
}
