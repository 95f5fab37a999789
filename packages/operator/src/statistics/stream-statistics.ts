/** Statistics of the stream, from the network to the display. Time is an argument. */

import type { ClockOffset, StageTimes } from '@farpoint/protocol';
import { BitRate, RateMeter } from '@farpoint/timing';
import type { Batch } from '../cloud/batch.ts';
import type { DropCounts } from '../cloud/packet-intake.ts';
import type { IntakeReport } from '../cloud/worker-messages.ts';
import { CommandStages } from '../latency/command-stages.ts';
import type { AgeOfStamp } from '../latency/frame-latency.ts';
import type { FrameStages } from '../latency/frame-stages.ts';
import type { LatencyResult } from '../latency/latency-test.ts';
import { type Distribution, SampleWindow } from '../latency/sample-window.ts';
import { SensorStatistics, type SensorStats } from './sensor-statistics.ts';

/** Statistics of the stream. Times are in ms, rates per second. */
export interface StreamStats {
  /** Packets that arrived since the session began. */
  packetsReceived: number;
  /** Packets that were lost since the session began. */
  packetsLost: number;
  /** Bytes that arrived since the session began. */
  bytesReceived: number;
  /** Packets that arrived and were not decoded since the session began, by reason. */
  drops: DropCounts;
  /** Rate of arrival over the last second. */
  bitsPerSecond: number;
  /** Share of packets lost over the last seconds, 0–1. */
  lossRate: number;
  /** Round trip of the latest clock probe; `null` before the first answer. */
  rttMs: number | null;
  /** Shortest round trip among the last clock probes; `null` before the first answer. */
  minRttMs: number | null;
  /** Capture to the worker, each packet of the first sensor. */
  deliveryMs: Distribution | null;
  /** Capture to the end of the display frame with the frame's last points, first sensor. */
  frameLatencyMs: Distribution | null;
  /** Motion to photon: until the whole green cloud was drawn. */
  mtpMs: Distribution | null;
  /** Motion to photon: until the first points of the green cloud were drawn. */
  mtpFirstMs: Distribution | null;
  /** Mean time that the worker spent on a packet, µs. */
  decodeUs: number;
  /** What was drawn of each sensor, by number. */
  sensors: SensorStats[];
}

/** Latency tests that are kept. Chosen: a benchmark makes some hundred. */
const MAX_RESULTS = 1000;
/** Time over which loss is counted, ms. Chosen: at 100 packets a second, one lost one is 0.3 %. */
const LOSS_WINDOW_MS = 3000;

/** Counts and measures the stream, from the network to the display. {@link RobotClient} makes one and calls it. */
export class StreamStatistics {
  /** Where the time of each command goes. */
  readonly commands: CommandStages;
  readonly #ageOf: AgeOfStamp;
  readonly #delivery = new SampleWindow(8192);
  readonly #mtp = new SampleWindow(MAX_RESULTS);
  readonly #mtpFirst = new SampleWindow(MAX_RESULTS);
  readonly #bytes = new RateMeter();
  readonly #lost = new RateMeter(LOSS_WINDOW_MS);
  readonly #received = new RateMeter(LOSS_WINDOW_MS);
  /** Indexed by sensor number; created at a sensor's first packet. */
  readonly #sensors: SensorStatistics[] = [];
  #report: IntakeReport | null = null;
  /** The latest latency tests. */
  readonly results: LatencyResult[] = [];

  /** @param ageOf the age of a timestamp of the robot's clock, ms */
  constructor(ageOf: AgeOfStamp) {
    this.#ageOf = ageOf;
    this.commands = new CommandStages(ageOf);
  }

