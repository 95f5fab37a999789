/** What `/healthz` says of the robot. A robot is healthy if it can drive safely, whoever is connected. */
import type { Health } from '@farpoint/service';
import { monotonicMs } from '../ground/clock.ts';
import { guardHealth } from '../motion/obstacles/guard-report.ts';
import type { MeasuredRobot } from './metrics/measured-robot.ts';

export function addRobotHealth(health: Health, robot: MeasuredRobot): void {
  const { stops, driving } = robot;
  const { sink, obstacles, recording } = robot.parts;
  const { returns } = driving;
  // Connected operators go on without signaling, so its loss is not a failure of the robot.
  health.add('signaling', () => ({ ok: true, detail: { registered: robot.signaling.registered } }));
  health.add('wheels', () => ({
    ok: sink.fault == null,
    detail: { sink: sink.kind, ...(sink.fault == null ? {} : { fault: sink.fault }) },
  }));
  health.add('guard', () => guardHealth(obstacles.report(monotonicMs())));
  if (stops.states.size > 0)
    health.add('stops', () => ({ ok: stops.areWell, detail: Object.fromEntries(stops.states) }));
  if (returns !== null)
    health.add('return', () => {
      const { phase, end, trackM } = returns.drive;
      const track = Math.round(trackM * 10) / 10;
      return { ok: true, detail: { phase, trackM: track, ...(end === null ? {} : { end }) } };
    });
  health.add('operators', () => ({ ok: true, detail: { connected: robot.operators.size } }));
  // A robot drives without viewers.
  if (recording?.live != null)
    health.add('foxglove', () => ({
      ok: true,
      detail: { listening: recording.live?.listening, viewers: recording.live?.report?.clients ?? 0 },
    }));
}
