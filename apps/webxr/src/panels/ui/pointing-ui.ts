/** Lets an operator point at a spot on the floor, and shows where others point. */
import type { RobotClient } from '@farpoint/operator';
import type { Spot } from '@farpoint/protocol';
import { type Ray, Raycaster, Vector2 } from 'three';
import { floorSpot } from '../../scene/view/floor-spot.ts';
import type { Stage } from '../../scene/view/stage.ts';
import type { Notices } from '../../state/notices.ts';
import { Pointers, pointingBar } from '../../state/pointers.ts';
import { texts } from '../../words/language.ts';
import { LONG_PRESS_MS, LongPress } from './long-press.ts';

export interface PointingUiParts {
  readonly client: Pick<RobotClient, 'link' | 'on' | 'people'>;
  readonly stage: Pick<Stage, 'viewCamera' | 'world' | 'pointers'>;
  readonly notices: Pick<Notices, 'tell'>;
  /** The finger feels that it has pointed. */
  feel(): void;
}

export class PointingUi {
  readonly #parts: PointingUiParts;
  readonly #pointers = new Pointers();
  readonly #raycaster = new Raycaster();
  /** Where the mouse is over the canvas, −1…1 to the right and up; `null` if it is not. */
  #mouse: Vector2 | null = null;

  constructor(parts: PointingUiParts) {
    this.#parts = parts;
    const { client } = parts;
    client.on('session', () => this.#pointers.clear());
    client.on('pointed', ({ by, at }) => this.#pointers.take(by, at, performance.now()));
  }

  start(canvas: HTMLCanvasElement): void {
    canvas.addEventListener('pointermove', (event) => {
      this.#mouse = placeOn(canvas, event);
    });
    canvas.addEventListener('pointerleave', () => {
      this.#mouse = null;
    });
    canvas.addEventListener('pointerdown', (event) => {
      this.#mouse = placeOn(canvas, event);
      if (event.altKey && event.button === 0) this.point();
    });
    this.#listenToFingers(canvas);
  }

  #listenToFingers(canvas: HTMLCanvasElement): void {
    const press = new LongPress();
    let timer: ReturnType<typeof setTimeout> | undefined;
    const on = (type: 'pointerdown' | 'pointermove' | 'pointerup' | 'pointercancel', act: FingerAct) =>
      canvas.addEventListener(type, ({ pointerType, pointerId, clientX, clientY }) => {
        if (pointerType !== 'touch') return;
        act(pointerId, clientX, clientY);
        if (!press.waits) clearTimeout(timer);
      });
    on('pointerdown', (id, x, y) => {
      press.down(id, x, y);
      clearTimeout(timer);
      timer = setTimeout(() => {
        const pointerId = press.take();
        if (pointerId === null) return;
        if (this.#tellMouse(texts().fleet.pointing.aimFinger)) this.#parts.feel();
        // What the finger does until it is let go turns nothing.
        canvas.dispatchEvent(new PointerEvent('pointercancel', { pointerId }));
      }, LONG_PRESS_MS);
    });
    on('pointermove', (id, x, y) => press.move(id, x, y));
    for (const end of ['pointerup', 'pointercancel'] as const) on(end, (id) => press.up(id));
  }

  /** Points at the floor under the mouse. */
  point(): void {
    this.#tellMouse(texts().fleet.pointing.aim);
  }

  /** Tells the others of a spot. @param missed what to say where there is none @returns whether they are told */
  tell(spot: Spot | null, missed: string): boolean {
    const { client, notices } = this.#parts;
    const { link } = client;
    if (link.phase !== 'live') return false;
    const bar = pointingBar(link.session);
    if (bar !== null) notices.tell(texts().fleet.pointing[bar], bar === 'alone' ? 'neutral' : 'warning');
    else if (spot === null) notices.tell(missed);
    else if (client.people.point(spot)) {
      this.#pointers.own(spot, performance.now());
      return true;
    }
    return false;
  }

  /** Call this as often as the scene is brought up to date. @param nowMs page's clock */
  show(nowMs: number): void {
    const { client, stage } = this.#parts;
    const { phase, session } = client.link;
    stage.pointers.show(phase === 'live' ? this.#pointers.shown(session.operators, nowMs) : []);
  }

  /**
   * Where a ray meets the floor; `null`: nowhere, or too far away.
   *
   * @param ray in the scene's axes
   * @param scale as {@link floorSpot} has it
   */
  spotAlong(ray: Ray, scale = 1): Spot | null {
    const { client, stage } = this.#parts;
    const { telemetry } = client.link.session;
    if (telemetry === null) return null;
    const inWorld = ray.clone().applyMatrix4(stage.world.matrixWorld.clone().invert());
    return floorSpot(inWorld, telemetry.pose.position.z, scale);
  }

  #tellMouse(missed: string): boolean {
    if (this.#mouse === null) return this.tell(null, missed);
    const { viewCamera } = this.#parts.stage;
    this.#raycaster.setFromCamera(this.#mouse, viewCamera);
    // From above, the floor is as far away as the camera hangs high, and the screen's edge bounds what is in view.
    const scale = 'isOrthographicCamera' in viewCamera ? Number.POSITIVE_INFINITY : 1;
    return this.tell(this.spotAlong(this.#raycaster.ray, scale), missed);
  }
}

type FingerAct = (id: number, x: number, y: number) => void;

function placeOn(canvas: HTMLCanvasElement, { clientX, clientY }: PointerEvent): Vector2 {
  const { left, top, width, height } = canvas.getBoundingClientRect();
  return new Vector2(((clientX - left) / width) * 2 - 1, 1 - ((clientY - top) / height) * 2);
}
