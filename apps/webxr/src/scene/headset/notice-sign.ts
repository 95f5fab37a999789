/**
 * Says before the operator's eyes what the flat page says in its middle: below the line of sight, where it hides neither
 * the horizon nor the way ahead.
 */
import { Group, type Mesh } from 'three';
import type { HeadsetNotice } from '../../words/headset-notice-words.ts';
import type { Tone } from '../../words/words.ts';
import { Fade } from './fade.ts';
import { signRows } from './sign-rows.ts';
import { PLATE_ORDER, TextPlate } from './text-plate.ts';

/** The picture's width, pixels. Chosen: some 45 letters in a row, which the eye takes in without turning. */
const WIDTH = 1024;
/**
 * Rows at most with letters of the usual size. Chosen: longer than all that the page says, and above the panel of a hand that
 * is held low. What is longer has smaller letters.
 */
const MOST_ROWS = 13;
/** From the eyes, m. Chosen: where headsets focus, and farther than hands that are held out. */
const DISTANCE_M = 1;
const PIXELS_PER_METRE = 1600;
/** The upper edge is this far below the line of sight, degrees. Chosen: 15 is the least that leaves the way ahead free. */
const TOP_DEGREES = 18;
/** The same while the menu is open. Chosen: eyes that read the menu do not have the sign before it. */
const LOWER_DEGREES = 26;
/** From the edge to the text, and from one row to the next, pixels. Chosen by eye. */
const EDGE = 28;
const ROW = 52;
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

interface Look {
  readonly weight: number;
  readonly tone: Tone;
}

interface Row {
  readonly text: string;
  readonly look: Look;
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
    order: PLATE_ORDER.notice,
  });
  readonly #fade = new Fade();
  #rows: readonly Row[] = [];
  /** Size of the letters, as a share of the usual. */
  #share = 1;
  #topDegrees = TOP_DEGREES;
  #key = '';
  #opacity = 0;

  constructor() {
    // Turned towards the eyes, so that the letters are as high as they can be.
    this.lowered = false;
    this.#plate.mesh.position.z = -DISTANCE_M;
    this.#plate.opacity = 0;
    this.object.add(this.#plate.mesh);
  }

  /** Whether it hangs lower, while the menu is open. */
  set lowered(lowered: boolean) {
    this.#topDegrees = lowered ? LOWER_DEGREES : TOP_DEGREES;
    this.object.rotation.x = (-this.#topDegrees * Math.PI) / 180;
  }

  /** The sheet, while anything is on it. */
  get sheet(): Mesh {
    return this.#plate.mesh;
  }

  /** `null` while it shows nothing, or fades out. */
  get shown(): ShownNotice | null {
    if (!this.#fade.shown) return null;
    return {
      rows: this.#rows.map(({ text }) => text),
      letterDegrees: degrees(SIZE * this.#share * CAPITAL),
      topDegrees: -this.#topDegrees,
      bottomDegrees: -this.#topDegrees - degrees(this.#height),
      widthDegrees: 2 * degrees(WIDTH / 2),
      opacity: this.#opacity,
    };
  }

  /** Redraws only what has changed. */
  say({ standing, passing, hint }: HeadsetNotice): void {
    const key = JSON.stringify([standing, passing, hint]);
    if (key === this.#key) return;
    this.#key = key;
    const said: Row[] = [];
    const say = (text: string, tone: Tone, weight: number) => said.push({ text, look: { tone, weight } });
    if (standing !== null) {
      const { title, text, tone } = standing;
      if (title !== null) say(title, tone, 700);
      say(text, title === null ? tone : 'neutral', 500);
    }
    if (passing !== null) say(passing.text, passing.tone, 500);
    if (hint !== null) say(hint, 'neutral', 400);
    this.#fade.shown = said.length > 0;
    // What it said fades out with its words.
    if (said.length === 0) return;
    const measure = (text: string, { weight }: Look) => this.#plate.measure(text, fontOf(weight, SIZE));
    const { rows, share } = signRows(said, WIDTH - 2 * EDGE, MOST_ROWS, measure);
    this.#rows = rows;
    this.#share = share;
    this.#draw();
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

  /** Pixels. */
  get #height(): number {
    return this.#rows.length * ROW * this.#share + EDGE;
  }

  #draw(): void {
    const height = this.#height;
    this.#plate.draw(height, (context) => {
      context.fillStyle = '#0d141b';
      context.beginPath();
      context.roundRect(0, 0, WIDTH, height, 24);
      context.fill();
      context.textAlign = 'center';
      context.textBaseline = 'middle';
      for (const [index, { text, look }] of this.#rows.entries()) {
        context.font = fontOf(look.weight, SIZE * this.#share);
        context.fillStyle = COLOURS[look.tone];
        context.fillText(text, WIDTH / 2, EDGE / 2 + (index + 0.5) * ROW * this.#share);
      }
    });
  }
}

function fontOf(weight: number, size: number): string {
  return `${weight} ${size}px system-ui, sans-serif`;
}

/** How large so many pixels are before the eyes. */
function degrees(pixels: number): number {
  return (Math.atan(pixels / PIXELS_PER_METRE / DISTANCE_M) * 180) / Math.PI;
}
