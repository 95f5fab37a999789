/** A small program for program.stack.test.ts. */
import * as schema from './option-schemas.ts';
import { defineOption, defineProgram } from './option-table.ts';
import { adminOptions, runProgram } from './program.ts';

const definition = defineProgram({
  name: 'farpoint-robot',
  summary: 'A fixture.',
  version: '0.0.0',
  section: 'robot',
  options: {
    ...adminOptions(0),
    fail: defineOption({ schema: schema.boolean(), default: false, help: 'fail once up' }),
  },
});

await runProgram(definition, async ({ options, log, shutdown, serveAdmin }) => {
  shutdown.onClose('fixture', () => log.info('closed the fixture'));
  await serveAdmin({ host: options.adminHost, port: options.adminPort, names: options.adminNames });
  log.info('up');
  if (options.fail) void Promise.reject(new Error('on purpose'));
});
