import {
  type BurstLoss,
  CapacitySchedule,
  type CapacityStep,
  EventQueue,
  idealProfile,
  type LinkProfile,
  PacketLoss,
  Path,
  type QueueLimit,
  Random,
  runFlow,
  type StallOptions,
  Stalls,
  TcpFlow,
  VirtualLink,
} from '@farpoint/network-sim';
import { BitRate } from '@farpoint/timing';
import type { RateController } from '../rate-controller.ts';
import { FlowRecord } from './flow-record.ts';
import { MediaFlow, type MediaFlowOptions } from './media-flow.ts';

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
  /** It loads the feedback path instead of the media path. */
  reverse?: boolean;
}

/** A dumbbell topology: flows over one link in each direction. */
export interface Scenario {
  name: string;
  durationMs: number;
  capacity: readonly CapacityStep[];
  /** Propagation, both directions together. */
  rttMs: number;
  /** Drop-tail, in ms at the first capacity; or in bytes. */
  queueMs?: number;
  /** Converts the queue's ms at the current capacity. */
  queueFollows?: boolean;
  queueBytes?: number;
  /** Behind the bottleneck: lost packets have used their share of the capacity. */
  loss?: number;
  burstLoss?: BurstLoss;
  /** Route changes on the media path: from when on it is longer or shorter, and by how much, ms. In order of time. */
  delaySteps?: readonly (readonly [fromMs: number, moreMs: number])[];
  /** On the media path, as in {@link LinkProfile}. */
  jitterMs?: number;
  tailMs?: number;
  /** Fraction of packets that are delayed by 10 ms and overtaken meanwhile, 0–1. */
  reorder?: number;
  /** Sender, link and receiver are processes on busy machines. */
  stalls?: { sender?: StallOptions; link?: StallOptions; receiver?: StallOptions };
  /** Of the feedback path. */
  backLoss?: number;
  /** A bottleneck on the feedback path. */
  backCapacity?: readonly CapacityStep[];
  backQueueMs?: number;
  /** Default: one flow, from the beginning. */
  media?: readonly MediaSpec[];
  cubic?: readonly CubicSpec[];
  seed?: number;
}

export interface Outcome {
  scenario: Scenario;
  media: FlowRecord[];
  cubic: FlowRecord[];
}

/** The bytes that a queue of this many ms holds at the first capacity. */
const queueOf = (steps: readonly CapacityStep[], ms: number): QueueLimit => ({
  bytes: BitRate.bytesIn(BitRate.fromMbps(steps[0]?.mbps ?? 0), ms),
});

/** Runs the scenario in virtual time. The same scenario and controller give the same outcome. */
export function runScenario(scenario: Scenario, controller: () => RateController): Outcome {
  const { rttMs, seed = 1, cubic: cubicSpecs = [], media: mediaSpecs = [{}] } = scenario;
  const events = new EventQueue();
  const random = new Random(seed, 6);
  // A seed of their own, so that stalls are the same whatever the flows do.
  const stallRandom = new Random(seed, 7);
  const stalls = (options: StallOptions | undefined) => {
    const own = new Random(stallRandom.next() * 2 ** 32, 8);
    return options === undefined ? null : new Stalls(options, own);
  };
  /** The link has the delay of the shortest path; flows with a longer one add the rest behind it. */
  const delayMs = Math.min(rttMs, ...mediaSpecs.map((spec) => spec.rttMs ?? rttMs)) / 2;
  const link = new VirtualLink(events, {
    profile: forwardProfile(scenario, delayMs),
    seed: 2 * seed,
    stalls: stalls(scenario.stalls?.link),
  });
  for (const [fromMs, moreMs] of scenario.delaySteps ?? []) {
    link.model.setProfile({ ...link.model.profile, delayMs: delayMs + moreMs }, fromMs);
  }
  const backLink = new VirtualLink(events, {
    profile: { ...backProfile(scenario), delayMs, loss: scenario.backLoss ?? 0 },
    seed: 2 * seed + 1,
  });
  const loss = {
    process: new PacketLoss(seed),
    model: { loss: scenario.loss ?? 0, burstLoss: scenario.burstLoss ?? null },
  };
  const forwardPath = (ownRttMs: number, receiverStalls: Stalls | null) =>
    new Path(events, { link, moreDelayMs: ownRttMs / 2 - delayMs, loss, receiverStalls });
  const backPath = (ownRttMs: number) =>
    new Path(events, { link: backLink, moreDelayMs: ownRttMs / 2 - delayMs });

  const media = mediaSpecs.map((spec, i) => {
    const { rttMs: ownRttMs = rttMs, ...own } = spec;
    const name = `media ${i + 1}`;
    const receiverStalls = stalls(scenario.stalls?.receiver);
    const paths = { forward: forwardPath(ownRttMs, receiverStalls), back: backPath(ownRttMs) };
    const busy = { senderStalls: stalls(scenario.stalls?.sender), receiverStalls };
    return new MediaFlow(events, random, { name, ...busy, ...own, ...paths, controller: controller() });
  });
  const cubic = cubicSpecs.map(({ reverse, startMs = 0, stopMs, bytes }, i) => {
    const record = new FlowRecord(`cubic ${i + 1}`);
    const flow = new TcpFlow({
      congestionControl: 'cubic',
      startMs,
      ...(stopMs === undefined ? {} : { endMs: stopMs }),
      ...(bytes === undefined ? {} : { bytes }),
      ackDelayMs: rttMs / 2,
    });
    runFlow(events, flow, reverse ? backPath(rttMs) : forwardPath(rttMs, null), record);
    return record;
  });
  events.runUntil(scenario.durationMs);
  return { scenario, media: media.map((flow) => flow.record), cubic };
}

function forwardProfile(scenario: Scenario, delayMs: number): LinkProfile {
  const { capacity, queueMs = 100, queueBytes, queueFollows, jitterMs = 0, tailMs = 0 } = scenario;
  const ofTime = queueFollows ? { ms: queueMs } : queueOf(capacity, queueMs);
  return {
    ...idealProfile,
    capacity: { steps: capacity, periodMs: null },
    queue: queueBytes === undefined ? ofTime : { bytes: queueBytes },
    delayMs,
    jitterMs,
    tailMs,
    reorder: { probability: scenario.reorder ?? 0, extraMs: 10 },
  };
}

function backProfile({ backCapacity, backQueueMs = 100 }: Scenario): LinkProfile {
  if (backCapacity === undefined) return idealProfile;
  const capacity = { steps: backCapacity, periodMs: null };
  return { ...idealProfile, capacity, queue: queueOf(backCapacity, backQueueMs) };
}

/** The number of bits that the scenario's link could carry between two times. */
export function carriedAtMost({ capacity }: Scenario, fromMs: number, toMs: number): number {
  return new CapacitySchedule({ steps: capacity, periodMs: null }, 0).bitsBetween(fromMs, toMs);
}
