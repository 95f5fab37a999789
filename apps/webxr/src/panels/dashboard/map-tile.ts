/** The tile with the map: where the robot is and has been, by its odometry or by satellite. */
import { effect } from '@preact/signals-core';
import { palette } from '../../ground/display/palette.ts';
import type { MapTiles } from '../../ground/telemetry/map-tiles.ts';
import type { TelemetryRecorder } from '../../ground/telemetry/recorder.ts';
import { laterTexts } from '../../words/language.ts';
import { quietButton } from '../ui/panel-parts.ts';
import { paintMap } from './map-painter.ts';
import { MapProjection } from './map-projection.ts';
import { RobotOnMap } from './robot-on-map.ts';
import { part, setText, type Tile, type TileFrame } from './tile.ts';
import { TileStore } from './tile-store.ts';

/**
 * How far a step of the wheel, a key and a button zoom, and a key moves the map. Chosen by hand: a notch of
 * 100 is 16 %.
 */
const WHEEL = 0.0015;
const KEY_ZOOM = 1.4;
const KEY_PAN_PX = 40;
const PANS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [KEY_PAN_PX, 0],
  ArrowRight: [-KEY_PAN_PX, 0],
  ArrowUp: [0, KEY_PAN_PX],
  ArrowDown: [0, -KEY_PAN_PX],
};

/** @param onMoved called after each change; `panned` if the middle was moved by hand */
function listenToGestures(
  canvas: HTMLCanvasElement,
  projection: MapProjection,
  onMoved: (panned: boolean) => void,
): void {
  const pointers = new Map<number, { x: number; y: number }>();
  const placeOf = ({ offsetX, offsetY }: MouseEvent) => ({ left: offsetX, top: offsetY });
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
  });
  canvas.addEventListener('pointermove', (event) => {
    const before = pointers.get(event.pointerId);
    if (before === undefined) return;
    const spread = spreadOf(pointers);
    const [dx, dy] = [event.offsetX - before.x, event.offsetY - before.y];
    before.x = event.offsetX;
    before.y = event.offsetY;
    if (pointers.size === 1) projection.pan(dx, dy);
    else if (spread > 0) {
      const [a, b] = [...pointers.values()] as [{ x: number; y: number }, { x: number; y: number }];
      projection.zoom(spreadOf(pointers) / spread, { left: (a.x + b.x) / 2, top: (a.y + b.y) / 2 });
    }
    onMoved(pointers.size === 1 && (dx !== 0 || dy !== 0));
  });
  for (const end of ['pointerup', 'pointercancel'] as const) {
    canvas.addEventListener(end, (event) => {
      pointers.delete(event.pointerId);
      // A map that kept the focus would take the arrow keys from driving.
      canvas.blur();
    });
  }
  canvas.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      projection.zoom(Math.exp(-event.deltaY * WHEEL), placeOf(event));
      onMoved(false);
    },
    { passive: false },
  );
  // Only where the keyboard has brought the focus here.
  canvas.addEventListener('keydown', (event) => {
    const pan = PANS[event.key];
    if (pan !== undefined) projection.pan(...pan);
    else if (event.key === '+' || event.key === '=') projection.zoom(KEY_ZOOM);
    else if (event.key === '-') projection.zoom(1 / KEY_ZOOM);
    else return;
    event.preventDefault();
    event.stopPropagation();
    onMoved(pan !== undefined);
  });
}

function spreadOf(pointers: ReadonlyMap<number, { x: number; y: number }>): number {
  const [a, b] = [...pointers.values()];
  return a === undefined || b === undefined ? 0 : Math.hypot(a.x - b.x, a.y - b.y);
}

/** Telemetry comes 20 times a second. */
const UPDATE_MS = 50;
const BUTTON_ZOOM = 1.6;

export class MapTile implements Tile {
  readonly element = part('map');
  readonly #canvas = mapCanvas();
  readonly #context = this.#canvas.getContext('2d')!;
  readonly #buttons = part('buttons');
  readonly #following: HTMLButtonElement;
  readonly #turning: HTMLButtonElement;
  readonly #source: HTMLButtonElement;
  readonly #attribution = part('attribution', 'p');
  readonly #projection = new MapProjection();
  readonly #robot: RobotOnMap;
  #store: TileStore | null = null;
  readonly #stopFollowing: () => void;
  readonly #resizing = new ResizeObserver(() => this.#fitCanvas());
  #follow = true;
  #dirty = true;
  /** What was painted last. */
  #painted = '';

