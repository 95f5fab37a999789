/** Draws the headset's menu at arm's length beside the line of sight, where it stays, and says which entry a ray hits. */
import { effect } from '@preact/signals-core';
import { Group, Mesh, MeshBasicMaterial, type Object3D, PlaneGeometry } from 'three';
import type { Tone } from '../../words/words.ts';
import { shortened } from '../fitted-text.ts';
import { Fade } from '../headset/fade.ts';
import { headYaw } from '../headset/operator-origin.ts';
import { PLATE_ORDER, TextPlate } from '../headset/text-plate.ts';
import { wrapText } from '../headset/wrapped-text.ts';
import type { MenuItem } from './menu-item.ts';
import type { MenuPage } from './menu-page.ts';
import type { MenuState } from './menu-state.ts';
import { menuYaw } from './view-box.ts';

/** From the eyes, m. Chosen: what a stretched arm reaches, beyond a controller that is held up. */
const DISTANCE_M = 0.7;
const PIXELS_PER_METRE = 2000;
/** Chosen: 28° wide, as view-box.ts places it. */
const WIDTH = 690;
/** From one row to the next, and of the font, pixels. Chosen: capitals of 0.9°, which every headset shows sharply. */
const ROW = 52;
const SIZE = 32;
/** Chosen: an entry for all that there can be at once, and a request of two rows; menu-state.test.ts counts them. */
const MOST_ROWS = 20;
/** From the edge to the text, pixels. Chosen by eye. */
const EDGE = 24;
/** Of the upper edge above the eyes, m. Chosen: as far up as down, for a menu of the usual length. */
const ABOVE_M = 0.16;
/** The lower edge is no farther below the eyes than this, m: capitals of 0.8° there. A longer menu hangs higher. */
const LOWEST_M = 0.26;
/** A text has so many rows at most. Chosen: menu-state.test.ts counts pages with it. */
const ROWS_OF_TEXT = 2;
/** Of the mark on an entry, whose text stays readable below it. */
const MARK_OPACITY = 0.3;
/** Height of capital letters, share of a font's size: of the least that system fonts have. */
const CAPITAL = 0.7;
const QUIET = '#9fb2c1';
const COLOURS: Readonly<Record<Tone | 'chosen' | 'quiet', string>> = {
  good: '#35c9b5',
  neutral: '#e6edf3',
  warning: '#f0b429',
  bad: '#ffffff',
  chosen: '#35c9b5',
  quiet: QUIET,
};

interface DrawnItem {
  readonly item: MenuItem;
  readonly rows: readonly string[];
  /** Its first row, counted from the plate's upper edge. */
  readonly top: number;
}

