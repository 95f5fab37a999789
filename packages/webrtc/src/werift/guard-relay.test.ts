import { expect, it } from 'vitest';
import { guardRelay } from './guard-relay.ts';
import { WeriftShapeError } from './werift-shape.ts';

const [ALLOCATE, REFRESH] = [0x003, 0x004];

/** A relay of werift's shape whose server grants these seconds, and what was asked of it when. */
function guarded(grantedS: number | null) {
  let nowMs = 0;
  const asked: [method: number, atMs: number][] = [];
  const message = (messageMethod: number) => {
    let lifetime: unknown = grantedS ?? undefined;
    return {
      messageMethod,
      getAttributeValue: () => lifetime,
      setAttribute: (_: string, seconds: number) => {
        lifetime = seconds;
      },
    };
  };
  const turn = {
    requestWithRetry: async (
      request: { messageMethod: number },
      _server?: unknown,
      _signal?: AbortSignal,
    ): Promise<[ReturnType<typeof message>, unknown]> => {
      asked.push([request.messageMethod, nowMs]);
      return [message(request.messageMethod), null];
    },
  };
  guardRelay(turn, {
    now: () => nowMs,
    wait: async (ms, signal) => {
      signal?.throwIfAborted();
      nowMs += ms;
    },
  });
  return { turn, message, asked };
}

it.each([
  [0, 60],
  [1, 60],
  [0xffff_ffff, 3600],
  [null, 600],
  [900, 900],
])(
  'told %s s, it counts on %i s, and asks again after ten seconds at the earliest',
  async (told, counted) => {
    const { turn, message, asked } = guarded(told);
    await turn.requestWithRetry(message(ALLOCATE));
    for (let i = 0; i < 2; i++) {
      const [answer] = await turn.requestWithRetry(message(REFRESH));
      expect(answer.getAttributeValue()).toBe(counted);
    }
    expect(asked).toEqual([
      [ALLOCATE, 0],
      [REFRESH, 10_000],
      [REFRESH, 20_000],
    ]);
  },
);

it('asks no more once the allocation is given up', async () => {
  const { turn, message, asked } = guarded(600);
  await expect(turn.requestWithRetry(message(REFRESH), null, AbortSignal.abort())).rejects.toThrow();
  expect(asked).toEqual([]);
});

it('says so if a new version of werift has another shape', () => {
  expect(() => guardRelay({})).toThrow(WeriftShapeError);
});