  /** @param tiles where the tiles of the earth come from, an effect's source; `null`: none are painted */
  constructor(recorder: TelemetryRecorder, tiles: () => MapTiles | null) {
    this.#robot = new RobotOnMap(recorder);
    this.element.append(this.#canvas, this.#buttons, this.#attribution);
    const said = laterTexts().dashboard;
    this.#addButton('+', said.zoomIn, () => this.#projection.zoom(BUTTON_ZOOM));
    this.#addButton('−', said.zoomOut, () => this.#projection.zoom(1 / BUTTON_ZOOM));
    this.#following = this.#addButton(said.follow, said.followTitle, () => this.#setFollow(!this.#follow));
    this.#turning = this.#addButton(said.northUp, said.upTitle, () => this.#turn());
    this.#source = this.#addButton(said.byOdometry, said.sourceTitle, () => this.#switchSource());
    this.#setFollow(true);
    this.#stopFollowing = effect(() => this.#open(tiles()));
    listenToGestures(this.#canvas, this.#projection, (panned) => {
      if (panned) this.#setFollow(false);
      this.#dirty = true;
    });
    this.#resizing.observe(this.#canvas);
  }

  everyMs(): number {
    return UPDATE_MS;
  }

  update(frame: TileFrame): void {
    // A robot without a satellite receiver has only its odometry.
    this.#source.hidden = !this.#robot.hasReceiver;
    if (this.#source.hidden && this.#robot.bySatellite) {
      this.#robot.forgetReceiver();
      this.#showSource();
    }
    this.#paint(frame);
  }

  dispose(): void {
    this.#resizing.disconnect();
    this.#stopFollowing();
    this.#store?.close();
  }

  #open(tiles: MapTiles | null): void {
    this.#store?.close();
    this.#store = tiles === null ? null : new TileStore(tiles);
    if (this.#store !== null)
      this.#store.onReady = () => {
        this.#dirty = true;
      };
    this.#dirty = true;
    this.#showSource();
  }

  #addButton(text: string, title: string, act: () => void): HTMLButtonElement {
    const button = quietButton(text, title, () => {
      act();
      this.#dirty = true;
    });
    // A symbol says nothing to whoever hears it; a word is its own name (WCAG 2.2, 2.5.3).
    if (text.length === 1) button.ariaLabel = title;
    this.#buttons.append(button);
    return button;
  }

  #setFollow(follow: boolean): void {
    this.#follow = follow;
    this.#following.ariaPressed = String(follow);
  }

  #turn(): void {
    this.#projection.up = this.#projection.up === 'north' ? 'x' : 'north';
    this.#showDirection();
  }

  #showDirection(): void {
    const said = laterTexts().dashboard;
    setText(this.#turning, this.#projection.up === 'north' ? said.northUp : said.xUp);
  }

  #switchSource(): void {
    this.#robot.bySatellite = !this.#robot.bySatellite;
    this.#setFollow(true);
    this.#showSource();
  }

  #showSource(): void {
    const { bySatellite } = this.#robot;
    const said = laterTexts().dashboard;
    setText(this.#source, bySatellite ? said.bySatellite : said.byOdometry);
    // Tiles have north up.
    this.#turning.disabled = bySatellite;
    if (bySatellite) this.#projection.up = 'north';
    this.#showDirection();
    this.#attribution.hidden = !bySatellite || this.#store === null;
    setText(this.#attribution, this.#store?.attribution ?? '');
  }

  #fitCanvas(): void {
    const { clientWidth, clientHeight } = this.#canvas;
    const ratio = Math.min(window.devicePixelRatio, 2);
    this.#canvas.width = Math.max(1, Math.round(clientWidth * ratio));
    this.#canvas.height = Math.max(1, Math.round(clientHeight * ratio));
    this.#projection.width = Math.max(1, clientWidth);
    this.#projection.height = Math.max(1, clientHeight);
    this.#context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.#dirty = true;
  }

  /** Paints only what has changed since the last time. */
  #paint({ moment, nowMs }: TileFrame): void {
    const robot = this.#robot;
    const { shown = null, place = null } = robot.positionAt(moment) ?? {};
    const { plane, track } = robot;
    const stale = shown?.stale ?? true;
    const yaw = robot.yawAt(moment);
    const key = `${place?.x} ${place?.y} ${yaw} ${stale} ${track.length} ${palette.version}`;
    if (!this.#dirty && key === this.#painted) return;
    this.#dirty = false;
    this.#painted = key;
    if (this.#follow && place !== null) this.#projection.centre = place;
    paintMap(
      this.#context,
      {
        projection: this.#projection,
        track,
        robot: place,
        yaw,
        stale,
        placeOf: (first, second) => robot.placeOf(first, second),
        earth: plane === null ? null : { plane, tiles: this.#store },
      },
      nowMs,
    );
    this.element.dataset.stale = String(stale);
  }
}

function mapCanvas(): HTMLCanvasElement {
  const canvas = document.createElement('canvas');
  canvas.tabIndex = 0;
  canvas.setAttribute('role', 'img');
  canvas.ariaLabel = laterTexts().dashboard.mapLabel;
  return canvas;
}
