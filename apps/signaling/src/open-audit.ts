import { type Audit, AuditFileError, AuditLog, noAudit } from '@farpoint/audit';
import { fileFault, type Logger, OptionsError, publicValues } from '@farpoint/service';
import { program, type SignalingOptions } from './options.ts';

/** The audit log and its end; without the option, one that records nothing. */
export interface OpenAudit {
  readonly audit: Audit;
  close(): Promise<void>;
}

/**
 * Opens the audit log, and records the start and the configuration. A full disk does not keep the service from
 * starting.
 *
 * @throws {OptionsError} if the file cannot be opened
 */
export async function openAudit(options: SignalingOptions, log: Logger): Promise<OpenAudit> {
  const { auditLog: path, auditMax: maxBytes } = options;
  if (path === null) return { audit: noAudit, close: () => Promise.resolve() };
  const audit = await AuditLog.open({
    path,
    maxBytes,
    nowMs: Date.now,
    clockMs: () => performance.now(),
    onFault: (error) => {
      if (error === null) log.info({ path }, 'the audit log is written again');
      else
        log.error(
          { err: error, path },
          'the audit log cannot be written: the service goes on, and tries again',
        );
    },
    onDamage: (damage) => log.warn({ path, ...damage }, 'the audit log was not left in order'),
  }).catch((error: unknown) => {
    const fault = fileFault(error) ?? (error as Error).message;
    throw new OptionsError(
      '--audit-log',
      error instanceof AuditFileError ? fault : `cannot be opened: ${fault}`,
    );
  });
  const configuration = publicValues(program.options, options);
  audit.record({ kind: 'started', details: { version: program.version, configuration } });
  return {
    audit,
    close: () => {
      audit.record({ kind: 'stopped' });
      return audit.close();
    },
  };
}
