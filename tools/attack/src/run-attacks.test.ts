import { expect, it } from 'vitest';
import type { Attack } from './attack.ts';
import { HarmError, NotTriedError } from './harm.ts';
import { runAttacks } from './run-attacks.ts';
import type { Scene } from './scene.ts';

/** Programs on which the attack named `deadly` has an effect that only facts show. */
function scenes() {
  let started = 0;
  let hurt = false;
  const start = async () => {
    started++;
    hurt = false;
    return {
      hurt: () => {
        hurt = true;
      },
      harm: async () => (hurt ? 'the robot has ended' : null),
      stop: async () => undefined,
    } as unknown as Scene;
  };
  return { start, started: () => started };
}

const attack = (name: string, run: Attack['run']): Attack => ({ name, layer: 'dtls', run });

it('judges by facts, whatever the attack itself says, and starts anew after harm', async () => {
  const { start, started } = scenes();
  const results = await runAttacks(
    [
      attack('harmless', async () => undefined),
      attack('deadly', async (scene) => (scene as unknown as { hurt(): void }).hurt()),
      attack('seen', async () => {
        throw new HarmError('it was answered');
      }),
      attack('lacking', async () => {
        throw new NotTriedError('no raw sockets');
      }),
    ],
    () => undefined,
    start,
  );
  expect(results.map(({ outcome, detail }) => [outcome, detail])).toEqual([
    ['held', null],
    ['harmed', 'the robot has ended'],
    ['harmed', 'it was answered'],
    ['not tried', 'no raw sockets'],
  ]);
  // Once at the beginning, and once after each harm.
  expect(started()).toBe(3);
});
