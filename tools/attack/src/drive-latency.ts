import { clockAnswerCodec, decodeJson } from '@farpoint/protocol';
import type { LiveDriver } from './live-driver.ts';

export interface Latency {
  /** From a clock probe to its answer; `null` without samples. */
  roundTripP95Ms: number | null;
  /** From a command to the last packet of the frame that shows it: what an operator sees, without drawing it. */
  commandToFrameP95Ms: number | null;
  samples: number;
}

/** A test whose frame was lost gets no answer. */
const GIVE_UP_MS = 1000;

/** Never used twice: answers of earlier measurements stay in the driver's log. */
let nextId = 1000;

/** Measures what the driver notices for some time, one test after another. */
export async function measureLatency(driver: LiveDriver, seconds: number): Promise<Latency> {
  const { client } = driver.operator;
  const roundTrips: number[] = [];
  const frames: number[] = [];
  const probes = new Map<number, number>();
  const { unSubscribe } = client.control.onMessage.subscribe((data) => {
    const { id } = decodeJson(clockAnswerCodec, data);
    const sentMs = probes.get(id);
    if (sentMs !== undefined) roundTrips.push(performance.now() - sentMs);
    probes.delete(id);
  });
  const end = performance.now() + seconds * 1000;
  while (performance.now() < end) {
    const id = nextId++;
    const begun = performance.now();
    probes.set(id, begun);
    client.sendControl({ type: 'clockProbe', id, sentMs: begun });
    driver.test(id);
    const shown = () => {
      const found = client.session.findLast(
        (message) => message.type === 'latencyFrame' && message.id === id,
      );
      return found?.type === 'latencyFrame' && client.frames.get(found.frameNumber)?.complete === true;
    };
    let timer: NodeJS.Timeout | undefined;
    const late = new Promise<false>((resolve) => {
      timer = setTimeout(() => resolve(false), GIVE_UP_MS);
    });
    if (await Promise.race([client.until(shown).then(() => true), late]))
      frames.push(performance.now() - begun);
    clearTimeout(timer);
    // Ten tests a second are answered.
    await new Promise((resolve) => setTimeout(resolve, Math.max(0, begun + 110 - performance.now())));
  }
  unSubscribe();
  return { roundTripP95Ms: p95(roundTrips), commandToFrameP95Ms: p95(frames), samples: frames.length };
}

function p95(values: readonly number[]): number | null {
  const sorted = values.toSorted((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(sorted.length * 0.95))] ?? null;
}
