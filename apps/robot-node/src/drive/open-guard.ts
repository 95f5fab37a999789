import { randomBytes } from 'node:crypto';
import type { AfterGap, DriveLimits } from '@farpoint/protocol';
import { DriveGuard, type EstopReleasePolicy, type TakePolicy } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import type { RobotAudit } from '../audit/robot-audit.ts';
import { EstopJournal } from './estop-journal.ts';

export interface GuardOptions {
  id: string;
  limits: DriveLimits;
  takePolicy: TakePolicy;
  estopRelease: EstopReleasePolicy;
  afterGap: AfterGap;
  /** Where the robot remembers its emergency stop across restarts. */
  stateFolder: string;
}

/**
 * Creates the drive guard, latched if the emergency stop outlives the last run, and the journal that preserves it for
 * the next run.
 */
export function openGuard(
  { id, limits, takePolicy, estopRelease, afterGap, stateFolder }: GuardOptions,
  log: Logger,
  audit: RobotAudit,
): { guard: DriveGuard; estop: EstopJournal } {
  const guard = new DriveGuard({
    ...{ limits, takePolicy, estopRelease, randomBytes: (count) => randomBytes(count) },
    // Any gap that lets the watchdog stop the robot.
    ...(afterGap === 'let-go' ? { letGoAfterMs: limits.watchdogMs } : {}),
  });
  const estop = new EstopJournal(stateFolder, id, (error) =>
    log.error({ err: error }, 'the emergency stop cannot be stored: the robot will start latched'),
  );
  const { latched } = estop.start;
  if (latched !== null) {
    guard.latchEstop(latched.by);
    audit.startsLatched(latched.reason);
    log.warn(
      { reason: latched.reason, detail: latched.detail },
      'starts with the emergency stop latched: whoever drives must release it',
    );
  }
  return { guard, estop };
}
