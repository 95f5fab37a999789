/** The addon at a stand-in for a chip, in a program of its own. */
import { spawnSync } from 'node:child_process';
import { afterAll, describe, expect, it } from 'vitest';
import { loadAddon } from './addon.ts';
import { openGpioLine } from './line.ts';
import { FAKE_CHIP, FakeChip } from './testing/fake-chip.ts';

function isBuilt(): boolean {
  try {
    loadAddon();
    return true;
  } catch {
    return false;
  }
}
const chip = isBuilt() ? FakeChip.build() : null;
afterAll(() => chip?.close());

/** Evaluates an expression with `open`, in a program that sees the chip. */
function evaluate(expression: string): unknown {
  const program = `
    import { openGpioLine } from ${JSON.stringify(new URL('./line.ts', import.meta.url).href)};
    const open = (line, activeLow = false) => openGpioLine({ chip: '${FAKE_CHIP}', line, activeLow });
    const fault = (act) => { try { return act(); } catch (error) { return error.message; } };
    console.log(JSON.stringify(${expression}));`;
  const { stdout, stderr } = spawnSync(process.execPath, ['--input-type=module', '-e', program], {
    env: { ...process.env, ...chip?.env },
    encoding: 'utf8',
  });
  expect(stderr).not.toMatch(/error/i);
  return JSON.parse(stdout);
}

describe.skipIf(!isBuilt())('a GPIO line (needs the addon, pnpm build:native)', () => {
  it.skipIf(chip === null)('is read as the chip says, and as its active level means', () => {
    chip?.set(3, true);
    chip?.set(4, false);
    chip?.set(5, false);
    expect(evaluate('[open(3).isActive(), open(4).isActive(), open(5, true).isActive()]')).toEqual([
      true,
      false,
      true,
    ]);
  });

  it.skipIf(chip === null)('is requested once, freed when it is closed, and refused with a reason', () => {
    chip?.set(3, false);
    const busy = `${FAKE_CHIP} line 3: another program or driver uses the line`;
    expect(evaluate('[open(3) && fault(() => open(3))]')).toEqual([busy]);
    expect(evaluate('[open(3).close() ?? open(3).isActive()]')).toEqual([false]);
    expect(evaluate('[fault(() => open(32))]')).toEqual([`${FAKE_CHIP} line 32: the chip has no such line`]);
    expect(evaluate('[fault(() => open(9))]')).toEqual([`${FAKE_CHIP} line 9: the chip is gone`]);
    const closed = 'fault(() => { const line = open(3); line.close(); return line.isActive(); })';
    expect(evaluate(`[${closed}]`)).toEqual([`${FAKE_CHIP} line 3: the line was closed`]);
  });

  it('says what is wrong', () => {
    const at = { line: 0, activeLow: false };
    expect(() => openGpioLine({ chip: '/dev/gpiochip999', ...at })).toThrow(
      '/dev/gpiochip999 line 0: there is no such chip',
    );
    expect(() => openGpioLine({ chip: '/dev/null', ...at })).toThrow('it is no GPIO chip');
    expect(() => openGpioLine({ chip: `/dev/${'x'.repeat(80)}`, ...at })).toThrow(/needs a chip/);
  });
});
