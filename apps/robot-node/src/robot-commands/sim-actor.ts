import type { ActionResult, CommandActor } from './command-actor.ts';
import type { CommandAction, SimAction } from './command-configuration.ts';

/** The simulated robot’s own lights, horn and faults. They exist in what it says of them only. */
export class SimActor implements CommandActor {
  #lit = false;

  act(action: CommandAction, _timeoutMs: number, onResult: (result: ActionResult) => void): void {
    if (action.kind === 'sim') onResult({ done: true, detail: this.#do(action.action) });
  }

  async close(): Promise<void> {}

  #do(action: SimAction): string {
    switch (action) {
      case 'lights':
        this.#lit = !this.#lit;
        return this.#lit ? 'the lights are on' : 'the lights are off';
      case 'horn':
        return 'the horn has sounded';
      case 'clear-faults':
        return 'there are no faults';
    }
  }
}
