/** The remembered world of the page: remembers what comes, draws it, also as a small map, and saves and loads it. */
import { MemoryView } from '@farpoint/cloud-view';
import type { HeldClouds } from '@farpoint/operator';
import { type PointFileFormat, type RobotClient, WorldMemory } from '@farpoint/operator';
import type { Camera, Object3D, WebGLRenderer } from 'three';
import type { RememberedFigures } from '../../words/page-stats.ts';
import { MinimapPanel } from './minimap-panel.ts';

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
    this.#memory.limits = { linear: limits.maxLinear, angular: limits.maxAngular };
  }
}
