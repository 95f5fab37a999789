/** Other vendors' DDS programs for the tests and the benchmark, if they can be run. */
import { type ChildProcess, spawn, spawnSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, renameSync } from 'node:fs';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import * as z from 'zod';

const SOURCES = join(import.meta.dirname, '..', '..', 'testing', 'peers');
const REPOSITORY = join(import.meta.dirname, '..', '..', '..', '..');
const BUILT = join(REPOSITORY, '.farpoint', 'dds-peers');

export type PeerKind = 'Fast DDS' | 'Python';

export interface PeerOptions {
  domain: number;
  /**
   * DDS topic on which it publishes clouds of `side` × `side` points, `hz` per second, each frame in a single colour of
   * its own.
   */
  cloud?: string;
  side?: number;
  hz?: number;
  reliability?: 'reliable' | 'best-effort';
  /** DDS topic on which it receives Twists and reports each, and the one on which it sends each back at once. */
  twist?: string;
  echo?: string;
  /** Fast DDS only: a different type name for its clouds. */
  type?: string;
  /** Fast DDS only: DDS topic and type of what {@link Peer.send} sends. */
  raw?: string;
  rawType?: string;
  /** Fast DDS only: DDS topic and type of what it counts in {@link Peer.heard}. */
  heard?: string;
  heardType?: string;
}

const event = z.discriminatedUnion('event', [
  z.object({ event: z.literal('ready') }),
  z.object({ event: z.literal('bad') }),
  z.object({ event: z.literal('heard') }),
  /** Its raw messages have a subscriber. */
  z.object({ event: z.literal('matched') }),
  /** All that it has sent so far has been acknowledged. */
  z.object({ event: z.literal('acknowledged') }),
  /** @param ms CLOCK_MONOTONIC */
  z.object({ event: z.literal('twist'), x: z.number(), z: z.number(), ms: z.number() }),
]);
export type PeerEvent = z.infer<typeof event>;
export type HeardTwist = Extract<PeerEvent, { event: 'twist' }>;

/** The command of a peer, compiled if necessary; `null` if it cannot be run here. */
export function findPeer(kind: PeerKind): string[] | null {
  return kind === 'Fast DDS' ? findFastDds() : findPython();
}

/** How to install a peer, shown when tests that need it are skipped. */
export const PEER_REMEDY: Record<PeerKind, string> = {
  'Fast DDS': 'apt-get install libfastrtps-dev g++',
  Python: 'pip install cyclonedds',
};

export class Peer {
  readonly pid: number;
  readonly twists: HeardTwist[] = [];
  heard = 0;
  /** Whether what {@link send} sends has a subscriber. */
  matched = false;
  onTwist: ((twist: HeardTwist) => void) | null = null;
  readonly #waiting: (() => void)[] = [];
  readonly #child: ChildProcess;
  readonly #ended: Promise<void>;

  /** Resolves once it has joined the domain. */
  static async start(command: readonly string[], options: PeerOptions): Promise<Peer> {
    const [program, ...first] = command as [string, ...string[]];
    const flagOf = (name: string) => `--${name.replace('Type', '-type')}`;
    const args = Object.entries(options).flatMap(([name, value]) => [flagOf(name), String(value)]);
    const child = spawn(program, [...first, ...args], { stdio: ['pipe', 'pipe', 'inherit'] });
    const peer = new Peer(child);
    await peer.#ready;
    return peer;
  }

  readonly #ready: Promise<void>;

  private constructor(child: ChildProcess) {
    this.#child = child;
    this.pid = child.pid as number;
    this.#ended = new Promise((resolve) => child.once('exit', () => resolve()));
    // Input sent after it was killed is discarded.
    child.stdin?.on('error', () => undefined);
    this.#ready = new Promise((resolve, reject) => {
      child.once('error', reject);
      child.once('exit', (code) => reject(new Error(`the peer ended (${code})`)));
      createInterface({ input: child.stdout as NodeJS.ReadableStream }).on('line', (line) => {
        const told = event.parse(JSON.parse(line));
        if (told.event === 'ready') resolve();
        if (told.event === 'matched') this.matched = true;
        if (told.event === 'heard') this.heard++;
        if (told.event === 'acknowledged') this.#waiting.shift()?.();
        if (told.event !== 'twist') return;
        this.twists.push(told);
        this.onTwist?.(told);
      });
    });
    // It may end before anyone waits for it.
    this.#ready.catch(() => undefined);
  }

  /** Sends bytes unchanged, including their header. */
  send(bytes: Uint8Array): void {
    this.#child.stdin?.write(`${Buffer.from(bytes).toString('hex')}\n`);
  }

  /** Resolves once all subscribers have acknowledged what it has sent. */
  acknowledged(): Promise<void> {
    const told = new Promise<void>((resolve) => this.#waiting.push(resolve));
    this.#child.stdin?.write('\n');
    return told;
  }

  /** Lets it exit by itself, leaving the domain properly. */
  async stop(): Promise<void> {
    this.#child.stdin?.end();
    await this.#ended;
  }

  async kill(): Promise<void> {
    this.#child.kill('SIGKILL');
    await this.#ended;
  }
}

function findPython(): string[] | null {
  const candidates = [
    process.env.FARPOINT_DDS_PYTHON,
    join(REPOSITORY, '.farpoint', 'python-dds', 'bin', 'python3'),
    'python3',
  ];
  const found = candidates.find(
    (python): python is string =>
      python !== undefined && spawnSync(python, ['-c', 'import cyclonedds.domain']).status === 0,
  );
  return found === undefined ? null : [found, join(SOURCES, 'python_peer.py')];
}

function findFastDds(): string[] | null {
  const source = join(SOURCES, 'fastdds_peer.cpp');
  const version = createHash('sha256').update(readFileSync(source)).digest('hex').slice(0, 16);
  const program = join(BUILT, `fastdds_peer-${version}`);
  if (existsSync(program)) return [program];
  mkdirSync(BUILT, { recursive: true });
  const made = `${program}.${process.pid}`;
  const { status } = spawnSync('g++', [
    ...['-std=c++17', '-O2', source, '-o', made],
    ...['-lfastrtps', '-lfastcdr', '-lpthread'],
  ]);
  if (status !== 0) return null;
  renameSync(made, program);
  return [program];
}
