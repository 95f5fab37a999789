/** Goals: G or a button arms it, a click on the floor sends the robot there, and a drag says where it is to look. */
import type { GoalPlace, GoalStatus, RobotClient } from '@farpoint/operator';
import { effect, signal } from '@preact/signals-core';
import type { PageState } from '../state/page-state.ts';
import { elements } from '../ui/elements.ts';
import type { Stage } from '../view/stage.ts';
import { floorUnder } from './floor-pick.ts';
import type { GoalAim } from './goal-aim.ts';
import { armedWords, distanceWords, goalWords } from './goal-words.ts';

/** What became of a goal is shown for so long, ms. */
const SHOWN_MS = 6000;
/** A shorter drag is a click, m. */
const LEAST_DRAG_M = 0.25;
/** Without the grip they move nothing, but whoever presses them wants to drive. */
const DRIVE_KEYS: ReadonlySet<string> = new Set([
  ...['KeyW', 'KeyA', 'KeyS', 'KeyD', 'ArrowUp', 'ArrowDown', 'ArrowLeft', 'ArrowRight'],
]);

export interface GoalsParts {
  readonly client: RobotClient;
  readonly state: Pick<PageState, 'driving' | 'notices' | 'link'>;
  readonly stage: Pick<Stage, 'viewCamera' | 'world' | 'goal'>;
}

export class GoalsUi {
  /** The next click on the floor is a goal. */
  readonly armed = signal(false);
  /** How a headset names goals; `null` until it can. */
  headset: GoalAim | null = null;
  readonly #parts: GoalsParts;
  /** Where the pointer went down, and where the robot is to look. */
  #drawn: { pointer: number; place: GoalPlace } | null = null;
  #endedMs = Number.NEGATIVE_INFINITY;

  constructor(parts: GoalsParts) {
    this.#parts = parts;
  }

  /** Whether this robot takes goals from this operator. */
  get isOffered(): boolean {
    const { client, state } = this.#parts;
    const { goals, driver, phase } = client;
    const mayDrive = driver.holder !== 'other' && state.driving.role.peek() !== 'watch';
    return phase === 'live' && goals.offer !== null && mayDrive;
  }

