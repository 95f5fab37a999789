#!/usr/bin/env node
/** `pnpm conformance signaling|robot|bridge …`: runs a suite against any implementation. */
import { parseArgs } from 'node:util';
import { knownDefects } from './known-defects.ts';
import { bridgeSuite } from './suites/bridge-suite.ts';
import { robotSuite } from './suites/robot-suite.ts';
import { signalingSuite } from './suites/signaling-suite.ts';
import {
  type CaseResult,
  isLeftOver,
  LEVELS,
  type Level,
  type Outcome,
  runSuite,
  whyUnfinished,
} from './suites/suite.ts';

const USAGE = `pnpm conformance signaling [--robot URL] [--client URL]
pnpm conformance robot --name NAME [--client URL]
pnpm conformance bridge [--robot URL] [--client URL] [--control URL] [--telemetry URL] [--streaming URL]

Runs the suite against a running implementation. By default the URLs are those of the reference system on this machine: robot
port ws://127.0.0.1:3001, client port :3002, the bridge's sockets :8085, :8090, :8095. initBridge tells a bridge the client
port. During the bridge suite, no robots but the suite's own may be registered.

--level strict (default) requires everything that the protocol needs. --level reference requires what the released programs do:
their faults are listed as known defects, and cases that would end one of them are not tried. --json prints the results as JSON.
Exit status: 1 if a case fails, 2 for invalid arguments, 3 if an address cannot be reached, or no longer.`;

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

const addresses = orUsage(() => {
  const { robot, client, control, telemetry, streaming } = values;
  const all = { robot, client, control, telemetry, streaming };
  for (const [option, url] of Object.entries(all)) {
    if (!URL.canParse(url) || !/^wss?:\/\/[^/]/i.test(url))
      throw new Error(`--${option} ${url}: must be an address that begins with ws:// or wss://`);
  }
  return all;
});

const MARKS: Record<Outcome, string> = { passed: '✓', failed: '✗', 'known-defect': '!', 'not-tried': '–' };

function onResult(result: CaseResult): void {
  const { name, outcome, fault, defect } = result;
  // One sentence at the end says why.
  if (isLeftOver(result)) return;
  console.error(`  ${MARKS[outcome]} ${name}`);
  if (defect !== null) console.error(`      known defect ${defect}: ${knownDefects[defect]}`);
  if (fault !== null && outcome !== 'not-tried') console.error(`      ${fault}`);
}

async function run(suite: string | undefined, at: Level): Promise<CaseResult[] | null> {
  const { robot, client } = addresses;
  switch (suite) {
    case 'signaling':
      return runSuite(signalingSuite, { robot, client }, at, { onResult, addresses: { robot, client } });
    case 'robot':
      return runSuite(robotSuite, { client, name: values.name }, at, { onResult, addresses: { client } });
    case 'bridge': {
      const { control, telemetry, streaming } = addresses;
      // The bridge is told the client port as it reaches it, which need not be how this machine does.
      const ours = { robot, control, telemetry, streaming };
      return runSuite(bridgeSuite, addresses, at, { onResult, addresses: ours });
    }
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
const leftOver = results.filter(isLeftOver).length;
const defects = count('known-defect') + count('not-tried') - leftOver;
if (leftOver < results.length) {
  const parts = [`${count('passed')} passed`, `${count('failed')} failed`];
  if (defects > 0) parts.push(`${defects} known defects`);
  if (leftOver > 0) parts.push(`${leftOver} not tried`);
  console.error(`${parts.join(', ')} at level ${level}`);
}
const unfinished = whyUnfinished(results);
if (unfinished !== null) console.error(unfinished);
if (values.json) console.log(JSON.stringify(results));
process.exit(unfinished !== null ? 3 : count('failed') === 0 ? 0 : 1);
