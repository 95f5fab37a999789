/** The remembered world of the page: remembers what comes, draws it, also as a small map, and saves and loads it. */

import { bodyYaw, MemoryView } from '@farpoint/cloud-view';
import {
  type HeldClouds,
  type PointFileFormat,
  type RobotClient,
  TOP_VIEW,
  type TopView,
  WorldMemory,
} from '@farpoint/operator';
import type { Camera, Object3D, WebGLRenderer } from 'three';
import { palette } from '../../ground/display/palette.ts';
import { writeTopView } from '../../ground/minimap/top-view-pixels.ts';
import { Track } from '../../ground/telemetry/track.ts';
import { JUMP_M } from '../../scene/pose-follower.ts';
import { rememberedAge } from '../../words/facts.ts';
import { texts } from '../../words/language.ts';
import type { RememberedFigures } from '../../words/page-stats.ts';
import { elements } from './elements.ts';
import { drawMinimap } from './minimap-canvas.ts';

/** A point of the trail each 10 cm: 400 m. */
const TRAIL_STEP_M = 0.1;
const TRAIL_POINTS = 4096;
/** What is remembered is looked at anew after this time, ms. Chosen: two key frames (docs/memory.md). */
const LOOK_MS = 500;
/** What is higher above the robot's ground is not on the map: ceilings would hide all, metres. */
const CEILING_M = 2;
const { cells, cellM } = TOP_VIEW;

