import { AuditFileError, AuditLog, type JsonValue, noAudit } from '@farpoint/audit';
import { fileFault, type Logger, OptionsError } from '@farpoint/service';
import { monotonicMs } from '../../ground/clock.ts';
import { RobotAudit } from './robot-audit.ts';

export interface RobotAuditOptions {
  path: string;
  maxBytes: number;
  /** The robot's software. */
  version: string;
  /** Options that differ from their defaults, without secrets. */
  configuration: { readonly [key: string]: JsonValue };
}

/** The audit log and its end; without options, one that records nothing. */
export interface OpenRobotAudit {
  readonly audit: RobotAudit;
  /** Keys for grants were read again, or could not be. */
  reloaded(fault: string | null): void;
  close(): Promise<void>;
}

/**
 * Opens the audit log, and records the start and the configuration. A full disk does not keep the robot from starting.
 *
 * @param where how messages name the option
 * @throws {OptionsError} if the file cannot be opened
 */
export async function openRobotAudit(
  options: RobotAuditOptions | undefined,
  robot: string,
  { where, log }: { where: string; log: Logger },
): Promise<OpenRobotAudit> {
  if (options === undefined) {
    return { audit: new RobotAudit(noAudit), reloaded: () => undefined, close: () => Promise.resolve() };
  }
  const { path, maxBytes, version, configuration } = options;
  const audit = await AuditLog.open({
    path,
    maxBytes,
    robot,
    nowMs: Date.now,
    clockMs: monotonicMs,
    onFault: (error) => {
      if (error === null) log.info({ path }, 'the audit log is written again');
      else
        log.error(
          { err: error, path },
          'the audit log cannot be written: the robot goes on, and tries again',
        );
    },
    onDamage: (damage) => log.warn({ path, ...damage }, 'the audit log was not left in order'),
  }).catch((error: unknown) => {
    const fault = fileFault(error) ?? (error as Error).message;
    throw new OptionsError(where, error instanceof AuditFileError ? fault : `cannot be opened: ${fault}`);
  });
  audit.record({ kind: 'started', details: { version, configuration } });
  return {
    audit: new RobotAudit(audit),
    reloaded: (fault) => audit.record({ kind: 'reloaded', details: { what: 'grant keys', fault } }),
    close: () => {
      audit.record({ kind: 'stopped' });
      return audit.close();
    },
  };
}
