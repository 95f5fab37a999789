import type { Logger } from '@farpoint/service';
import type { GraphOptions } from '../../ground/ros/open-graph.ts';
import { KeptThread } from '../../ground/threads/kept-thread.ts';
import type { ActionPort, CommandActor, CommandOrder } from './command-actor.ts';
import type { CommandOptions, GraphAction } from './command-configuration.ts';
import type { RosWorkerReport, RosWorkerRequest, RosWorkerSetup } from './ros-messages.ts';

const PROGRAM = new URL('./ros-worker.ts', import.meta.url);

const isOfGraph = (action: CommandOptions['action']): action is GraphAction =>
  action.kind === 'publish' || action.kind === 'call' || action.kind === 'goal';

export function openRosActor(
  graph: GraphOptions,
  commands: readonly CommandOptions[],
  log: Pick<Logger, 'warn'>,
): CommandActor {
  const actions = commands.map(({ action }) => action).filter(isOfGraph);
  return new RosActor({ graph, actions }, log);
}

/** Topics, services and action servers of the robot’s ROS graph. */
class RosActor implements CommandActor {
  readonly #thread: KeptThread<RosWorkerReport>;
  readonly #open = new Map<number, ActionPort>();
  #number = 0;

  constructor(setup: RosWorkerSetup, log: Pick<Logger, 'warn'>) {
    const closeMessage: RosWorkerRequest = { type: 'close' };
    const warn = (detail: string) => log.warn({ detail }, 'the commands’ ROS graph has a fault');
    this.#thread = new KeptThread<RosWorkerReport>({
      program: PROGRAM,
      name: 'commands',
      closeMessage,
      data: () => setup,
      onReport: (report) => {
        if (report.type === 'fault') warn(report.detail);
        else this.#take(report);
      },
      onError: warn,
      onEnd: () => this.#failAll(),
    });
    this.#thread.start();
  }

  begin({ action, timeoutMs }: CommandOrder, port: ActionPort): (() => void) | null {
    if (!isOfGraph(action)) return null;
    const number = ++this.#number;
    this.#open.set(number, port);
    this.#post({ type: 'begin', number, action, timeoutMs });
    return action.kind === 'goal' ? () => this.#post({ type: 'cancel', number }) : null;
  }

  close(): Promise<void> {
    return this.#thread.close();
  }

  #take(report: Exclude<RosWorkerReport, { type: 'fault' }>): void {
    this.#thread.isWell();
    const port = this.#open.get(report.number);
    if (report.type === 'progress') port?.progress(null, report.detail);
    else {
      this.#open.delete(report.number);
      port?.end(report.result);
    }
  }

  /** Nobody hears any more what becomes of them. */
  #failAll(): void {
    const ports = [...this.#open.values()];
    this.#open.clear();
    for (const port of ports) port.end({ state: 'failed', detail: 'the link to the ROS graph was lost' });
  }

  #post(request: RosWorkerRequest): void {
    this.#thread.post(request);
  }
}
