import { freePorts } from './free-port.ts';
import { ManagedProcess } from './managed-process.ts';
import { type LocalStack, repositoryRoot } from './stack.ts';

export interface EmulatedLinkSpec {
  /** Flags of the link program, for example `['--rate-mbps', '20', '--rtt-ms', '40']`. */
  args: string[];
  /** Where it writes what happens in each 100 ms, one JSON object per line. */
  statsFile?: string;
  env?: Record<string, string>;
  onLine?: (name: string, line: string) => void;
}

/**
 * A bad network in front of a stack's signaling: all packets of a peer that connects to {@link signalingUrl} are routed
 * through it.
 */
export class EmulatedLink {
  readonly signalingUrl: string;
  readonly #start: () => Promise<ManagedProcess>;
  #process: ManagedProcess;

  private constructor(started: ManagedProcess, signalingUrl: string, start: () => Promise<ManagedProcess>) {
    this.#process = started;
    this.signalingUrl = signalingUrl;
    this.#start = start;
  }

  get process(): ManagedProcess {
    return this.#process;
  }

  /** @throws {Error} with the program's last lines if it does not start */
  static async start(stack: LocalStack, spec: EmulatedLinkSpec): Promise<EmulatedLink> {
    const [port, adminPort] = (await freePorts(2)) as [number, number];
    const start = () =>
      ManagedProcess.start({
        name: 'link',
        command: [
          'node',
          'apps/link-emulator/src/main.ts',
          '--signaling',
          stack.signalingUrl,
          '--port',
          String(port),
          '--admin-port',
          String(adminPort),
          ...(spec.statsFile === undefined ? [] : ['--stats', spec.statsFile]),
          ...spec.args,
        ],
        cwd: repositoryRoot,
        env: spec.env,
        readyUrl: `http://127.0.0.1:${adminPort}/healthz`,
        onLine: spec.onLine,
        ipc: true,
      });
    return new EmulatedLink(await start(), `ws://127.0.0.1:${port}`, start);
  }

  /** Changes the link while it runs: a message of apps/link-emulator/src/control.ts. */
  tell(message: object): void {
    this.process.send(message);
  }

  /** Makes every address behind it disappear at once, for good; its signaling returns at the same address. */
  async renumber(): Promise<void> {
    await this.#process.kill();
    this.#process = await this.#start();
  }

  async stop(): Promise<void> {
    await this.#process.stop();
  }
}
