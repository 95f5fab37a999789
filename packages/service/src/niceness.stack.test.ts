import { spawnSync } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';

const module = fileURLToPath(new URL('./niceness.ts', import.meta.url));

function run(script: string): string[] {
  const { stdout } = spawnSync(process.execPath, ['--input-type=module', '-e', script], { encoding: 'utf8' });
  return stdout.trim().split('\n');
}

describe('setNiceness', () => {
  it('lowers the priority; the system may refuse to raise it, and that is an error', () => {
    const [lowered, raised] = run(`
      import { getPriority } from 'node:os';
      import { setNiceness } from ${JSON.stringify(module)};
      setNiceness(7);
      console.log(getPriority());
      try { setNiceness(-3); console.log(getPriority()); } catch (error) { console.log(error.constructor.name); }`);
    expect(lowered).toBe('7');
    expect(raised).toMatch(/^(-3|\w*Error)$/);
  });

  it.skipIf(process.platform !== 'linux')(
    'is that of all its threads, and of those that it starts later',
    () => {
      const threads = run(`
      import { readdirSync } from 'node:fs';
      import { getPriority } from 'node:os';
      import { Worker } from 'node:worker_threads';
      import { setNiceness } from ${JSON.stringify(module)};
      setNiceness(7);
      const worker = new Worker('setInterval(() => {}, 1000)', { eval: true });
      worker.once('online', () => {
        for (const thread of readdirSync('/proc/self/task')) console.log(getPriority(Number(thread)));
        process.exit();
      });`);
      expect(threads.length).toBeGreaterThan(2);
      expect(new Set(threads)).toEqual(new Set(['7']));
    },
  );
});