  /** A new session. */
  reset(): void {
    this.#report = null;
    for (const meter of [this.#bytes, this.#lost, this.#received]) meter.reset();
    this.#delivery.clear();
    this.#sensors.length = 0;
    this.commands.clear();
  }

  /** Restarts the latency distributions. */
  resetDistributions(): void {
    this.#delivery.clear();
    for (const sensor of this.#sensors) sensor.resetDistribution();
    this.#mtp.clear();
    this.#mtpFirst.clear();
  }

  /** The cloud worker reported its totals. */
  onReport(report: IntakeReport): void {
    this.#report = report;
  }

  /**
   * A packet's points were uploaded for the display frame being prepared.
   *
   * @param packet index in the batch
   * @param nowMs `performance.now()`
   */
  onUploaded(batch: Batch, packet: number, nowMs: number): void {
    const receivedMs = batch.receivedAtMs(packet) - performance.timeOrigin;
    this.#sensor(batch.sensor).onUploaded(batch, packet, receivedMs, nowMs);
    if (batch.sensor !== 0) return;
    const age = this.#ageOf(batch.captureTimeUs(packet), receivedMs);
    if (age !== null) this.#delivery.add(age);
  }

  /**
   * The display frame is finished.
   *
   * @param nowMs `performance.now()`
   */
  onDrawn(nowMs: number): void {
    for (const sensor of this.#sensors) sensor.onDrawn(nowMs);
  }

  /** The robot has told when frames and commands passed its stations. @param nowMs `performance.now()` */
  onStages({ frames, commands }: StageTimes, nowMs: number): void {
    for (const times of frames) this.#sensor(times[0]).stages.onTimes(times);
    for (const times of commands) this.commands.onTimes(times, nowMs);
  }

  /** Where the time of each frame of a sensor goes; `null` before its first. Of a new session it is another. */
  frameStages(sensor = 0): FrameStages | null {
    return this.#sensors[sensor]?.stages ?? null;
  }

  /** A latency test ended. */
  onResult(result: LatencyResult): void {
    this.#mtp.add(result.mtpMs);
    this.#mtpFirst.add(result.firstMs);
    this.results.push(result);
    if (this.results.length > MAX_RESULTS) this.results.shift();
  }

  /**
   * Updates the rates. Call it a few times a second.
   *
   * @param nowMs `performance.now()`
   */
  update(nowMs: number): void {
    this.#bytes.update(this.#report?.bytesReceived ?? 0, nowMs);
    this.#lost.update(this.#report?.packetsLost ?? 0, nowMs);
    this.#received.update(this.#report?.packetsReceived ?? 0, nowMs);
  }

  /**
   * All statistics as they are now.
   *
   * @param clock knows the round trips
   */
  snapshot(clock: Pick<ClockOffset, 'lastRttMs' | 'minRttMs'>): StreamStats {
    const lost = this.#lost.perSecond;
    const sent = lost + this.#received.perSecond;
    return {
      packetsReceived: this.#report?.packetsReceived ?? 0,
      packetsLost: this.#report?.packetsLost ?? 0,
      bytesReceived: this.#report?.bytesReceived ?? 0,
      drops: { ...this.#report?.drops },
      bitsPerSecond: BitRate.fromBytesPerSecond(this.#bytes.perSecond),
      lossRate: sent > 0 ? lost / sent : 0,
      rttMs: clock.lastRttMs,
      minRttMs: clock.minRttMs,
      deliveryMs: this.#delivery.distribution(),
      frameLatencyMs: this.#sensors[0]?.frameLatencyMs ?? null,
      mtpMs: this.#mtp.distribution(),
      mtpFirstMs: this.#mtpFirst.distribution(),
      decodeUs: this.#report?.decodeUs ?? 0,
      sensors: this.#sensors.map((sensor, number) => sensor.snapshot(number)),
    };
  }

  /** Leaves no gaps: every sensor up to the highest number has statistics. */
  #sensor(number: number): SensorStatistics {
    while (this.#sensors.length <= number) this.#sensors.push(new SensorStatistics(this.#ageOf));
    return this.#sensors[number] as SensorStatistics;
  }
}
