import type { PulledMetrics } from '@farpoint/service';
import type { CommandStation } from '../../robot-commands/command-station.ts';

/** Metrics of a robot that takes commands. */
export function addCommandMetrics(metrics: PulledMetrics, commands: CommandStation): void {
  metrics.sums('command_calls', 'Robot commands that were begun, by id', 'command', () =>
    commands.begun.entries(),
  );
  metrics.sums(
    'command_outcomes',
    'What became of robot commands, by outcome or why they were refused',
    'outcome',
    () => commands.outcomes.entries(),
  );
}
