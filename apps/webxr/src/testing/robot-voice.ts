import type { RobotClient, RobotEvents } from '@farpoint/operator';

/** Stands in for what a client tells: a test says it. */
export class RobotVoice {
  readonly #listeners: [keyof RobotEvents, (event: never) => void][] = [];

  readonly on: RobotClient['on'] = (type, listener) => {
    this.#listeners.push([type, listener]);
    return () => undefined;
  };

  say<Type extends keyof RobotEvents>(type: Type, event: RobotEvents[Type]): void {
    for (const [heard, listener] of this.#listeners) if (heard === type) listener(event as never);
  }
}
