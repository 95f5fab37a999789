import { runProgram, setNiceness } from '@farpoint/service';
import { Notifier, notifyOrder } from '@farpoint/systemd';
import { openRobotAudit } from './admit/audit/open-robot-audit.ts';
import { monotonicMs } from './ground/clock.ts';
import { guardHealth } from './motion/obstacles/guard-report.ts';
import { registerRobotMetrics } from './program/metrics/robot-metrics.ts';
import { toRobotOptions } from './program/options/robot-options.ts';
import { robotProgram } from './program/options/robot-program.ts';
import { lockRun } from './program/run-locks.ts';
import { warnOfFleetingState } from './program/state-place.ts';
import { Robot } from './robot.ts';

/** The capture thread reports every 20 ms, unless a frame takes longer. */
const MOST_CAPTURE_SILENCE_MS = 5000;
/** Time that the start may take in addition to the wait for a producer or a topic. */
const START_MS = 30_000;

/** Runs the robot until it receives a signal. */
export async function run(): Promise<void> {
  await runProgram(robotProgram, async ({ options, where, log, health, metrics, shutdown, serveAdmin }) => {
    try {
      setNiceness(options.niceness);
    } catch (error) {
      log.info(
        { niceness: options.niceness, reason: (error as Error).message },
        'the system keeps the priority',
      );
    }
    const order = notifyOrder(process.env, process.pid);
    const systemd = order === null ? null : new Notifier(order);
    systemd?.starting(Math.max(options.shmWaitS, options.rosWaitS) * 1000 + START_MS);
    const robotOptions = toRobotOptions(options, where);
    warnOfFleetingState(robotOptions, log);
    const locks = lockRun(robotOptions, log);
    // Last of all: until then, this robot writes.
    shutdown.onClose('locks', () => locks[Symbol.dispose]());
    const audit = await openRobotAudit(robotOptions.audit, robotOptions.id, {
      where: where('auditLog'),
      log,
    });
    // After the robot, so that what ends with it is recorded.
    shutdown.onClose('audit log', () => audit.close());
    const robot = await Robot.start(robotOptions, log, audit.audit).catch(async (error: unknown) => {
      throw (await import('./program/doctor/start-failure.ts')).startFailure(robotOptions, error);
    });
    // Before anything else is closed, however the run ends.
    shutdown.signal.addEventListener('abort', () => robot.drive.halt());
    shutdown.onClose('robot', () => robot.close(shutdown.isAsked));
    shutdown.onClose('systemd', () => systemd?.stopping());
    robot.onFailure = (error) => {
      log.fatal({ err: error }, 'the source failed');
      void shutdown.end('the source failed', 1);
    };
    if (robotOptions.grantKeys !== undefined) {
      process.on('SIGHUP', () => {
        const failed = (error: unknown) => {
          log.error({ err: error }, 'could not read the keys for grants again: the old ones stay in force');
          audit.reloaded(String(error));
        };
        robot.sessions.reloadGrants().then(() => audit.reloaded(null), failed);
      });
    } else process.on('SIGHUP', () => shutdown.handleSignal('SIGHUP'));
    registerRobotMetrics(metrics, robot);
    // Connected operators go on without signaling, so its loss is not a failure of the robot.
    health.add('signaling', () => ({ ok: true, detail: { registered: robot.signaling.registered } }));
    const { sink } = robot;
    health.add('wheels', () => ({
      ok: sink.fault == null,
      detail: { sink: sink.kind, ...(sink.fault == null ? {} : { fault: sink.fault }) },
    }));
    health.add('guard', () => guardHealth(robot.obstacles.report(monotonicMs())));
    if (robot.stops.states.size > 0)
      health.add('stops', () => ({
        ok: robot.stops.areWell,
        detail: Object.fromEntries(robot.stops.states),
      }));
    const { returns } = robot.driving;
    if (returns !== null)
      health.add('return', () => {
        const { phase, end, trackM } = returns.drive;
        const track = Math.round(trackM * 10) / 10;
        return { ok: true, detail: { phase, trackM: track, ...(end === null ? {} : { end }) } };
      });
    health.add('operators', () => ({ ok: true, detail: { connected: robot.operators.size } }));
    const { recording } = robot;
    // A robot drives without viewers.
    if (recording?.live != null)
      health.add('foxglove', () => ({
        ok: true,
        detail: { listening: recording.live?.listening, viewers: recording.live?.report?.clients ?? 0 },
      }));
    await serveAdmin({ host: options.adminHost, port: options.adminPort, names: options.adminNames });
    // If this thread or the capture thread hangs, the watchdog is not fed, and systemd restarts the robot.
    systemd?.ready(
      () => robot.captureSilenceMs < MOST_CAPTURE_SILENCE_MS,
      () =>
        `${robot.operators.size} operators; ${robot.signaling.registered ? 'registered' : 'not registered'}`,
    );
  });
}
