import { vi } from 'vitest';

/** The robot's clock began so long before the operator's, ms: whatever takes one for the other is wrong. */
const ROBOT_AHEAD_MS = 123_456;

class WorkerStub {
  onmessage = null;
  onerror = null;
  postMessage(): void {}
  terminate(): void {}
}

/** Fakes all timers and clocks for one run, from the same instant each time. @returns what lets time pass, ms */
export function virtualTime(): Disposable & { advance(ms: number): void } {
  vi.useFakeTimers({
    now: Date.UTC(2026, 0, 1),
    toFake: [
      ...(['setTimeout', 'clearTimeout', 'setInterval', 'clearInterval'] as const),
      ...(['Date', 'performance', 'hrtime'] as const),
    ],
  });
  const hrtime = process.hrtime;
  const startNs = hrtime.bigint();
  process.hrtime = Object.assign(
    () => {
      const ns = hrtime.bigint() - startNs + BigInt(ROBOT_AHEAD_MS) * 1_000_000n;
      return [Number(ns / 1_000_000_000n), Number(ns % 1_000_000_000n)] as [number, number];
    },
    { bigint: hrtime.bigint },
  );
  vi.stubGlobal('Worker', WorkerStub);
  return {
    advance: (ms) => void vi.advanceTimersByTime(ms),
    [Symbol.dispose]() {
      process.hrtime = hrtime;
      vi.clearAllTimers();
      vi.useRealTimers();
      vi.unstubAllGlobals();
    },
  };
}
