/** Lets an operator point at a spot on the floor, and shows where others point. */
import type { RobotClient } from '@farpoint/operator';
import type { Spot } from '@farpoint/protocol';
import { Raycaster, Vector2 } from 'three';
import { floorSpot } from '../../scene/view/floor-spot.ts';
import type { Stage } from '../../scene/view/stage.ts';
import type { Notices } from '../../state/notices.ts';
import { Pointers } from '../../state/pointers.ts';
import { texts } from '../../words/language.ts';

export interface PointingUiParts {
  readonly client: Pick<RobotClient, 'link' | 'on' | 'people'>;
  readonly stage: Pick<Stage, 'viewCamera' | 'world' | 'pointers'>;
  readonly notices: Pick<Notices, 'tell'>;
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
      if (!event.altKey || event.button !== 0) return;
      this.#mouse = placeOn(canvas, event);
      this.point();
    });
  }

  /** Points at the floor under the mouse. */
  point(): void {
    const { client, notices } = this.#parts;
    const { link } = client;
    if (link.phase !== 'live') return;
    const said = texts().fleet.pointing;
    const spot = this.#spot();
    const { mayPoint, operators } = link.session;
    const others = operators === null || operators.operators.some(({ you }) => !you);
    if (mayPoint === null) notices.tell(said.notPassedOn, 'warning');
    else if (!mayPoint) notices.tell(said.notPermitted, 'warning');
    else if (!others) notices.tell(said.alone);
    else if (spot === null) notices.tell(said.aim);
    else if (client.people.point(spot)) this.#pointers.own(spot, performance.now());
  }

  /** Call this as often as the scene is brought up to date. @param nowMs page's clock */
  show(nowMs: number): void {
    const { client, stage } = this.#parts;
    const { phase, session } = client.link;
    stage.pointers.show(phase === 'live' ? this.#pointers.shown(session.operators, nowMs) : []);
  }

  #spot(): Spot | null {
    const { client, stage } = this.#parts;
    const { telemetry } = client.link.session;
    if (this.#mouse === null || telemetry === null) return null;
    this.#raycaster.setFromCamera(this.#mouse, stage.viewCamera);
    const { ray } = this.#raycaster;
    // From the scene's axes to the robot's world.
    ray.applyMatrix4(stage.world.matrixWorld.clone().invert());
    return floorSpot(ray, telemetry.pose.position.z);
  }
}

function placeOn(canvas: HTMLCanvasElement, { clientX, clientY }: PointerEvent): Vector2 {
  const { left, top, width, height } = canvas.getBoundingClientRect();
  return new Vector2(((clientX - left) / width) * 2 - 1, 1 - ((clientY - top) / height) * 2);
}
