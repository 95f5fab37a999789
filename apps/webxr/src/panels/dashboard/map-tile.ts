/** The tile with the map: where the robot is and has been, by its odometry or by satellite. */
import type { MapTiles } from '../../ground/telemetry/map-tiles.ts';
import type { TelemetryRecorder } from '../../ground/telemetry/recorder.ts';
import { quietButton } from '../ui/panel-parts.ts';
import { listenToGestures } from './map-gestures.ts';
import { paintMap } from './map-painter.ts';
import { MapProjection } from './map-projection.ts';
import { RobotOnMap } from './robot-on-map.ts';
import { part, setText, type Tile, type TileFrame } from './tile.ts';
import { TileStore } from './tile-store.ts';

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
  readonly #store: TileStore | null;
  readonly #resizing = new ResizeObserver(() => this.#fitCanvas());
  #follow = true;
  #dirty = true;
  /** What was painted last. */
  #painted = '';

  /** @param tiles where the tiles of the earth come from; `null`: none are painted */
  constructor(recorder: TelemetryRecorder, tiles: MapTiles | null) {
    this.#robot = new RobotOnMap(recorder);
    this.#store = tiles === null ? null : new TileStore(tiles);
    this.element.append(this.#canvas, this.#buttons, this.#attribution);
    this.#addButton('+', 'Zoom in', () => this.#projection.zoom(BUTTON_ZOOM));
    this.#addButton('−', 'Zoom out', () => this.#projection.zoom(1 / BUTTON_ZOOM));
    this.#following = this.#addButton('Follow', 'Keep the robot in the middle', () =>
      this.#setFollow(!this.#follow),
    );
    this.#turning = this.#addButton('North up', 'Which direction is up', () => this.#turn());
    this.#source = this.#addButton('Odometry', 'Where the position comes from', () => this.#switchSource());
    this.#setFollow(true);
    this.#showSource();
    if (this.#store !== null)
      this.#store.onReady = () => {
        this.#dirty = true;
      };
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
    this.#store?.close();
  }

  #addButton(text: string, title: string, act: () => void): HTMLButtonElement {
    const button = quietButton(text, title, () => {
      act();
      this.#dirty = true;
    });
    button.ariaLabel = title;
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
    setText(this.#turning, this.#projection.up === 'north' ? 'North up' : 'x up');
  }

  #switchSource(): void {
    this.#robot.bySatellite = !this.#robot.bySatellite;
    this.#setFollow(true);
    this.#showSource();
  }

  #showSource(): void {
    const { bySatellite } = this.#robot;
    setText(this.#source, bySatellite ? 'Satellite' : 'Odometry');
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
    const key = `${place?.x} ${place?.y} ${yaw} ${stale} ${track.length}`;
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
  canvas.ariaLabel = 'Map: arrow keys move it, plus and minus zoom';
  return canvas;
}
