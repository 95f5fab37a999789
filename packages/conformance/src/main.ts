#!/usr/bin/env node
/** `pnpm conformance signaling|robot|bridge …`: runs a suite against an implementation, whoever wrote it. */
import { parseArgs } from 'node:util';
import { bridgeSuite } from './suites/bridge-suite.ts';
import { robotSuite } from './suites/robot-suite.ts';
import { signalingSuite } from './suites/signaling-suite.ts';
import { type CaseResult, runSuite } from './suites/suite.ts';

const USAGE = `pnpm conformance signaling [--robot URL] [--client URL]
pnpm conformance robot --name NAME [--client URL]
pnpm conformance bridge [--robot URL] [--control URL] [--telemetry URL] [--streaming URL]

Runs the suite against a running implementation. URLs are those of the reference system on this machine unless told otherwise:
robots' port ws://127.0.0.1:3001, clients' port :3002, the bridge's sockets :8085, :8090, :8095. For the bridge no robot must be
registered but those that the suite brings. --json prints the results as JSON. Exit status 1 where a case fails.`;

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    robot: { type: 'string', default: 'ws://127.0.0.1:3001' },
    client: { type: 'string', default: 'ws://127.0.0.1:3002' },
    control: { type: 'string', default: 'ws://127.0.0.1:8085' },
    telemetry: { type: 'string', default: 'ws://127.0.0.1:8090' },
    streaming: { type: 'string', default: 'ws://127.0.0.1:8095' },
    name: { type: 'string', default: 'Robot' },
    json: { type: 'boolean' },
    help: { type: 'boolean', short: 'h' },
  },
});

function report({ name, fault }: CaseResult): void {
  console.error(fault === null ? `  ✓ ${name}` : `  ✗ ${name}\n      ${fault}`);
}

async function run(suite: string | undefined): Promise<CaseResult[] | null> {
  const { robot, client, control, telemetry, streaming, name } = values;
  switch (suite) {
    case 'signaling':
      return runSuite(signalingSuite, { robot, client }, report);
    case 'robot':
      return runSuite(robotSuite, { client, name }, report);
    case 'bridge':
      return runSuite(bridgeSuite, { robot, control, telemetry, streaming }, report);
    default:
      return null;
  }
}

const results = values.help ? null : await run(positionals[0]);
if (results === null) {
  console.log(USAGE);
  process.exit(values.help ? 0 : 2);
}
const failed = results.filter(({ fault }) => fault !== null).length;
console.error(`${results.length - failed} passed, ${failed} failed`);
if (values.json) console.log(JSON.stringify(results));
process.exit(failed === 0 ? 0 : 1);
