import type { CommandBar } from '@farpoint/protocol';
import { type Access, mayDrive, supervises } from '../../admit/access/access.ts';
import type { CommandOptions } from './command-configuration.ts';

/** What decides, besides an operator's role, whether it may give a command now. */
export interface CommandStanding {
  /** It holds the lease. */
  drives: boolean;
  /** The emergency stop is latched. */
  estop: boolean;
  /** The robot moves. */
  moves: boolean;
}

type Rules = Pick<CommandOptions, 'who' | 'standing' | 'onStop'>;

/** @returns why the operator may neither give nor cancel the command; `null` if it may */
export function whoBarOf({ who }: Pick<Rules, 'who'>, access: Access, drives: boolean): CommandBar | null {
  if (who === 'watch') return null;
  if (who === 'supervise') return supervises(access) ? null : 'not-permitted';
  if (!mayDrive(access)) return 'not-permitted';
  return who === 'driver' && !drives ? 'not-driver' : null;
}

/** @returns why the operator may not give the command now; `null` if it may */
export function barOf(
  rules: Rules,
  access: Access,
  { drives, estop, moves }: CommandStanding,
): CommandBar | null {
  const bar = whoBarOf(rules, access, drives);
  if (bar !== null) return bar;
  if (estop && rules.onStop === 'cancel') return 'estop';
  return moves && rules.standing ? 'moving' : null;
}
