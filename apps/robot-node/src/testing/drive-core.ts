/** What a robot in virtual time is made of: all that decides whether it moves, without sockets, threads and sensors. */
import { noAudit } from '@farpoint/audit';
import { resolveOptions, silentLogger } from '@farpoint/service';
import type { OperatorRoster } from '../admit/access/operator-roster.ts';
import { RobotAccess } from '../admit/access/robot-access.ts';
import { RobotAudit } from '../admit/audit/robot-audit.ts';
import { ReasonCounts } from '../ground/robot-counters.ts';
import { toRobotOptions } from '../program/options/robot-options.ts';
import { robotProgram } from '../program/options/robot-program.ts';
import type { RobotOptions } from '../program/robot-configuration.ts';

export type { Access } from '../admit/access/access.ts';
export { OperatorRoster } from '../admit/access/operator-roster.ts';
export { DriveCore, type DriveCoreParts } from '../drive-core.ts';
export { monotonicMs } from '../ground/clock.ts';
export { RobotCounters } from '../ground/robot-counters.ts';
export type { VelocitySink } from '../ground/velocity-sink.ts';
export { openObstacleGuard } from '../motion/obstacles/obstacle-station.ts';
export { stands } from '../motion/standing.ts';
export type { RobotOptions } from '../program/robot-configuration.ts';
export { isUnintended, type PeerEnd } from '../send/transport/peer-events.ts';
export { RealTimeBase } from '../sense/base/real-time-base.ts';
export { Wheels } from '../sense/base/wheels.ts';
export { CommandDesk } from '../serve/commands/command-desk.ts';
export { openCommands } from '../serve/commands/open-commands.ts';
export { People } from '../serve/people/people.ts';
export { OperatorMessages, type SessionHost } from '../serve/session/operator-messages.ts';
export type { KeptOperator } from '../serve/session/path-keeper.ts';
export { RestartPolicy } from '../serve/session/restart-policy.ts';
export { ResumeKey } from '../serve/session/resume-key.ts';
export type { HostedOperator } from '../serve/session/robot-session-host.ts';
export type { SessionRecording } from '../tell/session-recording.ts';

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
export function accessWithoutKeys(robot: string, nowMs: () => number, roster: OperatorRoster): RobotAccess {
  return new RobotAccess({
    files: {
      keys: { keys: new Map(), reload: async () => undefined },
      journal: { start: { revoked: [], blocked: [] }, write: () => undefined },
      revocations: [],
    },
    ...{ robot, refusals: new ReasonCounts(), revocationLists: new ReasonCounts(), log: silentLogger() },
    ...{ nowS: () => Date.now() / 1000, now: nowMs, roster },
  });
}
