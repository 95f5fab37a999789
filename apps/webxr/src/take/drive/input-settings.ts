/** What an operator has chosen about keys, devices and speed, as the page follows it. */
import { effect, type Signal, signal } from '@preact/signals-core';
import { type ControllerMap, EMPTY_MAP, STANDARD_MAP } from './controller-map.ts';
import { type InputChoices, isStandardKey } from './input-choices.ts';
import { KEY_PRESETS, type KeyMap, type KeyPreset } from './key-map.ts';
import { SpeedChoice } from './speed-choice.ts';

export class InputSettings {
  readonly keys: Signal<KeyMap>;
  readonly controllers: Signal<ReadonlyMap<string, ControllerMap>>;
  readonly speed: SpeedChoice;
  /** Whether the present robot goes sideways: roles for that exist only then. Nobody chooses it, and it is not kept. */
  readonly goesSideways = signal(false);

  /** @param keep keeps what is chosen for the next visit */
  constructor(choices: InputChoices, keep: (choices: InputChoices) => void) {
    this.keys = signal(choices.keys);
    this.controllers = signal(choices.controllers);
    this.speed = new SpeedChoice(choices.speed);
    let isFirst = true;
    effect(() => {
      const chosen = { keys: this.keys.value, controllers: this.controllers.value };
      const speed = this.speed.share.value;
      if (!isFirst) keep({ ...chosen, speed });
      isFirst = false;
    });
  }

  /** What a device does: what was set for it, or what is usual; the same object while nothing changes. @param key of `controllerKey` */
  mapOf(key: string): ControllerMap {
    return this.controllers.value.get(key) ?? (isStandardKey(key) ? STANDARD_MAP : EMPTY_MAP);
  }

  /** @param map what the device does from now on; `null`: what is usual */
  setController(key: string, map: ControllerMap | null): void {
    const controllers = new Map(this.controllers.peek());
    controllers.delete(key);
    if (map !== null) controllers.set(key, map);
    this.controllers.value = controllers;
  }

  /** Whether a device does nothing until somebody has set it up. */
  isUnknown(key: string): boolean {
    return !isStandardKey(key) && !this.controllers.value.has(key);
  }

  /** All keys are those of the preset. */
  usePreset(preset: KeyPreset): void {
    this.keys.value = KEY_PRESETS[preset];
  }
}
