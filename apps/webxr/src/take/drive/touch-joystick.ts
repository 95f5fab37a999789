/** The on-screen joystick. A finger on it is the dead-man grip. */

import type { DriveInput, DriveWish } from '@farpoint/operator';
import { shapeAxis } from './dead-zone.ts';
import { EventReading } from './event-reading.ts';

const RESPONSE = { deadZone: 0.08, expo: 0.4 };

export class TouchJoystick implements DriveInput {
  readonly name = 'touch';
  readonly wish: DriveWish = { forward: 0, left: 0 };
  held = false;
  readonly #reading = new EventReading();
  readonly #base: HTMLElement;
  readonly #knob: HTMLElement;
  readonly #onChange: () => void;
  #pointer: number | null = null;

  constructor(base: HTMLElement, knob: HTMLElement, onChange: () => void) {
    this.#base = base;
    this.#knob = knob;
    this.#onChange = onChange;
    base.addEventListener('pointerdown', (event) => {
      if (this.#pointer !== null) return;
      this.#pointer = event.pointerId;
      base.setPointerCapture(event.pointerId);
      this.#reading.told(performance.now());
      this.held = true;
      this.#move(event);
    });
    base.addEventListener('pointermove', (event) => this.#move(event));
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
      base.addEventListener(end, (event) => {
        if (event.pointerId !== this.#pointer) return;
        this.#reading.told(performance.now());
        this.release();
      });
    }
  }

  /** A finger stays down between events for as long as the page runs: call this regularly while it does. */
  runs(nowMs: number): void {
    this.#reading.runs(nowMs);
  }

  get readMs(): number {
    return this.#reading.readMs;
  }

  release(): void {
    if (this.#pointer === null && !this.held) return;
    this.#pointer = null;
    this.held = false;
    this.wish.forward = 0;
    this.wish.left = 0;
    this.#knob.style.transform = '';
    this.#base.classList.remove('held');
    this.#onChange();
  }

  #move(event: PointerEvent): void {
    if (event.pointerId !== this.#pointer) return;
    const box = this.#base.getBoundingClientRect();
    const radius = box.width / 2;
    let x = (event.clientX - box.left - radius) / radius;
    let y = (event.clientY - box.top - radius) / radius;
    const length = Math.hypot(x, y);
    if (length > 1) {
      x /= length;
      y /= length;
    }
    this.#knob.style.transform = `translate(${x * radius * 0.7}px, ${y * radius * 0.7}px)`;
    this.#base.classList.add('held');
    this.wish.forward = -shapeAxis(y, RESPONSE) + 0;
    this.wish.left = -shapeAxis(x, RESPONSE) + 0;
    this.#onChange();
  }
}
