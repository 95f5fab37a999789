/** What an operator chooses about keys, controllers and speed, as signals: whoever drives follows at once. */
import { effect, type Signal, signal } from '@preact/signals-core';
import type { ControllerMap } from './controller-map.ts';
import { DEFAULT_CHOICES, type InputChoices, isStandardKey, mapOf } from './input-choices.ts';
import { type KeyMap, usableKeys } from './key-map.ts';
import { SpeedChoice } from './speed-choice.ts';

export class InputSettings {
  readonly keys: Signal<KeyMap>;
  readonly oneHanded: Signal<boolean>;
  readonly controllers: Signal<ReadonlyMap<string, ControllerMap>>;
  readonly speed: SpeedChoice;

  /** @param keep keeps what is chosen for the next visit */
  constructor(choices: InputChoices, keep: (choices: InputChoices) => void) {
    this.keys = signal(choices.keys);
    this.oneHanded = signal(choices.oneHanded);
    this.controllers = signal(choices.controllers);
    this.speed = new SpeedChoice(choices.speed);
    let isFirst = true;
    effect(() => {
      const { value: keys } = this.keys;
      const chosen = { keys, oneHanded: this.oneHanded.value, controllers: this.controllers.value };
      const speed = this.speed.share.value;
      if (!isFirst) keep({ ...chosen, speed });
      isFirst = false;
    });
  }

  /** What a controller does. @param key of `controllerKey` */
  mapOf(key: string): ControllerMap {
    return mapOf({ ...DEFAULT_CHOICES, controllers: this.controllers.value }, key);
  }

  /** @param map what the controller does from now on; `null`: what is usual */
  setController(key: string, map: ControllerMap | null): void {
    const controllers = new Map(this.controllers.peek());
    controllers.delete(key);
    if (map !== null) controllers.set(key, map);
    this.controllers.value = controllers;
  }

  /** Whether a controller does nothing until somebody has set it up. */
  isUnknown(key: string): boolean {
    return !isStandardKey(key) && !this.controllers.value.has(key);
  }

  /** All keys do what is usual. */
  resetKeys(): void {
    this.keys.value = usableKeys({});
    this.oneHanded.value = DEFAULT_CHOICES.oneHanded;
  }
}
