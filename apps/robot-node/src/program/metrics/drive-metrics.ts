import type { PulledMetrics } from '@farpoint/service';
import type { MeasuredRobot } from './measured-robot.ts';
import { addReturnMetrics } from './return-metrics.ts';

/** Metrics of commands and the guard's verdicts. */
export function addDriveMetrics(metrics: PulledMetrics, robot: MeasuredRobot): void {
  const { counters, base } = robot;
  metrics.sum('commands_accepted', 'Drive commands accepted', () => counters.commandsAccepted);
  metrics.sums('commands_rejected', 'Drive commands refused, by reason', 'reason', () =>
    counters.commandsRejected.entries(),
  );
  metrics.sums(
    'interventions',
    'Times that something began to bound the robot’s motion, by reason',
    'reason',
    () => counters.interventions.entries(),
  );
  metrics.gauge('wheels_present', '1 while something takes the velocities, otherwise 0', () =>
    robot.sink.fault == null ? 1 : 0,
  );
  metrics.sums('robot_stops', 'Stops by a stop at the robot itself, by its kind', 'stop', () =>
    robot.stops.stopped.entries(),
  );
  metrics.gauge('robot_stops_well', '1 while every stop at the robot can be read, otherwise 0', () =>
    robot.stops.areWell ? 1 : 0,
  );
  const { returns } = robot.driving;
  if (returns !== null) addReturnMetrics(metrics, returns);
  metrics.sum(
    'sink_restarts',
    'Restarts of the thread that publishes velocities',
    () => robot.sink.restarts ?? 0,
  );
  metrics.sum(
    'watchdog_thread_stops',
    'Stops by the simulated base’s own watchdog',
    () => base?.watchdogStops ?? 0,
  );
}