export class MenuPanel {
  /** A child of the rig. */
  readonly object = new Group();
  readonly #plate = new TextPlate({
    width: WIDTH,
    height: MOST_ROWS * ROW,
    pixelsPerMetre: PIXELS_PER_METRE,
    order: PLATE_ORDER.menu,
  });
  readonly #mark: Mesh<PlaneGeometry, MeshBasicMaterial>;
  readonly #fade = new Fade();
  #items: readonly DrawnItem[] = [];
  #drawn = '';
  #rows = 1;
  /** Height of the eyes when it was placed, m. */
  #eyesY = 0;

  constructor(menu: MenuState) {
    const colour = {
      color: 0x35c9b5,
      opacity: MARK_OPACITY,
      transparent: true,
      depthTest: false,
      depthWrite: false,
    };
    this.#mark = new Mesh(
      new PlaneGeometry(WIDTH / PIXELS_PER_METRE, ROW / PIXELS_PER_METRE),
      new MeshBasicMaterial(colour),
    );
    this.#mark.renderOrder = PLATE_ORDER.mark;
    this.object.add(this.#plate.mesh, this.#mark);
    this.update(0);
    effect(() => {
      const page = menu.page.value;
      this.#fade.shown = page !== null;
      // What it showed fades out with it.
      if (page === null) return;
      this.#draw(page);
      this.#placeMark(menu.marked.value);
    });
  }

  /** Call this before each display frame in VR. Allocates nothing. */
  update(elapsedMs: number): void {
    const share = this.#fade.update(elapsedMs);
    this.object.visible = share > 0;
    this.#plate.opacity = share;
    this.#mark.material.opacity = share * MARK_OPACITY;
  }

  /** It is gone at once: nobody wears the headset. */
  clear(): void {
    this.#fade.clear();
    this.update(0);
  }

  /** What a ray can hit. */
  get sheet(): Mesh {
    return this.#plate.mesh;
  }

  /** Height of a capital letter in the row that is farthest from the eyes, degrees. */
  get letterDegrees(): number {
    const above = this.#aboveM;
    const low = (this.#rows * ROW) / PIXELS_PER_METRE - above;
    const high = (SIZE * CAPITAL) / PIXELS_PER_METRE;
    const from = Math.max(low, above);
    return ((Math.atan(from / DISTANCE_M) - Math.atan((from - high) / DISTANCE_M)) * 180) / Math.PI;
  }

  /** It goes beside where the head looks now, and stays there. @param ahead direction of ahead, radians to the left */
  place(head: Object3D, ahead: number): void {
    const yaw = menuYaw(headYaw(head.quaternion), ahead);
    const { x, y, z } = head.position;
    this.#eyesY = y;
    this.object.rotation.y = yaw;
    this.object.position.set(
      x - Math.sin(yaw) * DISTANCE_M,
      y + this.#aboveM,
      z - Math.cos(yaw) * DISTANCE_M,
    );
  }

  /** Of the upper edge above the eyes, m. */
  get #aboveM(): number {
    return Math.max(ABOVE_M, (this.#rows * ROW) / PIXELS_PER_METRE - LOWEST_M);
  }

  /** The entry that was hit; −1: none. @param v of the hit, 1 at the upper edge */
  entryAt(v: number): number {
    const row = (1 - v) * this.#rows;
    return this.#items.findIndex(({ top, rows }) => row >= top && row < top + rows.length);
  }

  /** The middle of an entry, m below the origin of {@link object}. */
  middleOf(entry: number): number {
    const { top = 0, rows = [] } = this.#items[entry] ?? {};
    return ((top + rows.length / 2) * ROW) / PIXELS_PER_METRE;
  }

  #placeMark(entry: number): void {
    const drawn = this.#items[entry];
    this.#mark.visible = drawn !== undefined && drawn.item.choice !== null;
    if (drawn === undefined) return;
    this.#mark.position.y = -this.middleOf(entry);
    this.#mark.scale.y = drawn.rows.length;
  }

  /** Redraws only what has changed. */
  #draw(page: MenuPage): void {
    const key = JSON.stringify(page);
    if (key === this.#drawn) return;
    this.#drawn = key;
    let top = 1;
    this.#items = page.items.map((item) => {
      const measure = (text: string) => this.#plate.measure(text, fontOf(item));
      const rows = item.note === undefined ? rowsOf(item.text, measure) : twoRows(item, measure);
      const drawn = { item, rows, top };
      top += rows.length;
      return drawn;
    });
    this.#rows = Math.min(top, MOST_ROWS);
    const height = this.#rows * ROW;
    this.object.position.y = this.#eyesY + this.#aboveM;
    this.#plate.draw(height, (context) => {
      context.fillStyle = '#0d141b';
      context.beginPath();
      context.roundRect(0, 0, WIDTH, height, 24);
      context.fill();
      context.textBaseline = 'middle';
      context.textAlign = 'left';
      context.font = `700 ${SIZE}px system-ui, sans-serif`;
      context.fillStyle = QUIET;
      context.fillText(page.title, EDGE, ROW / 2, WIDTH - 2 * EDGE);
      for (const drawn of this.#items) paintItem(context, drawn);
    });
    // A ray finds it where it is now, not one frame later.
    this.object.updateMatrixWorld(true);
  }
}

function paintItem(context: CanvasRenderingContext2D, { item, rows, top }: DrawnItem): void {
  const { note } = item;
  if (item.choice !== null) {
    context.fillStyle = item.tone === 'bad' ? '#7a1a1f' : '#1b2833';
    context.beginPath();
    context.roundRect(8, top * ROW + 3, WIDTH - 16, rows.length * ROW - 6, 12);
    context.fill();
  }
  context.font = fontOf(item);
  const isAlarm = item.choice === null && item.tone === 'bad';
  context.fillStyle = isAlarm ? '#ff8080' : COLOURS[item.tone ?? 'neutral'];
  // A text without a note stands in the middle.
  const from = note === '' ? top + 0.5 : top;
  for (const [row, text] of rows.entries()) {
    if (row > 0 && note !== undefined) context.fillStyle = QUIET;
    context.fillText(text, EDGE, (from + row + 0.5) * ROW + 2, WIDTH - 2 * EDGE);
  }
}

function fontOf({ choice, tone }: MenuItem): string {
  const isBold = choice !== null && tone === 'bad';
  return `${isBold ? 700 : 500} ${SIZE}px system-ui, sans-serif`;
}

/** Its text and its note, each as long as one row. */
function twoRows({ text, note = '' }: MenuItem, measure: (text: string) => number): string[] {
  const fits = (part: string) => measure(part) <= WIDTH - 2 * EDGE;
  return [shortened(text, fits), shortened(note, fits)];
}

/** A robot's name has any length. */
function rowsOf(text: string, measure: (text: string) => number): string[] {
  const rows = wrapText(text, WIDTH - 2 * EDGE, measure);
  if (rows.length <= ROWS_OF_TEXT) return rows.length === 0 ? [''] : rows;
  const last = rows[ROWS_OF_TEXT - 1] ?? '';
  return [...rows.slice(0, ROWS_OF_TEXT - 1), `${last.slice(0, -1).trimEnd()}…`];
}
