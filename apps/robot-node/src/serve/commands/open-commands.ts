import type { Logger } from '@farpoint/service';
import type { RecordControl } from '../../tell/record-control.ts';
import type { CommandActor } from './command-actor.ts';
import type { CommandOptions, CommandsConfiguration } from './command-configuration.ts';
import { RecordActor } from './record-actor.ts';
import { openRosActor } from './ros-actor.ts';
import { SimActor } from './sim-actor.ts';

/** The commands that operators may give, and what does them. */
export interface RobotCommands {
  readonly commands: readonly CommandOptions[];
  readonly actorOf: (command: CommandOptions) => CommandActor;
  /** `null`: nothing is recorded, and nothing can be. */
  readonly recording: RecordControl | null;
}

/** @param configuration undefined: operators may give none @param recording `null` if nothing can be recorded */
export function openCommands(
  configuration: CommandsConfiguration | undefined,
  recording: RecordControl | null,
  log: Logger,
): RobotCommands {
  const { commands, graph } = configuration ?? { commands: [], graph: null };
  const sim = new SimActor();
  const ros = graph === null ? sim : openRosActor(graph, commands, log);
  const actors = { sim, record: new RecordActor(recording), publish: ros, call: ros, goal: ros };
  return { commands, actorOf: ({ action }) => actors[action.kind], recording };
}
