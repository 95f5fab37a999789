import { type ChildProcess, spawn } from 'node:child_process';
import { randomBytes } from 'node:crypto';
import {
  chmodSync,
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { findProgram } from './chromium.ts';
import { freePorts } from './free-port.ts';
import { type JanusConfigurationOptions, janusConfiguration } from './janus-configuration.ts';
import { reserveNumber } from './reserved-numbers.ts';

/** How to install it. */
export const JANUS_REMEDY = 'apt-get install janus';

/** What of Janus is loaded: nothing else of it can be reached. */
const STREAMING = 'libjanus_streaming.so';
const WEBSOCKETS = 'libjanus_websockets.so';
const READY_MS = 15_000;
const STOP_MS = 5000;
const KEPT_LINES = 100;

/** Ports of one Janus, of which the first {@link ROBOT_PORTS} are for the robots' packets; not those of `pnpm janus`. */
const MEDIA = { kind: 'janus-ports', first: 21_000, last: 23_600, step: 400 };
const ROBOT_PORTS = 100;

export interface JanusProgram {
  program: string;
  /** Has `plugins` and `transports`. */
  libraries: string;
}

export interface JanusServerOptions
  extends Partial<Omit<JanusConfigurationOptions, 'pluginsFolder' | 'transportsFolder'>> {
  /** Where the configuration is written; a temporary folder if absent. */
  folder?: string | undefined;
  /** If absent, as {@link viewerPorts}: ports of its own, that no other Janus of this machine gets meanwhile. */
  robotPorts?: readonly [number, number];
  viewerPorts?: readonly [number, number];
  onLine?: ((line: string) => void) | undefined;
}

type MediaPorts = Pick<JanusConfigurationOptions, 'robotPorts' | 'viewerPorts'>;

/** Janus cannot run here: one sentence with the remedy. */
export class JanusError extends Error {
  override readonly name = 'JanusError';
}

/** @returns `null` if Janus, its streaming plugin or its WebSocket transport is not installed */
export function findJanus(): JanusProgram | null {
  const program = findProgram(['janus'], ['/opt/janus/bin/janus', '/usr/local/bin/janus']);
  if (program === null) return null;
  const roots = ['/usr/lib', '/usr/local/lib', '/opt/janus/lib'];
  const places = roots.flatMap((root) => [
    join(root, 'janus'),
    ...foldersIn(root).map((name) => join(root, name, 'janus')),
  ]);
  const libraries = places.find(
    (place) =>
      existsSync(join(place, 'plugins', STREAMING)) && existsSync(join(place, 'transports', WEBSOCKETS)),
  );
  return libraries === undefined ? null : { program, libraries };
}

/** A real Janus with a configuration of its own, that never outlives this process. */
export class JanusServer {
  readonly host: string;
  readonly port: number;
  readonly adminKey: string;
  readonly folder: string;
  /** Settles when Janus ends by itself, with its last lines. */
  onEnd: ((output: string) => void) | null = null;
  readonly #janus: JanusProgram;
  readonly #temporary: boolean;
  readonly #encrypted: boolean;
  readonly #onLine: ((line: string) => void) | undefined;
  readonly #lines: string[] = [];
  #child: ChildProcess | null = null;

  private constructor(janus: JanusProgram, options: JanusServerOptions & MediaPorts, port: number) {
    this.#janus = janus;
    this.#temporary = options.folder === undefined;
    this.#onLine = options.onLine;
    this.#encrypted = (options.certificate ?? null) !== null;
    this.host = options.host ?? '127.0.0.1';
    this.port = port;
    this.adminKey = options.adminKey ?? randomBytes(16).toString('hex');
    this.folder = options.folder ?? mkdtempSync(join(tmpdir(), 'farpoint-janus-'));
    this.#configure(options);
  }

  /**
   * Writes the configuration and starts Janus.
   *
   * @throws {JanusError} if it is not installed, or does not answer
   */
  static async start(options: JanusServerOptions = {}): Promise<JanusServer> {
    const janus = findJanus();
    if (janus === null)
      throw new JanusError(`Janus with its streaming plugin is not installed; on Debian: ${JANUS_REMEDY}`);
    const [free = 0] = options.port === undefined ? await freePorts(1) : [];
    const server = new JanusServer(janus, { ...(await ownMediaPorts()), ...options }, options.port ?? free);
    await server.restart();
    return server;
  }

  /** For a client on this machine. */
  get url(): string {
    const host = this.host === '0.0.0.0' ? '127.0.0.1' : this.host;
    return `${this.#encrypted ? 'wss' : 'ws'}://${host}:${this.port}`;
  }

  get pid(): number {
    return this.#child?.pid ?? -1;
  }

  /** Starts it, after it was stopped or killed. @throws {JanusError} with its last lines if it does not answer */
  async restart(): Promise<void> {
    this.#lines.length = 0;
    const child = spawn(this.#janus.program, ['--configs-folder', this.folder, '--log-stdout'], {
      stdio: ['ignore', 'pipe', 'pipe'],
      // Out of the terminal's reach: Ctrl-C goes to this process, which then stops it.
      detached: true,
    });
    this.#child = child;
    process.once('exit', this.#kill);
    const ready = new Promise<boolean>((resolve) => {
      for (const stream of [child.stdout, child.stderr]) {
        createInterface({ input: stream }).on('line', (line) => {
          this.#lines.push(line);
          if (this.#lines.length > KEPT_LINES) this.#lines.shift();
          this.#onLine?.(line);
          if (line.includes('WebSockets thread started')) resolve(true);
        });
      }
      child.once('error', () => resolve(false));
      child.once('exit', () => {
        resolve(false);
        this.#onExit(child);
      });
      setTimeout(() => resolve(false), READY_MS).unref();
    });
    if (await ready) return;
    await this.kill();
    throw new JanusError(`Janus does not start\n${this.#lines.slice(-8).join('\n')}`);
  }

  /** Asks it to end, and kills it if it does not. Its configuration stays for a restart. */
  async halt(): Promise<void> {
    const child = this.#child;
    this.#child = null;
    if (child === null) return;
    process.off('exit', this.#kill);
    if (child.exitCode !== null || child.signalCode !== null) return;
    const gone = new Promise((resolve) => child.once('exit', resolve));
    child.kill('SIGTERM');
    const timer = setTimeout(() => child.kill('SIGKILL'), STOP_MS);
    await gone;
    clearTimeout(timer);
  }

  /** Ends it as a crash would. */
  async kill(): Promise<void> {
    this.#child?.kill('SIGKILL');
    await this.halt();
  }

  /** Ends it and removes what it was configured with, if that was in a temporary folder. */
  async stop(): Promise<void> {
    await this.halt();
    if (this.#temporary) rmSync(this.folder, { recursive: true, force: true });
  }

  #configure(options: JanusServerOptions & MediaPorts): void {
    const folders = {
      pluginsFolder: join(this.folder, 'plugins'),
      transportsFolder: join(this.folder, 'transports'),
    };
    const files = janusConfiguration({
      host: this.host,
      port: this.port,
      publicAddress: options.publicAddress ?? null,
      robotPorts: options.robotPorts,
      viewerPorts: options.viewerPorts,
      adminKey: this.adminKey,
      certificate: options.certificate ?? null,
      ...folders,
    });
    const links = [
      [folders.pluginsFolder, 'plugins', STREAMING],
      [folders.transportsFolder, 'transports', WEBSOCKETS],
    ] as const;
    for (const [folder, kind, name] of links) {
      mkdirSync(folder, { recursive: true });
      rmSync(join(folder, name), { force: true });
      symlinkSync(join(this.#janus.libraries, kind, name), join(folder, name));
    }
    for (const [name, text] of files) writeFileSync(join(this.folder, name), text, { mode: 0o600 });
    // It holds the admin key.
    chmodSync(this.folder, 0o700);
  }

  #onExit(child: ChildProcess): void {
    if (this.#child !== child) return;
    this.#child = null;
    process.off('exit', this.#kill);
    this.onEnd?.(this.#lines.slice(-8).join('\n'));
  }

  readonly #kill = (): void => {
    this.#child?.kill('SIGKILL');
  };
}

async function ownMediaPorts(): Promise<MediaPorts> {
  const first = await reserveNumber(MEDIA);
  const viewers = first + ROBOT_PORTS;
  return { robotPorts: [first, viewers - 1], viewerPorts: [viewers, first + MEDIA.step - 1] };
}

function foldersIn(root: string): string[] {
  try {
    return readdirSync(root);
  } catch {
    return [];
  }
}
