/** A process that writes an audit log until it is killed: `writing-process.ts FILE`. Prints a line once it writes. */
import { AuditLog } from '../audit-log.ts';

const [, , path = ''] = process.argv;
let clockMs = 0;
const log = await AuditLog.open({
  ...{ path, maxBytes: 20_000, robot: 'r1', nowMs: Date.now },
  // Nothing is left out.
  clockMs: () => (clockMs += 1e6),
  onFault: (error) => {
    if (error !== null) throw error;
  },
  onDamage: () => undefined,
});
log.record({ kind: 'started' });
console.log('writes');
setInterval(() => log.record({ kind: 'estop-latched', details: { text: 'x'.repeat(500) } }), 0);
