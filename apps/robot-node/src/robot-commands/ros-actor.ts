import type { Logger } from '@farpoint/service';
import { KeptThread } from '../threads/kept-thread.ts';
import type { ActionResult, CommandActor } from './command-actor.ts';
import type { CommandAction } from './command-configuration.ts';
import type { CommandWorkerReport, CommandWorkerRequest, CommandWorkerSetup } from './command-messages.ts';

const PROGRAM = new URL('./command-worker.ts', import.meta.url);
const MOST_RETRY_MS = 10_000;

/** Topics and services of the robot’s ROS graph. */
export class RosActor implements CommandActor {
  readonly #thread: KeptThread<CommandWorkerReport>;
  readonly #waiting = new Map<number, (result: ActionResult) => void>();
  #number = 0;

  constructor(setup: CommandWorkerSetup, log: Pick<Logger, 'warn'>) {
    const closeMessage: CommandWorkerRequest = { type: 'close' };
    const warn = (detail: string) => log.warn({ detail }, 'the commands’ ROS graph has a fault');
    this.#thread = new KeptThread<CommandWorkerReport>({
      ...{ program: PROGRAM, name: 'commands', mostRetryMs: MOST_RETRY_MS, closeMessage },
      data: () => setup,
      onReport: (report) => {
        if (report.type === 'fault') warn(report.detail);
        else this.#take(report.number, report.result);
      },
      onError: warn,
      onEnd: () => this.#waiting.clear(),
    });
    this.#thread.start();
  }

  act(action: CommandAction, timeoutMs: number, onResult: (result: ActionResult) => void): void {
    if (action.kind === 'sim' || action.kind === 'record') return;
    const number = ++this.#number;
    this.#waiting.set(number, onResult);
    const request: CommandWorkerRequest = { type: 'act', number, action, timeoutMs };
    this.#thread.post(request);
  }

  close(): Promise<void> {
    return this.#thread.close();
  }

  #take(number: number, result: ActionResult): void {
    this.#thread.isWell();
    this.#waiting.get(number)?.(result);
    this.#waiting.delete(number);
  }
}
