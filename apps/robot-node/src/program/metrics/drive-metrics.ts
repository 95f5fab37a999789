import type { PulledMetrics } from '@farpoint/service';
import { monotonicMs } from '../../ground/clock.ts';
import type { GuardedSensorReport } from '../../motion/obstacles/guard-report.ts';
import type { ReturnStation } from '../../motion/return/return-station.ts';
import type { MeasuredRobot } from './measured-robot.ts';

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

/** Metrics of the obstacle guard: what it sees, how old that is, and what it costs. */
export function addGuardMetrics(
  metrics: PulledMetrics,
  { obstacles }: Pick<MeasuredRobot, 'obstacles'>,
): void {
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
  metrics.sums(
    'guard_grids',
    'Clouds and scans that the obstacle guard has judged, by sensor',
    'sensor',
    bySensor(({ grids }) => grids),
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
  addGuardTopicMetrics(metrics, obstacles);
}

/** Metrics of the topics that the obstacle guard hears. None if it hears none. */
function addGuardTopicMetrics(metrics: PulledMetrics, obstacles: MeasuredRobot['obstacles']): void {
  const report = () => obstacles.report(monotonicMs());
  if (obstacles.topics === null) return;
  metrics.sum(
    'guard_topics_restarts',
    'Restarts of the thread that hears the obstacle guard’s topics',
    () => report().restarts,
  );
  if (obstacles.topics.collision === null) return;
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
  metrics.gauge('return_track_metres', 'Length of the way back that the robot knows', () => drive.trackM);
  metrics.sum('return_begun', 'Times that the robot has begun to drive back', () => returns.begun);
  metrics.sums('return_ended', 'Ends of the robot’s driving back, by reason', 'reason', () =>
    returns.ends.entries(),
  );
  metrics.sum('return_metres', 'Metres that the robot has driven back by itself', () => returns.metres);
}
