import type { PulledMetrics } from '@farpoint/service';
import { monotonicMs } from '../../ground/clock.ts';
import type { GuardedSensorReport } from '../../motion/obstacles/guard-report.ts';
import type { ReturnStation } from '../../motion/return/return-station.ts';
import type { MeasuredRobot } from './measured-robot.ts';

/** Metrics of commands and the guard's verdicts. */
export function addDriveMetrics(metrics: PulledMetrics, robot: MeasuredRobot): void {
  const { counters } = robot;
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
    robot.parts.sink.fault == null ? 1 : 0,
  );
  metrics.sums('robot_stops', 'Stops by a stop at the robot itself, by its kind', 'stop', () =>
    robot.stops.stopped.entries(),
  );
  metrics.gauge('robot_stops_well', '1 while every stop at the robot can be read, otherwise 0', () =>
    robot.stops.areWell ? 1 : 0,
  );
  metrics.sums('thread_restarts', 'Restarts of threads that had ended or hung, by thread', 'thread', () => [
    ['velocities', robot.parts.sink.restarts ?? 0],
    ['guard-topics', robot.parts.obstacles.report(monotonicMs()).restarts],
    ['pictures', robot.streams.cameras.pictures?.counters.restarts ?? 0],
  ]);
  const { returns } = robot.driving;
  if (returns !== null) addReturnMetrics(metrics, returns);
}

/** Metrics of the obstacle guard: what it sees, how old that is, and what it costs. */
export function addGuardMetrics(metrics: PulledMetrics, { obstacles }: MeasuredRobot['parts']): void {
  const report = () => obstacles.report(monotonicMs());
  const bySensor = (read: (sensor: GuardedSensorReport) => number) => () =>
    report().sensors.map((sensor): [string, number] => [sensor.name, read(sensor)]);
  metrics.gauges('guard_state', 'The obstacle guard: 1 for its state (on, blind, off)', 'state', () => [
    [report().state, 1],
  ]);
  metrics.gauges(
    'guard_sensor_age_seconds',
    'Age of the newest cloud or scan that the obstacle guard has, by sensor',
    'sensor',
    bySensor(({ ageMs }) => ageMs / 1000),
  );
  metrics.gauges(
    'guard_sensor_live',
    '1 while a sensor gives the obstacle guard clouds or scans, otherwise 0',
    'sensor',
    bySensor(({ silent }) => (silent ? 0 : 1)),
  );
  metrics.gauges(
    'guard_grid_seconds',
    'Time that the obstacle guard took for the last cloud or scan, by sensor',
    'sensor',
    bySensor(({ lastMs }) => lastMs / 1000),
  );
  metrics.gauge(
    'guard_odometry_age_seconds',
    'Age of the odometry that the obstacle guard has',
    () => report().odometryAgeMs / 1000,
  );
  metrics.gauges(
    'guard_bound',
    '1 for why the obstacle guard’s newest answer was less than the wish',
    'reason',
    () => {
      const { reason } = report();
      return reason === null ? [] : [[reason, 1]];
    },
  );
  addGuardTopicMetrics(metrics, { obstacles });
}

/** Metrics of the topics that the obstacle guard hears. None if it hears none. */
function addGuardTopicMetrics(
  metrics: PulledMetrics,
  { obstacles }: Pick<MeasuredRobot['parts'], 'obstacles'>,
): void {
  const report = () => obstacles.report(monotonicMs());
  if (obstacles.topics?.collision == null) return;
  metrics.gauges(
    'collision_topic',
    '1 for what the collision topic says: free, bounded or silent',
    'state',
    () => [[report().collision ?? 'silent', 1]],
  );
}

/** Metrics of a robot that drives back by itself. */
function addReturnMetrics(metrics: PulledMetrics, returns: ReturnStation): void {
  const { drive } = returns;
  metrics.gauge('return_active', '1 while the robot says that it drives back, or does, otherwise 0', () =>
    drive.isActive ? 1 : 0,
  );
  metrics.sums('return_ended', 'Ends of the robot’s driving back, by reason', 'reason', () =>
    returns.ends.entries(),
  );
  metrics.sum('return_metres', 'Metres that the robot has driven back by itself', () => returns.metres);
}
