import { describe, expect, it } from 'vitest';
import { failedTests, failuresOf } from './failures.ts';

const noise = Array.from({ length: 400 }, (_, index) => ` ✓ test ${index}`).join('\n');

describe('what failed', () => {
  it.each([
    [
      'vitest',
      '\u001b[31m⎯⎯⎯\u001b[39m\u001b[1m\u001b[41m Failed Tests 1 \u001b[49m\u001b[22m\u001b[31m⎯⎯⎯\u001b[39m',
      '⎯⎯⎯ Failed Tests 1 ⎯⎯⎯',
    ],
    [
      'Playwright',
      '  1) [chromium] › tests/a.spec.ts:5:1 › a title',
      '  1) [chromium] › tests/a.spec.ts:5:1 › a title',
    ],
    ['cargo', 'failures:', 'failures:'],
  ])('begins at the list of %s', (_, list, first) => {
    expect(failuresOf(`${noise}\n${list}\n why\n`)).toBe(`${first}\n why`);
  });

  it('is the last lines of a step without a list, and bounded', () => {
    expect(failuresOf(`${noise}\nerror TS2322: no\n`).split('\n')).toHaveLength(120);
    expect(failuresOf(`${noise}\nerror TS2322: no\n`)).toMatch(/error TS2322: no$/);
    expect(failuresOf(`failures:\n${noise}`).split('\n')).toHaveLength(120);
  });
});

describe('the names of the tests that failed', () => {
  it('are listed once, without the reasons between them', () => {
    const vitest = ' FAIL   stack  a/b.test.ts > group > title\nAssertionError: no\n';
    expect(failedTests(`${noise}\n${vitest}${vitest}`)).toEqual(['stack  a/b.test.ts > group > title']);
    const playwright = ['one', 'two'].map(
      (title, index) =>
        `  ${index + 1}) [chromium] › tests/a.spec.ts:5:1 › ${title} ──────\n\n    Error: why\n`,
    );
    const named = ['[chromium] › tests/a.spec.ts:5:1 › one', '[chromium] › tests/a.spec.ts:5:1 › two'];
    expect(failedTests(`${noise}\n${playwright.join('\n')}`)).toEqual(named);
  });

  it('are none where no test failed', () => {
    expect(failedTests(`${noise}\nerror TS2322: 1) no list\n`)).toEqual([]);
  });
});
