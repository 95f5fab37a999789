/** What each hand holds: a controller, or nothing that has buttons. */
import { type Signal, signal } from '@preact/signals-core';
import type { Group, WebGLRenderer } from 'three';
import type { Hand } from '../../ground/headset-settings.ts';

export class HandsHeld {
  /** The space of the grip; `null` while the hand is bare, or not there. */
  readonly left: Signal<Group | null> = signal(null);
  readonly right: Signal<Group | null> = signal(null);

  /** @param rig carries the tracked space */
  constructor(renderer: WebGLRenderer, rig: Group) {
    for (const index of [0, 1]) {
      const grip = renderer.xr.getControllerGrip(index);
      rig.add(grip);
      grip.addEventListener('connected', ({ data: { handedness, hand } }) => {
        if (handedness !== 'none' && hand == null) this[handedness].value = grip;
      });
      grip.addEventListener('disconnected', () => {
        for (const held of [this.left, this.right]) if (held.peek() === grip) held.value = null;
      });
    }
  }

  of(hand: Hand): Group | null {
    return this[hand].value;
  }
}
