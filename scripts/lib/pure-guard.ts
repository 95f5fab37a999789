/**
 * Keeps the tests of the project `pure` pure: starting a process or a thread, or opening a socket, throws, and fails
 * the test even if the code under test catches that. A test that needs one belongs in a file named
 * `*.stack.test.ts`.
 */
import childProcess from 'node:child_process';
import dgram from 'node:dgram';
import { syncBuiltinESMExports } from 'node:module';
import net from 'node:net';
import workerThreads from 'node:worker_threads';
import { afterEach } from 'vitest';

let refusal: Error | null = null;

function refuse(what: string): () => never {
  // A plain function, because `Worker` is called with `new`.
  return function refused(): never {
    refusal = new Error(`a pure test may not ${what}: name the file *.stack.test.ts`);
    throw refusal;
  };
}

const startProcess = refuse('start a process');
const PROCESS_STARTERS = [
  'exec',
  'execFile',
  'execFileSync',
  'execSync',
  'fork',
  'spawn',
  'spawnSync',
] as const;
for (const name of PROCESS_STARTERS) Object.assign(childProcess, { [name]: startProcess });
Object.assign(workerThreads, { Worker: refuse('start a thread') });
const openSocket = refuse('open a socket');
Object.assign(net.Server.prototype, { listen: openSocket });
Object.assign(net.Socket.prototype, { connect: openSocket });
Object.assign(dgram.Socket.prototype, { bind: openSocket, connect: openSocket, send: openSocket });
syncBuiltinESMExports();

afterEach(() => {
  const refused = refusal;
  refusal = null;
  if (refused !== null) throw refused;
});
