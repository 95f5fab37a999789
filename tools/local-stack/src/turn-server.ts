import { type ChildProcess, spawn, spawnSync } from 'node:child_process';
import { randomBytes } from 'node:crypto';
import { createSocket } from 'node:dgram';
import { rmSync } from 'node:fs';
import { networkInterfaces, tmpdir } from 'node:os';
import { join } from 'node:path';

/** How to install it. */
export const TURN_REMEDY = 'apt-get install coturn';

/** Whether coturn is installed here. */
export function hasTurnServer(): boolean {
  return spawnSync('turnserver', ['--version'], { stdio: 'ignore' }).error === undefined;
}

/** An address of this machine that browsers can reach from any interface. */
function ownAddress(): string {
  const addresses = Object.values(networkInterfaces()).flat();
  return addresses.find((own) => own?.family === 'IPv4' && !own.internal)?.address ?? '127.0.0.1';
}

/** A real coturn for one test, with the shared secret from which signaling makes credentials. */
export class TurnServer {
  readonly secret = randomBytes(16).toString('hex');
  readonly address = ownAddress();
  readonly port: number;
  readonly #pidFile: string;
  #child: ChildProcess | null = null;

  constructor(port: number) {
    this.port = port;
    this.#pidFile = join(tmpdir(), `farpoint-turn-${port}.pid`);
  }

  get url(): string {
    return `turn:${this.address}:${this.port}?transport=udp`;
  }

  /** @throws {Error} with its output if it does not answer within 10 s */
  async start(): Promise<void> {
    let output = '';
    const child = spawn('turnserver', [
      '-n',
      '--no-cli',
      '--no-tls',
      '--no-dtls',
      '--no-tcp',
      '--log-file',
      'stdout',
      '--pidfile',
      this.#pidFile,
      '--listening-ip',
      this.address,
      '--relay-ip',
      this.address,
      '--listening-port',
      String(this.port),
      '--realm',
      'farpoint.test',
      '--use-auth-secret',
      `--static-auth-secret=${this.secret}`,
      '--allow-loopback-peers',
    ]);
    this.#child = child;
    process.once('exit', this.#kill);
    for (const stream of [child.stdout, child.stderr]) {
      stream.on('data', (data: Buffer) => {
        output = (output + data.toString()).slice(-4000);
      });
    }
    for (let tries = 0; tries < 100; tries++) {
      if (child.exitCode !== null) break;
      if (await answersStun(this.address, this.port)) return;
    }
    await this.stop();
    throw new Error(`turnserver does not answer\n${output}`);
  }

  async stop(): Promise<void> {
    const child = this.#child;
    this.#child = null;
    if (child === null || child.exitCode !== null || child.signalCode !== null) return;
    const gone = new Promise((resolve) => child.once('exit', resolve));
    child.kill('SIGKILL');
    await gone;
    process.off('exit', this.#kill);
    rmSync(this.#pidFile, { force: true });
  }

  readonly #kill = (): void => {
    this.#child?.kill('SIGKILL');
  };
}

/** Sends a STUN binding request (RFC 8489) and waits 100 ms for the answer. */
function answersStun(address: string, port: number): Promise<boolean> {
  const request = Buffer.concat([Buffer.from('000100002112a442', 'hex'), randomBytes(12)]);
  return new Promise((resolve) => {
    const socket = createSocket('udp4');
    let answered = false;
    const timer = setTimeout(() => socket.close(), 100);
    socket.on('close', () => resolve(answered));
    socket.on('error', () => undefined);
    socket.once('message', () => {
      answered = true;
      clearTimeout(timer);
      socket.close();
    });
    socket.send(request, port, address);
  });
}
