/** Two machines, simulated by network namespaces: which participants find each other, and how. */
import { type ChildProcess, spawn, spawnSync } from 'node:child_process';
import { join } from 'node:path';
import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';
import { isAvailable } from './addon.ts';
import type { DdsOptions } from './configuration.ts';
import { ADDON_SUITE, testDomain } from './testing/helpers.ts';

const NODE = join(import.meta.dirname, 'testing', 'network-node.ts');
const names = ['a', 'b'].map((side) => `fpdds${process.pid}${side}`) as [string, string];
const addresses = ['10.78.0.1', '10.78.0.2'] as const;
/** The namespaces belong to this test, so no other domain is present. */
const domain = String(testDomain());

const ip = (...args: string[]) => spawnSync('ip', args).status === 0;

/** Connects two namespaces with a virtual cable; returns whether that succeeded. */
function connect(): boolean {
  const [a, b] = names;
  return (
    names.every((name) => ip('netns', 'add', name)) &&
    ip('-n', a, 'link', 'add', 'eth0', 'type', 'veth', 'peer', 'name', 'eth0', 'netns', b) &&
    names.every(
      (name, i) =>
        ip('-n', name, 'address', 'add', `${addresses[i]}/24`, 'dev', 'eth0') &&
        ip('-n', name, 'link', 'set', 'eth0', 'up') &&
        ip('-n', name, 'link', 'set', 'lo', 'up'),
    )
  );
}

function disconnect(): void {
  for (const name of names) ip('netns', 'delete', name);
}

const possible = isAvailable() && connect();
if (!possible) disconnect();

describe(`two machines (needs root, iproute2; ${ADDON_SUITE.note})`, { skip: !possible }, () => {
  let publishing: ChildProcess | null = null;
  beforeAll(() => {
    // Multicast needs a route.
    for (const name of names) ip('-n', name, 'route', 'add', 'default', 'dev', 'eth0');
  });
  afterEach(() => publishing?.kill('SIGKILL'));
  afterAll(disconnect);

  /** How the subscriber ended: 0 if it received, 3 if it did not. */
  async function hear(theirs: DdsOptions, ours: DdsOptions, ms: number, uri = ''): Promise<number | null> {
    const start = (name: string, role: string, options: DdsOptions) =>
      spawn(
        'ip',
        [
          ...['netns', 'exec', name, process.execPath, NODE],
          role,
          domain,
          String(ms),
          JSON.stringify(options),
        ],
        { env: { PATH: process.env.PATH, CYCLONEDDS_URI: uri } },
      );
    publishing = start(names[0], 'publish', theirs);
    const hearing = start(names[1], 'hear', ours);
    return new Promise((resolve) => hearing.once('exit', resolve));
  }

  const NO_MULTICAST =
    '<CycloneDDS><Domain Id="any"><General><AllowMulticast>false</AllowMulticast></General></Domain></CycloneDDS>';
  const LONG_MS = 20_000;
  const SHORT_MS = 2000;

  it.each([
    ['by multicast, without configuration', {}, {}, '', LONG_MS, 0],
    [
      'with the interface by name and by address',
      { interface: 'eth0' },
      { interface: addresses[1] },
      '',
      LONG_MS,
      0,
    ],
    [
      'as peers, without multicast',
      { peers: [addresses[1]] },
      { peers: [addresses[0]] },
      NO_MULTICAST,
      LONG_MS,
      0,
    ],
    ['not without either', {}, {}, NO_MULTICAST, SHORT_MS, 3],
    ['not where one keeps to itself', {}, { localhostOnly: true }, '', SHORT_MS, 3],
  ] as const)('find each other %s', { timeout: 2 * LONG_MS }, async (_, theirs, ours, uri, ms, outcome) => {
    expect(await hear({ ...theirs } as DdsOptions, { ...ours } as DdsOptions, ms, uri)).toBe(outcome);
  });
});
