import { describe, expect, it, onTestFinished } from 'vitest';
import { closePlainServer, openPlainServer, plainServerUrl } from '../testing/plain-socket-server.ts';
import { type ConformanceCase, type Level, runSuite, whyUnfinished } from './suite.ts';

/** The second of three cases ends the server. */
async function runWithLoss(level: Level, second: Partial<ConformanceCase<null>>, fails: boolean) {
  const server = await openPlainServer();
  onTestFinished(() => closePlainServer(server).catch(() => undefined));
  const cases: ConformanceCase<null>[] = [
    { name: 'first', run: async () => undefined },
    {
      name: 'second',
      run: async () => {
        await closePlainServer(server);
        if (fails) throw new Error('no answer');
      },
      ...second,
    },
    { name: 'third', run: () => Promise.reject(new Error('tried although nobody is there')) },
  ];
  const results = await runSuite(cases, null, level, { addresses: { robot: plainServerUrl(server) } });
  return { outcomes: results.map(({ outcome }) => outcome), why: whyUnfinished(results) };
}

describe('a server that goes away', () => {
  it.each<[string, Level, Partial<ConformanceCase<null>>, boolean, string[]]>([
    ['after a case that passed', 'strict', {}, false, ['passed', 'passed', 'not-tried']],
    ['during a case', 'strict', {}, true, ['passed', 'failed', 'not-tried']],
    [
      'during a case with a known defect, which does not end the released program',
      'reference',
      { defect: 'order-of-arrival' },
      true,
      ['passed', 'failed', 'not-tried'],
    ],
  ])('%s leaves the next one untried', async (_, level, second, fails, outcomes) => {
    const run = await runWithLoss(level, second, fails);
    expect(run.outcomes).toEqual(outcomes);
    expect(run.why).toMatch(/went away during ‘second’: nothing listens there/);
  });
});
