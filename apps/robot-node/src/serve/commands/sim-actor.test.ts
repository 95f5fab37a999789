import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import type { SimAction } from './command-configuration.ts';
import { SimActor } from './sim-actor.ts';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function bench() {
  const actor = new SimActor();
  const said: string[] = [];
  const begin = (action: SimAction) =>
    actor.begin(
      { action: { kind: 'sim', action }, timeoutMs: 1, by: 'Ann', text: '' },
      {
        progress: (share, detail) => said.push(`${share} ${detail}`),
        end: ({ state, detail }) => said.push(`${state} ${detail}`),
      },
    );
  return { actor, said, begin };
}

it('the simulated robot’s lights go on and off', () => {
  const { said, begin } = bench();
  for (const action of ['lights', 'lights', 'horn'] as const) expect(begin(action)).toBeNull();
  expect(said).toEqual(['done the lights are on', 'done the lights are off', 'done the horn has sounded']);
});

it('its self-test takes six seconds, and can be cancelled', async () => {
  const { actor, said, begin } = bench();
  begin('self-test');
  vi.advanceTimersByTime(5999);
  expect(said).toEqual([
    ...['0 tests the motors', '0.25 tests the brakes', '0.5 tests the camera', '0.75 tests the battery'],
  ]);
  vi.advanceTimersByTime(1);
  expect(said[4]).toBe('done everything works');
  const cancel = begin('self-test');
  vi.advanceTimersByTime(2000);
  cancel?.();
  vi.advanceTimersByTime(10_000);
  expect(said.slice(5)).toEqual(['0 tests the motors', '0.25 tests the brakes', 'cancelled ']);
  begin('self-test');
  await actor.close();
  vi.advanceTimersByTime(10_000);
  expect(said.slice(8)).toEqual(['0 tests the motors']);
});
