import type { RateController } from '../rate-controller.ts';
import { Bottleneck, type BurstLoss, type CapacityStep, capacityBits } from './bottleneck.ts';
import { CubicFlow } from './cubic-flow.ts';
import { EventQueue } from './event-queue.ts';
import type { FlowRecord } from './flow-record.ts';
import { MediaFlow, type MediaFlowOptions } from './media-flow.ts';
import { Path, type PathOptions } from './path.ts';
import { seededRandom } from './random.ts';
import { type StallOptions, Stalls } from './stalls.ts';

type OwnOptions = Partial<
  Omit<MediaFlowOptions, 'controller' | 'forward' | 'back' | 'senderStalls' | 'receiverStalls'>
>;

/** One of our flows; its round trip may differ from the scenario's. */
export interface MediaSpec extends OwnOptions {
  rttMs?: number;
}

export interface CubicSpec {
  startMs?: number;
  stopMs?: number;
  bytes?: number;
  /** It loads the feedback's way in place of the media's. */
  reverse?: boolean;
}

/** A dumbbell: flows over one bottleneck, the queue in front of it, propagation behind. */
export interface Scenario {
  name: string;
  durationMs: number;
  capacity: readonly CapacityStep[];
  /** Propagation both ways together. */
  rttMs: number;
  /** Drop-tail, ms at the first capacity; or in bytes. */
  queueMs?: number;
  /** The queue's ms are reckoned at the capacity of the moment. */
  queueFollows?: boolean;
  queueBytes?: number;
  loss?: number;
  burstLoss?: BurstLoss;
  /** Of the media's way: see {@link PathOptions}. */
  delaySteps?: PathOptions['delaySteps'];
  jitterMs?: number;
  wobbleMs?: number;
  reorder?: number;
  /** Sender, link and receiver are processes on busy machines. */
  stalls?: { sender?: StallOptions; link?: StallOptions; receiver?: StallOptions };
  /** Of the feedback. */
  backLoss?: number;
  /** A bottleneck on the feedback's way. */
  backCapacity?: readonly CapacityStep[];
  backQueueMs?: number;
  /** Default: one, from the beginning. */
  media?: readonly MediaSpec[];
  cubic?: readonly CubicSpec[];
  seed?: number;
}

export interface Outcome {
  scenario: Scenario;
  media: FlowRecord[];
  cubic: FlowRecord[];
}

const queueBytesOf = (steps: readonly CapacityStep[], ms: number): number =>
  ((steps[0]?.bitsPerSecond ?? 0) * ms) / 8000;

/** Runs it in virtual time. The same scenario and controller give the same outcome. */
export function runScenario(scenario: Scenario, controller: () => RateController): Outcome {
  const events = new EventQueue();
  const random = seededRandom(scenario.seed ?? 1);
  const { capacity, backCapacity } = scenario;
  const queueBytes = scenario.queueBytes ?? queueBytesOf(capacity, scenario.queueMs ?? 100);
  const { loss = 0, burstLoss } = scenario;
  const link = new Bottleneck(
    {
      capacity,
      queueBytes,
      loss,
      ...(scenario.queueFollows ? { queueMs: scenario.queueMs ?? 100 } : {}),
      ...(burstLoss === undefined ? {} : { burstLoss }),
    },
    random,
  );
  const backQueueBytes = queueBytesOf(backCapacity ?? [], scenario.backQueueMs ?? 100);
  const backLink =
    backCapacity && new Bottleneck({ capacity: backCapacity, queueBytes: backQueueBytes }, random);
  const { delaySteps = [], jitterMs = 0, wobbleMs = 0, reorder = 0 } = scenario;
  // Of their own seed, so that they are the same whatever the flows do.
  const stallRandom = seededRandom((scenario.seed ?? 1) + 77);
  const stalls = (options: StallOptions | undefined) =>
    options === undefined ? null : new Stalls(options, seededRandom(stallRandom() * 2 ** 32));
  const linkStalls = stalls(scenario.stalls?.link);
  const forwardPath = (rttMs: number, receiverStalls: Stalls | null) =>
    new Path(
      {
        bottleneck: link,
        delayMs: rttMs / 2,
        delaySteps,
        jitterMs,
        wobbleMs,
        reorder,
        reorderMs: 10,
        linkStalls,
        receiverStalls,
      },
      random,
    );
  const backPath = (rttMs: number) =>
    new Path({ bottleneck: backLink ?? null, delayMs: rttMs / 2, loss: scenario.backLoss ?? 0 }, random);

  const media = (scenario.media ?? [{}]).map((spec, i) => {
    const { rttMs = scenario.rttMs, ...own } = spec;
    const name = `media ${i + 1}`;
    const receiverStalls = stalls(scenario.stalls?.receiver);
    const paths = { forward: forwardPath(rttMs, receiverStalls), back: backPath(rttMs) };
    const busy = { senderStalls: stalls(scenario.stalls?.sender), receiverStalls };
    return new MediaFlow(events, random, { name, ...busy, ...own, ...paths, controller: controller() });
  });
  const cubic = (scenario.cubic ?? []).map(({ reverse, ...own }, i) => {
    const forward = reverse ? backPath(scenario.rttMs) : forwardPath(scenario.rttMs, null);
    return new CubicFlow(events, {
      name: `cubic ${i + 1}`,
      ...own,
      forward,
      backDelayMs: scenario.rttMs / 2,
    });
  });
  events.runUntil(scenario.durationMs);
  return { scenario, media: media.map((f) => f.record), cubic: cubic.map((f) => f.record) };
}

/** Bits that the scenario's link could carry between two times. */
export function carriedAtMost(scenario: Scenario, fromMs: number, toMs: number): number {
  return capacityBits(scenario.capacity, fromMs, toMs);
}
