/** The small map on the flat page: asks for what is remembered, and draws it when something has changed. */
import { bodyYaw } from '@farpoint/cloud-view';
import { type RobotClient, TOP_VIEW, type TopView, type WorldMemory } from '@farpoint/operator';
import { writeTopView } from '../../ground/minimap/top-view-pixels.ts';
import { Track } from '../../ground/telemetry/track.ts';
import { rememberedAge } from '../../words/facts.ts';
import { elements } from './elements.ts';
import { drawMinimap } from './minimap-canvas.ts';

/** A point of the trail each 10 cm: 400 m. */
const TRAIL_STEP_M = 0.1;
const TRAIL_POINTS = 4096;
/** Farther from one report to the next, it is another place: what lies before it does not belong to it, metres. */
const JUMP_M = 2;
/** What is remembered is looked at anew after this time, ms. */
const LOOK_MS = 500;
/** What is higher above the robot's ground is not on the map: ceilings would hide all, metres. */
const CEILING_M = 2;
const { cells, cellM } = TOP_VIEW;

export class MinimapPanel {
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
    const words = this.#oldestS === null ? 'nothing yet' : rememberedAge(this.#oldestS);
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
    const changed = this.#changed || !isSame || map.headingUp !== this.headingUp;
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
