import { publicValues } from '@farpoint/service';
import type { RobotAuditOptions } from '../../admit/audit/open-robot-audit.ts';
import { type RobotOptionValues, robotProgram } from './robot-program.ts';

/** @returns undefined if nothing is recorded */
export function toAudit(values: RobotOptionValues): RobotAuditOptions | undefined {
  if (values.auditLog === null) return undefined;
  const { options, version } = robotProgram;
  const configuration = publicValues(options, values);
  return { path: values.auditLog, maxBytes: values.auditMax, version, configuration };
}
