import { spawnSync } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { expect, test } from 'vitest';

const module = fileURLToPath(new URL('./niceness.ts', import.meta.url));

test('a process may lower its priority, and gets an error if the system refuses to raise it', () => {
  const script = `
    import { getPriority } from 'node:os';
    import { setNiceness } from ${JSON.stringify(module)};
    setNiceness(7);
    console.log(getPriority());
    try { setNiceness(-3); console.log(getPriority()); } catch (error) { console.log(error.constructor.name); }`;
  const { stdout } = spawnSync(process.execPath, ['--input-type=module', '-e', script], { encoding: 'utf8' });
  expect(stdout.trim()).toMatch(/^7\n(-3|\w*Error)$/);
});
