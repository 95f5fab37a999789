/** What each hand holds: a controller with the buttons of the console, one without, or nothing. */
import { type Signal, signal } from '@preact/signals-core';
import type { Group, WebGLRenderer } from 'three';
import type { Hand } from '../headset-settings.ts';

/** Of the upper button on the stick's side, in WebXR's `xr-standard` mapping. */
const UPPER_BUTTON = 5;

export interface HeldController {
  /** The space of its grip. */
  readonly grip: Group;
  /** Whether it has the buttons for STOP and the menu. */
  readonly hasButtons: boolean;
}

export class HandsHeld {
  /** `null` while the hand is bare, or not there. */
  readonly left: Signal<HeldController | null> = signal(null);
  readonly right: Signal<HeldController | null> = signal(null);

  /** @param rig carries the tracked space */
  constructor(renderer: WebGLRenderer, rig: Group) {
    for (const index of [0, 1]) {
      const grip = renderer.xr.getControllerGrip(index);
      rig.add(grip);
      grip.addEventListener('connected', ({ data }) => this.#onConnected(grip, data));
      grip.addEventListener('disconnected', () => {
        for (const hand of [this.left, this.right]) if (hand.peek()?.grip === grip) hand.value = null;
      });
    }
  }

  of(hand: Hand): HeldController | null {
    return this[hand].value;
  }

  #onConnected(grip: Group, { handedness, hand, gamepad }: XRInputSource): void {
    if (handedness === 'none' || hand != null) return;
    this[handedness].value = { grip, hasButtons: (gamepad?.buttons.length ?? 0) > UPPER_BUTTON };
  }
}