  start(): void {
    const { client } = this.#parts;
    const { stage: canvas, goTo } = elements;
    goTo.addEventListener('click', () => this.toggle());
    effect(() => {
      const armed = this.armed.value;
      goTo.setAttribute('aria-pressed', String(armed));
      canvas.classList.toggle('picks-goal', armed);
      if (!armed) this.#drawn = null;
    });
    client.on('goal', (status) => {
      if (status === null) return;
      this.#endedMs = client.goals.active ? Number.NEGATIVE_INFINITY : performance.now();
    });
    // Before those that turn the view.
    const first = { capture: true };
    canvas.addEventListener('pointerdown', (event) => this.#onDown(event), first);
    canvas.addEventListener('pointermove', (event) => this.#onMove(event), first);
    canvas.addEventListener('pointerup', (event) => this.#onUp(event), first);
    canvas.addEventListener('pointercancel', () => {
      this.#drawn = null;
    });
    window.addEventListener('keydown', ({ code }) => {
      if (code === 'Escape' && this.armed.peek()) this.armed.value = false;
      else if (code === 'Escape') this.takeBack();
      else if (DRIVE_KEYS.has(code)) client.goals.cancel('stick');
    });
  }

  toggle(): void {
    if (this.armed.peek()) this.armed.value = false;
    else if (this.isOffered) this.armed.value = true;
    else if (this.#parts.client.phase === 'live') {
      const takes = this.#parts.client.goals.offer !== null;
      this.#parts.state.notices.tell(
        takes ? 'Somebody else is driving.' : 'This robot takes no goals.',
        'warning',
      );
    }
  }

  /** Call this at the rate of the commands. */
  tick(nowMs: number): void {
    const { stage } = this.#parts;
    const { goTo, goToHint, goalState, goalWords: goalWordsElement, goalDistance } = elements;
    const isOffered = this.isOffered;
    if (!isOffered) this.armed.value = false;
    if (goTo.hidden === isOffered) [goTo.hidden, goToHint.hidden] = [!isOffered, !isOffered];
    const status = this.#shown(nowMs);
    const aimed = this.headset?.tick(nowMs) ?? null;
    const ofGoal = status === null ? null : goalWords(status);
    const words = this.armed.peek() ? armedWords : (aimed?.words ?? ofGoal);
    if (goalState.hidden !== (words === null)) goalState.hidden = words === null;
    setText(goalWordsElement, words?.text ?? '');
    const isTold = status !== null && words === ofGoal;
    const distance = isTold ? distanceWords(status, this.#metres(status)) : '';
    setText(goalDistance, distance);
    const tone = words?.tone ?? 'neutral';
    if (goalState.dataset.tone !== tone) goalState.dataset.tone = tone;
    const place = aimed === null ? (this.#drawn?.place ?? status?.place ?? null) : aimed.place;
    stage.goal.show(place, tone, this.ground);
    this.headset?.say(place, words && { text: words.text + distance, tone }, this.ground);
  }

  /** Sends the robot there. */
  go(place: GoalPlace): void {
    this.#parts.client.goals.go(place, performance.now());
  }

  tellNoFloor(): void {
    this.#parts.state.notices.tell('There is no floor there', 'warning');
  }

  /** Takes back the goal that the robot has. */
  takeBack(): void {
    this.#parts.client.goals.cancel('asked');
  }

  #shown(nowMs: number): GoalStatus | null {
    const { goals, phase } = this.#parts.client;
    if (goals.status === null || phase === 'none') return null;
    return goals.active || nowMs - this.#endedMs < SHOWN_MS ? goals.status : null;
  }

  /** Height of the robot's ground, m. */
  get ground(): number {
    return this.#parts.client.telemetry?.pose.position.z ?? 0;
  }

  #metres({ place }: GoalStatus): number | null {
    const pose = this.#parts.client.telemetry?.pose;
    return pose === undefined ? null : Math.hypot(place.x - pose.position.x, place.y - pose.position.y);
  }

  #floorUnder(event: PointerEvent): GoalPlace | null {
    const { viewCamera: camera, world } = this.#parts.stage;
    const { left, top, width, height } = elements.stage.getBoundingClientRect();
    const right = ((event.clientX - left) / width) * 2 - 1;
    const up = 1 - ((event.clientY - top) / height) * 2;
    return floorUnder({ camera, world }, right, up, this.ground);
  }

  #onDown(event: PointerEvent): void {
    if (!this.armed.peek() || event.button !== 0) return;
    event.stopImmediatePropagation();
    const place = this.#floorUnder(event);
    if (place === null) {
      this.tellNoFloor();
      return;
    }
    elements.stage.setPointerCapture(event.pointerId);
    this.#drawn = { pointer: event.pointerId, place };
  }

  #onMove(event: PointerEvent): void {
    const drawn = this.#drawn;
    if (drawn?.pointer !== event.pointerId) return;
    event.stopImmediatePropagation();
    const { x, y } = drawn.place;
    const towards = this.#floorUnder(event);
    const isDrag = towards !== null && Math.hypot(towards.x - x, towards.y - y) >= LEAST_DRAG_M;
    const place = isDrag ? { x, y, yaw: Math.atan2(towards.y - y, towards.x - x) } : { x, y };
    this.#drawn = { ...drawn, place };
  }

  #onUp(event: PointerEvent): void {
    const drawn = this.#drawn;
    if (drawn?.pointer !== event.pointerId) return;
    event.stopImmediatePropagation();
    this.armed.value = false;
    this.go(drawn.place);
  }
}

/** Told once at each change, also to those who hear the page. */
function setText(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}
