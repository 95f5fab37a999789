import { describe, expect, it } from 'vitest';
import { MessageRates, type RatedMessage } from './message-rates.ts';

function rates() {
  const dropped: RatedMessage[] = [];
  let told = 0;
  const limits = new MessageRates((kind, tell) => {
    dropped.push(kind);
    told += Number(tell);
  });
  return { limits, dropped, told: () => told };
}

const latch = JSON.stringify({ type: 'estop', latch: true });

describe('MessageRates', () => {
  it('passes what a page sends in a minute', () => {
    const { limits, dropped } = rates();
    for (let ms = 0; ms < 60_000; ms += 5) {
      // 200 messages a second on the control channel, two of them probes.
      limits.drops('control', '{}', ms);
      if (ms % 500 === 0) limits.over('probe', ms);
      if (ms % 100 === 0) limits.drops('session', '{}', ms);
      if (ms % 100 === 0) limits.drops('bandwidth', new Uint8Array(8), ms);
      if (ms % 1000 === 0) limits.over('lease', ms);
    }
    expect(dropped).toEqual([]);
  });

  it('drops the rest of a flood, and says so once a second', () => {
    const { limits, dropped, told } = rates();
    for (let n = 0; n < 20_000; n++) limits.drops('session', '{}', n / 10);
    // A burst of 200 and 2 s at 50 a second.
    expect(20_000 - dropped.length).toBeGreaterThanOrEqual(299);
    expect(20_000 - dropped.length).toBeLessThanOrEqual(301);
    expect(told()).toBe(2);
  });

  it('lets an emergency stop through a flood of other messages, as text or bytes', () => {
    const { limits } = rates();
    for (let n = 0; n < 1000; n++) limits.drops('session', '{"type":"leaseRelease"}', 0);
    expect(limits.drops('session', '{"type":"leaseRelease"}', 0)).toBe(true);
    expect(limits.drops('session', latch, 0)).toBe(false);
    expect(limits.drops('session', new TextEncoder().encode(latch), 0)).toBe(false);
  });

  it('limits emergency stops as well: the stop is latched by the first', () => {
    const { limits } = rates();
    const passed = Array.from({ length: 100 }, () => limits.drops('session', latch, 0)).filter(
      (over) => !over,
    );
    expect(passed).toHaveLength(20);
  });
});
