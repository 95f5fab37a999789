#!/usr/bin/env node
/** `farpoint-issuer`: issues grants to people who sign in at an OpenID Connect provider. */
import { runProgram } from '@farpoint/service';
import { startIssuer } from './issuer.ts';
import { program } from './options.ts';

await runProgram(program, async ({ options, where, log, health, metrics, shutdown, serveAdmin }) => {
  const { adminHost, adminPort, adminNames } = options;
  const issuer = await startIssuer(options, { log, health, metrics, where });
  shutdown.onClose('issuer', () => issuer.close());
  await serveAdmin({ host: adminHost, port: adminPort, names: adminNames });
});
