import { setTimeout as sleep } from 'node:timers/promises';
import { RefreshPace, soundLifetimeS } from '../ice/relay-lifetime.ts';
import { expectMethods } from './werift-shape.ts';

/** RFC 8656 §18.1. */
const REFRESH = 0x004;

interface MessageShape {
  messageMethod: number;
  getAttributeValue(name: 'LIFETIME'): unknown;
  setAttribute(name: 'LIFETIME', seconds: number): unknown;
}

interface TurnShape {
  requestWithRetry(
    request: MessageShape,
    server: unknown,
    signal?: AbortSignal,
  ): Promise<[MessageShape, unknown]>;
}

/** Time as this computer has it. */
const REAL_TIME = {
  now: () => performance.now(),
  /** Rejects when the signal says so. */
  wait: async (ms: number, signal?: AbortSignal): Promise<void> =>
    await sleep(ms, undefined, signal === undefined ? {} : { signal }),
};

/** Bounds how often the TURN server is asked to refresh an allocation: werift believes any lifetime that it is told. */
export function guardRelay(turn: object, { now, wait } = REAL_TIME): void {
  const shape = turn as TurnShape;
  expectMethods(shape, 'the relay', ['requestWithRetry']);
  const request = shape.requestWithRetry.bind(turn);
  const pace = new RefreshPace(now());
  shape.requestWithRetry = async (message, server, signal) => {
    if (message.messageMethod !== REFRESH) return await request(message, server, signal);
    const waitMs = pace.take(now());
    // Rejects when the allocation is given up.
    if (waitMs > 0) await wait(waitMs, signal);
    const [answer, from] = await request(message, server, signal);
    answer.setAttribute('LIFETIME', soundLifetimeS(answer.getAttributeValue('LIFETIME')));
    return [answer, from];
  };
}
