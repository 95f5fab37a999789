import type { ActionPort, ActionResult, CommandActor, CommandOrder } from './command-actor.ts';
import type { SimAction } from './command-configuration.ts';

const TESTS = ['the motors', 'the brakes', 'the camera', 'the battery'] as const;
/** How long each part of the self-test takes, ms. Chosen: long enough to watch and to cancel; sim-actor.test.ts holds it. */
const TEST_MS = 1500;

/** The simulated robot’s own lights, horn and self-test. They exist in what it says of them only. */
export class SimActor implements CommandActor {
  #lit = false;
  #timer: NodeJS.Timeout | undefined;

  begin({ action }: CommandOrder, port: ActionPort): (() => void) | null {
    if (action.kind !== 'sim') return null;
    if (action.action === 'self-test') return this.#test(port);
    port.end(this.#do(action.action));
    return null;
  }

  async close(): Promise<void> {
    clearTimeout(this.#timer);
  }

  #do(action: Exclude<SimAction, 'self-test'>): ActionResult {
    if (action === 'horn') return { state: 'done', detail: 'the horn has sounded' };
    this.#lit = !this.#lit;
    return { state: 'done', detail: this.#lit ? 'the lights are on' : 'the lights are off' };
  }

  #test(port: ActionPort): () => void {
    const next = (at: number) => {
      const part = TESTS[at];
      if (part === undefined) {
        port.end({ state: 'done', detail: 'everything works' });
        return;
      }
      port.progress(at / TESTS.length, `tests ${part}`);
      this.#timer = setTimeout(() => next(at + 1), TEST_MS);
    };
    next(0);
    return () => {
      clearTimeout(this.#timer);
      port.end({ state: 'cancelled', detail: '' });
    };
  }
}
