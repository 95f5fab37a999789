/** Runs a real master and rospy nodes, for tests. */
import { type ChildProcess, execFileSync, spawn } from 'node:child_process';
import { once } from 'node:events';
import { mkdtempSync, rmSync } from 'node:fs';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const SCRIPT = join(import.meta.dirname, 'ros1_node.py');
/** Debian's rospy belongs to the system's Python, which may not be the first in the path. */
const PYTHONS = ['python3', '/usr/bin/python3'];
const PACKAGES = [
  'python3-rospy',
  'python3-rosmaster',
  'python3-sensor-msgs',
  'python3-nav-msgs',
  'python3-diagnostic-msgs',
];
const REMEDY = `on Debian: apt-get install ${PACKAGES.join(' ')}`;

/** What a rospy node received on a velocity topic. */
export interface Heard {
  topic: string;
  x: number;
  turn: number;
  /** When the node received it, ms since 1970. */
  nodeMs: number;
  /** When the line arrived here, ms of `performance.now()`. */
  atMs: number;
}

export class Ros1Peers {
  /** Debian's packages that have everything. */
  static readonly PACKAGES: readonly string[] = PACKAGES;
  readonly port: number;
  readonly masterUrl: string;
  readonly #python: string;
  readonly #logs = mkdtempSync(join(tmpdir(), 'farpoint-roscore-'));
  readonly #nodes = new Set<Ros1Node>();
  #core: ChildProcess | null = null;

  private constructor(python: string, port: number) {
    this.#python = python;
    this.port = port;
    this.masterUrl = `http://127.0.0.1:${port}`;
  }

  /** @returns the Python that has rospy, or in `missing` what is missing and how to install it */
  static find(): { python: string; missing: null } | { python: null; missing: string } {
    for (const python of PYTHONS) {
      try {
        execFileSync(python, ['-c', 'import rospy, sensor_msgs.msg, nav_msgs.msg, diagnostic_msgs.msg'], {
          stdio: 'pipe',
        });
        execFileSync('which', ['rosmaster'], { stdio: 'pipe' });
        return { python, missing: null };
      } catch {
        // Try the next one.
      }
    }
    return { python: null, missing: `needs rosmaster and rospy; ${REMEDY}` };
  }

  static async open(python: string): Promise<Ros1Peers> {
    return new Ros1Peers(python, await freePort());
  }

  async startCore(): Promise<void> {
    // The program that roscore runs; roscore itself starts it outside the process group, where it cannot be killed with
    // it.
    this.#core = spawn('rosmaster', ['--core', '-p', String(this.port)], {
      env: this.#environment,
      stdio: 'ignore',
      detached: true,
    });
    endWithUs(this.#core);
    await this.untilAnswers();
  }

  /** Kills it without warning, together with its children. */
  async killCore(): Promise<void> {
    await killGroup(this.#core);
    this.#core = null;
  }

  /** @param parts of `ros1_node.py`, separated by commas */
  async startNode(parts: string, name: string, hz = 10): Promise<Ros1Node> {
    const child = spawn(this.#python, [SCRIPT, parts, name, String(hz)], {
      env: this.#environment,
      stdio: ['ignore', 'pipe', 'inherit'],
      detached: true,
    });
    endWithUs(child);
    const node = new Ros1Node(child);
    this.#nodes.add(node);
    await node.ready;
    return node;
  }

  async untilAnswers(): Promise<void> {
    const body = `<?xml version="1.0"?><methodCall><methodName>getPid</methodName><params><param><value>/test</value></param></params></methodCall>`;
    for (;;) {
      const answer = await fetch(this.masterUrl, { method: 'POST', body }).catch(() => null);
      if (answer?.ok) return;
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
  }

  async close(): Promise<void> {
    for (const node of this.#nodes) await node.kill();
    await this.killCore();
    rmSync(this.#logs, { recursive: true, force: true });
  }

  get #environment(): NodeJS.ProcessEnv {
    const { masterUrl } = this;
    return { ...process.env, ROS_MASTER_URI: masterUrl, ROS_IP: '127.0.0.1', ROS_LOG_DIR: this.#logs };
  }
}

export class Ros1Node {
  readonly heard: Heard[] = [];
  readonly ready: Promise<void>;
  readonly #child: ChildProcess;

  constructor(child: ChildProcess) {
    this.#child = child;
    let text = '';
    this.ready = new Promise((resolve, reject) => {
      child.once('exit', () => reject(new Error('the rospy node ended')));
      child.stdout?.on('data', (chunk: Buffer) => {
        text += chunk.toString();
        const lines = text.split('\n');
        text = lines.pop() ?? '';
        // rospy also prints lines of its own.
        for (const line of lines.filter((each) => each.startsWith('{'))) {
          const said = JSON.parse(line) as Heard | { ready: true };
          if ('ready' in said) resolve();
          else this.heard.push({ ...said, atMs: performance.now() });
        }
      });
    });
    this.ready.catch(() => {});
  }

  get pid(): number {
    return this.#child.pid ?? -1;
  }

  /** Kills it without deregistering from the master. */
  async kill(): Promise<void> {
    await killGroup(this.#child);
  }
}

/** Leaves no process behind if the test is ended from outside. */
function endWithUs(child: ChildProcess): void {
  const kill = () => child.pid !== undefined && process.kill(-child.pid, 'SIGKILL');
  process.once('exit', kill);
  child.once('exit', () => process.off('exit', kill));
}

async function killGroup(child: ChildProcess | null): Promise<void> {
  if (child?.pid === undefined || child.exitCode !== null || child.signalCode !== null) return;
  const ended = once(child, 'exit');
  process.kill(-child.pid, 'SIGKILL');
  await ended;
}

async function freePort(): Promise<number> {
  const server = createServer().listen(0, '127.0.0.1');
  await once(server, 'listening');
  const address = server.address();
  server.close();
  await once(server, 'close');
  if (address === null || typeof address === 'string') throw new Error('no port');
  return address.port;
}