/** The small map on the flat page: asks for what is remembered, and draws it when something has changed. */
class MinimapPanel {
  /** The robot's heading is up; otherwise the world's y axis. */
  headingUp = true;
  readonly #client: RobotClient;
  readonly #trail = new Track(TRAIL_STEP_M, TRAIL_POINTS);
  readonly #area = { x: 0, y: 0, ground: 0, ceiling: CEILING_M };
  /** What is drawn; changed in place. */
  readonly #map = {
    image: null as HTMLCanvasElement | null,
    left: 0,
    bottom: 0,
    side: cells * cellM,
    x: 0,
    y: 0,
    yaw: 0,
    headingUp: true,
    stale: false,
    trail: this.#trail,
  };
  readonly #image = document.createElement('canvas');
  #pixels: ImageData | null = null;
  #oldestS: number | null = null;
  #lookedMs = Number.NEGATIVE_INFINITY;
  #size = 0;
  /** Of the palette that the map was drawn with. */
  #version = -1;
  #changed = true;

  constructor(client: RobotClient) {
    this.#client = client;
    this.#image.width = cells;
    this.#image.height = cells;
    client.on('session', () => this.#forget());
    client.on('telemetry', ({ pose }) => this.#drive(pose.position.x, pose.position.y));
  }

  /** Takes what {@link update} asked for. */
  take(view: TopView): void {
    const context = this.#image.getContext('2d');
    if (context === null) return;
    this.#pixels ??= context.createImageData(cells, cells);
    writeTopView(view, this.#pixels.data);
    context.putImageData(this.#pixels, 0, 0);
    const map = this.#map;
    map.image = this.#image;
    map.left = view.x;
    map.bottom = view.y;
    this.#oldestS = view.oldestS;
    this.#changed = true;
  }

  /**
   * Draws the map anew if it has changed. Call it a few times a second.
   *
   * @param memory `null` while nothing is remembered, or nobody sees the page
   */
  update(memory: Pick<WorldMemory, 'lookFromAbove'> | null, nowMs: number): void {
    const { session } = this.#client.link;
    const { telemetry } = session;
    const { minimap, minimapPicture: canvas, minimapAge } = elements;
    const shown = memory !== null && telemetry !== null;
    minimap.hidden = !shown;
    // Without a place on a small screen, it costs nothing.
    const size = shown ? Math.round(canvas.clientWidth * Math.min(window.devicePixelRatio, 3)) : 0;
    if (!shown || size === 0) return;
    const { x, y, z } = telemetry.pose.position;
    if (nowMs - this.#lookedMs >= LOOK_MS) {
      this.#lookedMs = nowMs;
      const area = this.#area;
      area.x = x;
      area.y = y;
      area.ground = z;
      memory.lookFromAbove(area);
    }
    const words = this.#oldestS === null ? texts().measures.nothingYet : rememberedAge(this.#oldestS);
    if (minimapAge.textContent !== words) minimapAge.textContent = words;
    if (!this.#place(x, y, bodyYaw(telemetry.pose.orientation)) && size === this.#size) return;
    if (size !== this.#size) {
      canvas.width = size;
      canvas.height = size;
      this.#size = size;
    }
    const context = canvas.getContext('2d');
    if (context !== null) drawMinimap(context, size, this.#map);
  }

  /** @returns whether the picture is another one now */
  #place(x: number, y: number, yaw: number): boolean {
    const map = this.#map;
    const stale = this.#client.link.interrupted;
    const isSame = x === map.x && y === map.y && yaw === map.yaw && stale === map.stale;
    const { version } = palette;
    const isDrawn = !this.#changed && version === this.#version;
    const changed = !isDrawn || !isSame || map.headingUp !== this.headingUp;
    this.#version = version;
    map.x = x;
    map.y = y;
    map.yaw = yaw;
    map.stale = stale;
    map.headingUp = this.headingUp;
    this.#changed = false;
    return changed;
  }

  #drive(x: number, y: number): void {
    const trail = this.#trail;
    const last = trail.length - 1;
    if (last >= 0 && Math.hypot(x - trail.xAt(last), y - trail.yAt(last)) > JUMP_M) trail.clear();
    trail.add(x, y);
  }

  #forget(): void {
    this.#trail.clear();
    this.#map.image = null;
    this.#oldestS = null;
    this.#changed = true;
  }
}

export interface RememberedWorldParts {
  readonly renderer: WebGLRenderer;
  /** The object that what is remembered is added to. */
  readonly world: Object3D;
  readonly client: RobotClient;
  readonly held: HeldClouds;
}

export class RememberedWorld {
  readonly #parts: RememberedWorldParts;
  readonly #map: MinimapPanel;
  #memory: WorldMemory | null = null;
  #view: MemoryView | null = null;
  #on = false;

  constructor(parts: RememberedWorldParts) {
    this.#parts = parts;
    const { client, held } = parts;
    this.#map = new MinimapPanel(client);
    held.onBatch = (batch) => this.#memory?.take(batch);
    // Another session may have another world: a robot that was started anew counts its way from there.
    client.on('session', () => this.#memory?.forget());
    client.on('phase', (phase) => {
      if (phase === 'none') this.#memory?.forget();
    });
    client.on('welcome', () => this.#limit());
  }

  /** Whether what comes is remembered, and what is remembered is shown. */
  set on(on: boolean) {
    this.#on = on;
    // A worker and its memory are only made for those who want them.
    if (on && this.#memory === null) this.#begin();
    if (this.#memory !== null) this.#memory.enabled = on;
    if (this.#view !== null) this.#view.enabled = on;
  }

  /** What draws it; `null` until it was switched on. */
  get view(): MemoryView | null {
    return this.#view;
  }

  /** Whether the robot's heading is up on the small map; otherwise the world's y axis. */
  set headingUp(up: boolean) {
    this.#map.headingUp = up;
  }

  /** Brings the small map up to date. Call it a few times a second. @returns what is in view; `null`: nothing */
  updateMap(nowMs: number): RememberedFigures | null {
    const isSeen = this.#on && !this.#parts.renderer.xr.isPresenting && !document.hidden;
    this.#map.update(isSeen ? this.#memory : null, nowMs);
    const view = this.#view;
    if (view === null || view.oldestS === null) return null;
    return { points: view.drawn, oldestS: view.oldestS };
  }

  /** Call it before each rendering, after the camera was placed. @param like draws the same heights, and tints the same */
  update(camera: Camera, like: Pick<MemoryView, 'cut' | 'ground' | 'hazards'>): void {
    const view = this.#view;
    if (view === null) return;
    view.cut = like.cut;
    view.ground = like.ground;
    view.hazards = like.hazards;
    view.update(camera);
  }

  /** Forgets everything that was seen until now. */
  forget(): void {
    this.#memory?.forget();
  }

  /** Everything as a file; `null` if nothing was ever remembered. */
  save(format: PointFileFormat): Promise<ArrayBuffer | null> {
    return this.#memory?.save(format) ?? Promise.resolve(null);
  }

  /**
   * Adds what is in a PLY or PCD file.
   *
   * @returns the number of points added
   * @throws {MemoryFileError} says what is wrong with it
   */
  async load(file: File): Promise<number> {
    if (this.#memory === null) this.#begin();
    const agoS = Math.max((Date.now() - file.lastModified) / 1000, 0);
    return (await this.#memory?.load(await file.arrayBuffer(), agoS)) ?? 0;
  }

  #begin(): void {
    const { renderer, world } = this.#parts;
    this.#memory = new WorldMemory();
    this.#memory.enabled = this.#on;
    this.#memory.onTopView = (view) => this.#map.take(view);
    this.#view = new MemoryView(renderer, this.#memory);
    this.#view.enabled = this.#on;
    world.add(this.#view);
    this.#limit();
  }

  #limit(): void {
    const limits = this.#parts.client.link.session.welcome?.limits;
    if (limits === undefined || this.#memory === null) return;
    const linear = Math.max(limits.maxLinear, limits.maxLateral ?? 0);
    this.#memory.limits = { linear, angular: limits.maxAngular };
  }
}
