/** What a robot in virtual time is made of: all that decides whether it moves, without sockets, threads and sensors. */
import { noAudit } from '@farpoint/audit';
import { resolveOptions, silentLogger } from '@farpoint/service';
import { RobotAccess } from '../access/robot-access.ts';
import { RobotAudit } from '../audit/robot-audit.ts';
import { toRobotOptions } from '../options/robot-options.ts';
import { robotProgram } from '../options/robot-program.ts';
import type { RobotOptions } from '../robot-configuration.ts';
import { ReasonCounts } from '../telemetry/robot-counters.ts';

export type { Access } from '../access/access.ts';
export { RealTimeBase } from '../base/real-time-base.ts';
export { Wheels } from '../base/wheels.ts';
export { monotonicMs } from '../clock.ts';
export type { VelocitySink } from '../drive/velocity-sink.ts';
export { DriveCore, type DriveCoreParts } from '../drive-core.ts';
export { openObstacleGuard } from '../obstacles/obstacle-station.ts';
export type { RobotOptions } from '../robot-configuration.ts';
export { OperatorMessages, type SessionHost } from '../session/operator-messages.ts';
export type { KeptOperator } from '../session/path-keeper.ts';
export { RestartPolicy } from '../session/restart-policy.ts';
export { ResumeKey } from '../session/resume-key.ts';
export type { HostedOperator } from '../session/robot-session-host.ts';
export { RobotCounters } from '../telemetry/robot-counters.ts';
export type { SessionRecording } from '../telemetry/session-recording.ts';
export type { PeerEnd } from '../transport/peer-events.ts';
export { isUnintended } from '../transport/peer-events.ts';

/** What the robot's program makes of its command line, without any file or variable: the limits that ship. */
export function shippedOptions(args: readonly string[]): RobotOptions {
  const key = args.join('\n');
  const known = parsed.get(key);
  if (known !== undefined) return known;
  const resolved = resolveOptions(robotProgram, { argv: [...args], env: {}, readFile: () => null });
  if (resolved.action !== 'run') throw new Error(`${args.join(' ')}: does not run`);
  const options = toRobotOptions(resolved.values, resolved.where);
  parsed.set(key, options);
  return options;
}

const parsed = new Map<string, RobotOptions>();

/** An audit log that nobody reads. */
export function unreadAudit(): RobotAudit {
  return new RobotAudit(noAudit);
}

/** What ends the sessions of admitted operators. It verifies nobody: a test says what each may do. */
export function accessWithoutKeys(robot: string, nowMs: () => number): RobotAccess {
  return new RobotAccess({
    files: {
      keys: { keys: new Map(), reload: async () => undefined },
      journal: { start: { revoked: [], blocked: [] }, write: () => undefined },
      revocations: [],
    },
    ...{ robot, refusals: new ReasonCounts(), revocationLists: new ReasonCounts(), log: silentLogger() },
    ...{ nowS: () => Date.now() / 1000, now: nowMs },
  });
}
