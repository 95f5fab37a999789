import type { Logger } from '@farpoint/service';
import { monotonicMs } from '../clock.ts';
import type { CommandActor } from './command-actor.ts';
import type { CommandsConfiguration, PublishAction } from './command-configuration.ts';
import { CommandStation } from './command-station.ts';
import { RecordActor, type RecordControl } from './record-actor.ts';
import { RosActor } from './ros-actor.ts';
import { SimActor } from './sim-actor.ts';

/** @param recording `null` if nothing can be recorded @returns `null` if the robot takes no commands */
export function openCommands(
  configuration: CommandsConfiguration | undefined,
  recording: RecordControl | null,
  log: Logger,
): CommandStation | null {
  if (configuration === undefined) return null;
  const { commands, graph } = configuration;
  const publishes = commands
    .map(({ action }) => action)
    .filter((action): action is PublishAction => action.kind === 'publish');
  const sim = new SimActor();
  const ros: CommandActor | null = graph === null ? null : new RosActor({ graph, publishes }, log);
  const actors = { sim, record: new RecordActor(recording), publish: ros ?? sim, call: ros ?? sim };
  return new CommandStation(commands, ({ action }) => actors[action.kind], monotonicMs);
}
