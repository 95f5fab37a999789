import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { freePorts } from './free-port.ts';
import { ManagedProcess } from './managed-process.ts';

export const repositoryRoot = fileURLToPath(new URL('../../..', import.meta.url));

/** Loopback TCP ports of one stack. */
export interface StackPorts {
  signaling: number;
  referenceRobot: number;
  referenceClient: number;
}

export interface RobotSpec {
  id: string;
  name: string;
  /** Also register it with the reference system's signaling. */
  reference?: boolean;
  /** More flags of the robot program, for example `['--source', 'pcd', '--path', file]`; a simulated robot if empty. */
  args?: string[];
  adminPort?: number;
  /** Whether the program reads what `robot(id).type` writes. */
  input?: boolean;
}

export interface StackSpec {
  ports?: StackPorts;
  /** More flags of the signaling program. */
  signalingArgs?: string[];
  /** Folder of the built web app; the signaling service serves it. */
  webRoot?: string;
  robots: RobotSpec[];
  env?: Record<string, string>;
  onLine?: (name: string, line: string) => void;
}

interface RunningRobot {
  spec: Required<RobotSpec>;
  process: ManagedProcess;
}

/** The real signaling service and robots as child processes on loopback. Any of them can be killed and restarted. */
export class LocalStack {
  readonly ports: StackPorts;
  readonly #spec: StackSpec;
  #signaling: ManagedProcess | null = null;
  readonly #robots = new Map<string, RunningRobot>();
  /** A restarted robot finds its own state; a robot of another stack does not. */
  readonly #stateFolder = mkdtempSync(join(tmpdir(), 'farpoint-state-'));

  private constructor(spec: StackSpec, ports: StackPorts) {
    this.#spec = spec;
    this.ports = ports;
    process.once('exit', this.#forget);
  }

  /** @throws {Error} naming the program that did not start, with its last lines; nothing is left running then */
  static async start(spec: StackSpec): Promise<LocalStack> {
    const [signaling, referenceRobot, referenceClient] = (await freePorts(3)) as [number, number, number];
    const stack = new LocalStack(spec, spec.ports ?? { signaling, referenceRobot, referenceClient });
    try {
      await stack.startSignaling();
      for (const robot of spec.robots) await stack.startRobot(robot);
    } catch (error) {
      await stack.stop();
      throw error;
    }
    return stack;
  }

  /** Where the web app is, if the service serves it. */
  get webUrl(): string {
    return `http://localhost:${this.ports.signaling}/`;
  }

  get signalingUrl(): string {
    return `ws://127.0.0.1:${this.ports.signaling}`;
  }

  get signaling(): ManagedProcess {
    if (this.#signaling === null) throw new Error('signaling is not running');
    return this.#signaling;
  }

  robot(id: string): ManagedProcess {
    return this.#robot(id).process;
  }

  /** Where a robot answers `/healthz` and `/metrics`. */
  robotAdminUrl(id: string): string {
    return `http://127.0.0.1:${this.#robot(id).spec.adminPort}`;
  }

  async startSignaling(): Promise<void> {
    const { signaling, referenceRobot, referenceClient } = this.ports;
    this.#signaling = await ManagedProcess.start({
      name: 'signaling',
      command: [
        'node',
        'apps/signaling/src/main.ts',
        '--host',
        '127.0.0.1',
        '--port',
        String(signaling),
        '--reference',
        '--reference-robot-port',
        String(referenceRobot),
        '--reference-client-port',
        String(referenceClient),
        ...(this.#spec.webRoot === undefined ? [] : ['--web-root', this.#spec.webRoot]),
        ...(this.#spec.signalingArgs ?? []),
      ],
      cwd: repositoryRoot,
      env: this.#spec.env,
      readyUrl: `http://127.0.0.1:${signaling}/healthz`,
      onLine: this.#spec.onLine,
    });
  }

  /** Starts a robot, or restarts it with its previous arguments. */
  async startRobot(robot: RobotSpec): Promise<void> {
    const adminPort =
      robot.adminPort ?? this.#robots.get(robot.id)?.spec.adminPort ?? (await freePorts(1))[0];
    const spec: Required<RobotSpec> = {
      reference: false,
      input: false,
      ...robot,
      args: robot.args ?? [],
      adminPort: adminPort as number,
    };
    const started = await ManagedProcess.start({
      name: spec.id,
      command: [
        'node',
        'apps/robot-node/src/main.ts',
        '--signaling',
        this.signalingUrl,
        '--id',
        spec.id,
        '--name',
        spec.name,
        '--admin-port',
        String(spec.adminPort),
        '--state-dir',
        this.#stateFolder,
        ...(spec.reference ? ['--reference-signaling', `ws://127.0.0.1:${this.ports.referenceRobot}`] : []),
        ...spec.args,
      ],
      cwd: repositoryRoot,
      env: this.#spec.env,
      readyUrl: `http://127.0.0.1:${spec.adminPort}/healthz`,
      input: spec.input,
      onLine: this.#spec.onLine,
    });
    this.#robots.set(spec.id, { spec, process: started });
  }

  async restartRobot(id: string): Promise<void> {
    await this.startRobot(this.#robot(id).spec);
  }

  /** Stops everything, robots first. */
  async stop(): Promise<void> {
    await Promise.all([...this.#robots.values()].map((robot) => robot.process.stop()));
    await this.#signaling?.stop();
    process.off('exit', this.#forget);
    this.#forget();
  }

  readonly #forget = (): void => rmSync(this.#stateFolder, { recursive: true, force: true });

  #robot(id: string): RunningRobot {
    const robot = this.#robots.get(id);
    if (robot === undefined) throw new Error(`no robot ${id} in this stack`);
    return robot;
  }
}
