#!/usr/bin/env node
import { runProgram } from '@farpoint/service';
import { program } from './options.ts';
import { startSignaling } from './server.ts';

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
