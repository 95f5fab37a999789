import type { DriveLimits } from '@farpoint/protocol';
import type { CommandGateOptions } from './command-gate.ts';
import type { EstopReleasePolicy } from './estop-release.ts';
import type { LeaseOptions } from './lease.ts';

export interface DriveGuardOptions extends LeaseOptions, CommandGateOptions {
  limits: DriveLimits;
  /** Who may release what an operator has latched; default `driver`. */
  estopRelease?: EstopReleasePolicy | undefined;
}
