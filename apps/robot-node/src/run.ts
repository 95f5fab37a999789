import { type ProgramContext, runProgram, setNicenessIfPermitted } from '@farpoint/service';
import { Notifier, notifyOrder } from '@farpoint/systemd';
import { type OpenRobotAudit, openRobotAudit } from './admit/audit/open-robot-audit.ts';
import { registerRobotMetrics } from './program/metrics/robot-metrics.ts';
import { toRobotOptions } from './program/options/robot-options.ts';
import { robotProgram } from './program/options/robot-program.ts';
import { waitMsOf } from './program/options/to-sensors.ts';
import { addRobotHealth } from './program/robot-health.ts';
import { lockRun } from './program/run-locks.ts';
import { warnOfFleetingState } from './program/state-place.ts';
import { Robot } from './robot.ts';

/**
 * The capture thread reports every 20 ms, unless a frame takes longer; then the program ends, ms. Chosen: no
 * frame takes seconds, and a service manager's restart costs the session.
 */
const MOST_CAPTURE_SILENCE_MS = 5000;
/**
 * Time that the start may take in addition to the wait for a producer or a topic, ms. Chosen: a cold start on
 * a small board takes some seconds.
 */
const START_MS = 30_000;

type Context = ProgramContext<typeof robotProgram.options>;

/** Runs the robot until it receives a signal. */
export async function run(): Promise<void> {
  await runProgram(robotProgram, async (context) => {
    const { options, where, log, health, metrics, shutdown } = context;
    setNicenessIfPermitted(context.options.niceness, context.log);
    const order = notifyOrder(process.env, process.pid);
    const systemd = order === null ? null : new Notifier(order);
    systemd?.starting(waitMsOf(options) + START_MS);
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
    onHangUp(context, robot, robotOptions.grantKeys === undefined ? null : audit);
    registerRobotMetrics(metrics, robot);
    addRobotHealth(health, robot);
    await context.serveAdmin({
      host: options.adminHost,
      port: options.adminPort,
      names: options.adminNames,
    });
    // If this thread or the capture thread hangs, the watchdog is not fed, and systemd restarts the robot.
    systemd?.ready(
      () => robot.captureSilenceMs < MOST_CAPTURE_SILENCE_MS,
      () =>
        `${robot.operators.size} operators; ${robot.signaling.registered ? 'registered' : 'not registered'}`,
    );
  });
}

/** SIGHUP reads the keys for grants again, or ends a robot that asks for no grants. @param audit `null`: for no grants */
function onHangUp({ log, shutdown }: Context, robot: Robot, audit: OpenRobotAudit | null): void {
  if (audit === null) {
    process.on('SIGHUP', () => shutdown.handleSignal('SIGHUP'));
    return;
  }
  const failed = (error: unknown) => {
    log.error({ err: error }, 'could not read the keys for grants again: the old ones stay in force');
    audit.reloaded(String(error));
  };
  process.on('SIGHUP', () => {
    robot.sessions.reloadGrants().then(() => audit.reloaded(null), failed);
  });
}
