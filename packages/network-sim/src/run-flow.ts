import type { CrossFlow } from './cross-flow.ts';
import type { EventQueue } from './event-queue.ts';
import type { DropReason } from './link-statistics.ts';
import type { Path } from './path.ts';

/** Receives every packet event of a flow. */
export interface FlowListener {
  sent(bytes: number, nowMs: number): void;
  delivered(bytes: number, sentMs: number, atMs: number, queueMs: number): void;
  dropped(sentMs: number, reason: DropReason): void;
}

/** Runs a flow over a path, in the event queue's time. */
export function runFlow(events: EventQueue, flow: CrossFlow, path: Path, listener: FlowListener): void {
  let wakeMs = Number.POSITIVE_INFINITY;
  const send = (handle: number, bytes: number): boolean => {
    const sentMs = events.nowMs;
    listener.sent(bytes, sentMs);
    path.send(bytes, {
      dropped: (reason) => listener.dropped(sentMs, reason),
      delivered: (atMs, queueMs) => {
        listener.delivered(bytes, sentMs, atMs, queueMs);
        flow.delivered(handle, atMs);
        arm();
      },
    });
    return true;
  };
  const arm = (): void => {
    const { nextMs } = flow;
    if (nextMs >= wakeMs) return;
    wakeMs = nextMs;
    events.at(nextMs, () => {
      if (wakeMs === nextMs) wakeMs = Number.POSITIVE_INFINITY;
      if (flow.nextMs <= events.nowMs) flow.run(events.nowMs, send);
      arm();
    });
  };
  arm();
}
