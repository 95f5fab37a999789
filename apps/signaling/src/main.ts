#!/usr/bin/env node
/** `farpoint-signaling`: runs the service; `grant` issues grants, `audit` verifies a log. */
import { auditCommand } from '@farpoint/audit';
import { runProgram } from '@farpoint/service';
import { grantCommand } from './grant/grant-command.ts';
import { openAudit } from './open-audit.ts';
import { program } from './options.ts';
import { startSignaling } from './server.ts';

if (process.argv[2] === 'grant') {
  const rim = { stdout: process.stdout, stderr: process.stderr, now: Date.now };
  process.exitCode = await grantCommand(process.argv.slice(3), rim);
} else if (process.argv[2] === 'audit') {
  process.exitCode = auditCommand('farpoint-signaling', process.argv.slice(3), process);
} else {
  await serve();
}

async function serve(): Promise<void> {
  await runProgram(program, async ({ options, log, health, metrics, shutdown, serveAdmin }) => {
    const { audit, close } = await openAudit(options, log);
    // Last, so that the ends of all sessions are recorded.
    shutdown.onClose('audit log', close);
    const signaling = await startSignaling(options, { log, health, metrics, audit });
    shutdown.onClose('signaling', () => signaling.close());
    const { adminHost: host, adminPort: port, publicNames: names } = options;
    if (port !== null) await serveAdmin({ host, port, names });
    process.on('SIGHUP', () => {
      try {
        signaling.reload();
      } catch (error) {
        log.error({ err: error }, 'could not reload certificate and tokens: the old ones stay in force');
      }
    });
  });
}
