import type { CommandBar } from '@farpoint/protocol';
import type { CommandOptions } from './command-configuration.ts';

/** What decides whether an operator may give a command now. */
export interface CommandStanding {
  /** Its grant lets it drive. */
  mayDrive: boolean;
  /** It holds the lease. */
  drives: boolean;
  /** The emergency stop is latched. */
  estop: boolean;
}

/** @returns why the operator may not give the command; `null` if it may */
export function barOf(
  { holdsLease, whileStopped }: Pick<CommandOptions, 'holdsLease' | 'whileStopped'>,
  { mayDrive, drives, estop }: CommandStanding,
): CommandBar | null {
  if (!mayDrive) return 'not-permitted';
  if (holdsLease && !drives) return 'not-driver';
  return estop && !whileStopped ? 'estop' : null;
}
