#!/usr/bin/env node
/** `farpoint-signaling`: runs the service; `grant` issues grants. */
import { runProgram } from '@farpoint/service';
import { grantCommand } from './grant/grant-command.ts';
import { program } from './options.ts';
import { startSignaling } from './server.ts';

if (process.argv[2] === 'grant') {
  const rim = { stdout: process.stdout, stderr: process.stderr, now: Date.now };
  process.exitCode = await grantCommand(process.argv.slice(3), rim);
} else {
  await serve();
}

async function serve(): Promise<void> {
  await runProgram(program, async ({ options, log, health, metrics, shutdown }) => {
    const signaling = await startSignaling(options, { log, health, metrics });
    shutdown.onClose('signaling', () => signaling.close());
    process.on('SIGHUP', () => {
      try {
        signaling.reload();
      } catch (error) {
        log.error({ err: error }, 'could not reload certificate and tokens: the old ones stay in force');
      }
    });
  });
}
