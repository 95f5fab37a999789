import { expect, it } from 'vitest';
import { checkUdpPorts } from './check-network.ts';

it('UDP ports: too few, privileged', async () => {
  const verdicts = async (range: [number, number]) =>
    (await checkUdpPorts(range, 4)).map(({ verdict }) => verdict);
  expect(await checkUdpPorts(null, 4)).toEqual([]);
  expect(await verdicts([50_000, 50_003])).toEqual(['warn']);
  expect(await verdicts([50_000, 50_400])).toEqual(['ok']);
});
