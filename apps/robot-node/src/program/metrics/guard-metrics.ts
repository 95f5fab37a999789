import type { PulledMetrics } from '@farpoint/service';
import { monotonicMs } from '../../ground/clock.ts';
import type { GuardedSensorReport } from '../../motion/obstacles/guard-report.ts';
import type { MeasuredRobot } from './measured-robot.ts';

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
