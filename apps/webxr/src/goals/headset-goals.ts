/**
 * Goals from the headset: a trigger that is held while it points at the floor marks the place, and letting go of it sends the
 * robot there. A short pull takes a goal back. A trigger that does anything else, and a bare hand, name none.
 */
import {
  BufferGeometry,
  Line,
  LineBasicMaterial,
  Quaternion,
  Vector3,
  type WebXRManager,
  type XRTargetRaySpace,
} from 'three';
import type { Words } from '../status/tone.ts';
import type { Stage } from '../view/stage.ts';
import type { VrSession } from '../view/vr-session.ts';
import { type FloorPlace, floorAlong } from './floor-pick.ts';
import type { GoalAim } from './goal-aim.ts';
import { GoalSign } from './goal-sign.ts';
import type { GoalsUi } from './goals-ui.ts';
import { HeldAim } from './held-aim.ts';

const RAY = { open: 0x6ea8ff, ready: 0x35c9b5 };
/** Of a ray that hits no floor, m. */
const RAY_M = 5;
const WORDS: Readonly<Record<'away' | 'hold' | 'ready', Words>> = {
  away: { text: 'There is no floor there', tone: 'warning' },
  hold: { text: 'Keep holding: go here', tone: 'neutral' },
  ready: { text: 'Let go: the robot comes here', tone: 'good' },
};

export interface HeadsetGoalsParts {
  readonly goals: GoalsUi;
  readonly stage: Pick<Stage, 'rig' | 'world'> & {
    readonly renderer: { readonly xr: Pick<WebXRManager, 'getController'> };
  };
  readonly vr: Pick<VrSession, 'active' | 'hidden'>;
  /** Whether this controller's trigger means nothing else now, and no hand drives. */
  isFree(index: number): boolean;
}

interface AimingRay {
  readonly controller: XRTargetRaySpace;
  readonly line: Line<BufferGeometry, LineBasicMaterial>;
  /** A bare hand that the headset tracks. */
  isHand: boolean;
}

export class HeadsetGoals implements GoalAim {
  readonly #parts: HeadsetGoalsParts;
  readonly #aim = new HeldAim();
  readonly #sign = new GoalSign();
  readonly #rays: readonly AimingRay[];
  readonly #from = new Vector3();
  readonly #along = new Vector3();
  readonly #turn = new Quaternion();

  constructor(parts: HeadsetGoalsParts) {
    this.#parts = parts;
    const { stage } = parts;
    stage.world.add(this.#sign.object);
    this.#rays = [0, 1].map((index) => this.#ray(stage.renderer.xr.getController(index), index));
  }

  get said(): string {
    return this.#sign.said;
  }

  tick(nowMs: number): { place: FloorPlace | null; words: Words } | null {
    const aim = this.#aim;
    const { hand } = aim;
    for (const [index, { line }] of this.#rays.entries()) line.visible = index === hand;
    const ray = hand === null ? undefined : this.#rays[hand];
    if (hand === null || ray === undefined) return null;
    if (!this.#mayAim(hand) || !ray.controller.visible) {
      aim.cancel();
      ray.line.visible = false;
      return null;
    }
    aim.point(this.#floorUnder(ray), nowMs);
    const isReady = aim.isReady(nowMs);
    ray.line.material.color.setHex(isReady ? RAY.ready : RAY.open);
    return { place: aim.place, words: WORDS[aim.place === null ? 'away' : isReady ? 'ready' : 'hold'] };
  }

  say(place: FloorPlace | null, words: Words | null, ground: number): void {
    const { vr } = this.#parts;
    if (place === null || words === null || !vr.active.peek()) this.#sign.hide();
    else this.#sign.show(place, words, ground);
  }

  #mayAim(index: number): boolean {
    const { goals, vr, isFree } = this.#parts;
    return vr.active.peek() && !vr.hidden && goals.isOffered && isFree(index);
  }

  #ray(controller: XRTargetRaySpace, index: number): AimingRay {
    const points = [new Vector3(0, 0, 0), new Vector3(0, 0, -1)];
    const line = new Line(
      new BufferGeometry().setFromPoints(points),
      new LineBasicMaterial({ color: RAY.open }),
    );
    line.visible = false;
    controller.add(line);
    this.#parts.stage.rig.add(controller);
    const ray: AimingRay = { controller, line, isHand: false };
    controller.addEventListener('connected', (event) => {
      ray.isHand = event.data.hand != null;
    });
    controller.addEventListener('disconnected', () => this.#aim.letGo(index, Number.NEGATIVE_INFINITY));
    controller.addEventListener('selectstart', () => {
      if (!ray.isHand && this.#mayAim(index)) this.#aim.pull(index, performance.now());
    });
    controller.addEventListener('selectend', () => this.#onLetGo(index));
    return ray;
  }

  #onLetGo(index: number): void {
    const { goals } = this.#parts;
    const mayAim = this.#mayAim(index);
    const isAway = this.#aim.hand === index && this.#aim.place === null;
    const aimed = this.#aim.letGo(index, performance.now());
    if (!mayAim) return;
    if (aimed.kind === 'nothing' && isAway) goals.tellNoFloor();
    if (aimed.kind === 'goal') goals.go(aimed.place);
    else if (aimed.kind === 'click') goals.takeBack();
  }

  #floorUnder({ controller, line }: AimingRay): FloorPlace | null {
    const { goals, stage } = this.#parts;
    controller.getWorldPosition(this.#from);
    this.#along.set(0, 0, -1).applyQuaternion(controller.getWorldQuaternion(this.#turn));
    const hit = floorAlong(this.#from, this.#along, stage.world, goals.ground);
    line.scale.z = hit === null ? RAY_M : hit.metres;
    return hit === null ? null : { x: hit.x, y: hit.y };
  }
}
