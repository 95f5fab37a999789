#!/usr/bin/env node
/** `pnpm conformance signaling|robot|bridge …`: runs a suite against any implementation. */
import { parseArgs } from 'node:util';
import { knownDefects } from './known-defects.ts';
import { bridgeSuite } from './suites/bridge-suite.ts';
import { robotSuite } from './suites/robot-suite.ts';
import { signalingSuite } from './suites/signaling-suite.ts';
import { type CaseResult, LEVELS, type Level, type Outcome, runSuite } from './suites/suite.ts';

const USAGE = `pnpm conformance signaling [--robot URL] [--client URL]
pnpm conformance robot --name NAME [--client URL]
pnpm conformance bridge [--robot URL] [--client URL] [--control URL] [--telemetry URL] [--streaming URL]

Runs the suite against a running implementation. By default the URLs are those of the reference system on this machine: robot
port ws://127.0.0.1:3001, client port :3002, the bridge's sockets :8085, :8090, :8095. initBridge tells a bridge the client
port. During the bridge suite, no robots but the suite's own may be registered.

--level strict (default) requires everything that the protocol needs. --level reference requires what the released programs do:
their faults are listed as known defects, and cases that would end one of them are not tried. --json prints the results as JSON.
Exit status: 1 if a case fails, 2 for invalid arguments.`;

function readArguments() {
  return parseArgs({
    allowPositionals: true,
    options: {
      robot: { type: 'string', default: 'ws://127.0.0.1:3001' },
      client: { type: 'string', default: 'ws://127.0.0.1:3002' },
      control: { type: 'string', default: 'ws://127.0.0.1:8085' },
      telemetry: { type: 'string', default: 'ws://127.0.0.1:8090' },
      streaming: { type: 'string', default: 'ws://127.0.0.1:8095' },
      name: { type: 'string', default: 'Robot' },
      level: { type: 'string', default: 'strict' },
      json: { type: 'boolean' },
      help: { type: 'boolean', short: 'h' },
    },
  });
}

/** Prints the usage and ends the program if the arguments are invalid. */
function orUsage<T>(read: () => T): T {
  try {
    return read();
  } catch (error) {
    console.error(`${error instanceof Error ? error.message : error}\n\n${USAGE}`);
    return process.exit(2);
  }
}

const { values, positionals } = orUsage(readArguments);

const level = orUsage(() => {
  const found = LEVELS.find((known) => known === values.level);
  if (found === undefined) throw new Error(`--level ${values.level}: must be one of ${LEVELS.join(', ')}`);
  return found;
});

const MARKS: Record<Outcome, string> = { passed: '✓', failed: '✗', 'known-defect': '!', 'not-tried': '–' };

function report({ name, outcome, fault, defect }: CaseResult): void {
  console.error(`  ${MARKS[outcome]} ${name}`);
  if (defect !== null) console.error(`      known defect ${defect}: ${knownDefects[defect]}`);
  if (fault !== null && outcome !== 'not-tried') console.error(`      ${fault}`);
}

async function run(suite: string | undefined, at: Level): Promise<CaseResult[] | null> {
  const { robot, client, control, telemetry, streaming, name } = values;
  switch (suite) {
    case 'signaling':
      return runSuite(signalingSuite, { robot, client }, at, report);
    case 'robot':
      return runSuite(robotSuite, { client, name }, at, report);
    case 'bridge':
      return runSuite(bridgeSuite, { robot, client, control, telemetry, streaming }, at, report);
    default:
      return null;
  }
}

const results = values.help ? null : await run(positionals[0], level);
if (results === null) {
  console.log(USAGE);
  process.exit(values.help ? 0 : 2);
}
const count = (outcome: Outcome) => results.filter((result) => result.outcome === outcome).length;
const defects = count('known-defect') + count('not-tried');
console.error(
  `${count('passed')} passed, ${count('failed')} failed${defects === 0 ? '' : `, ${defects} known defects`} at level ${level}`,
);
if (values.json) console.log(JSON.stringify(results));
process.exit(count('failed') === 0 ? 0 : 1);
