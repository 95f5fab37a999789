/** Lets Node compile each program once, before tests start them hundreds of times. */
import { join } from 'node:path';
import { root, run } from '../lib/run.ts';

const PROGRAMS = ['bridge', 'issuer', 'link-emulator', 'robot-node', 'signaling'];

/** Where Node keeps compiled sources; whoever starts the tests may name another place, or turn it off. */
process.env.NODE_COMPILE_CACHE ??= join(root, '.farpoint', 'compile-cache');

let isWarm = false;

export async function warmPrograms(say: (line: string) => void): Promise<void> {
  if (isWarm) return;
  isWarm = true;
  say('compiling the programs once');
  for (const name of PROGRAMS)
    await run('node', [`apps/${name}/src/main.ts`, '--help'], { timeoutMs: 60_000 });
}
