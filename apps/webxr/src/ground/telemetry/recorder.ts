/**
 * Records the robot's telemetry over time, from the first session on, so that a dashboard that is opened later has the
 * past. Memory is bounded. The records outlive a session, but not a change of the robot or of its clock.
 */
import { bodyYaw } from '@farpoint/cloud-view';
import type { Quantity, RobotClient, Samples, Telemetry } from '@farpoint/operator';
import { Series } from './series.ts';
import { Track } from './track.ts';

/** What describes a series. */
interface SeriesDescription {
  /** Identifies it among the robot's, in every session. */
  readonly key: string;
  /** The robot's name of it; `null` for what comes with the robot's state, which the page names. */
  readonly label: string | null;
  readonly unit: string;
  /** Of a recording that the robot plays. */
  readonly recorded?: boolean | undefined;
}

export interface RecordedSeries extends SeriesDescription {
  readonly series: Series;
  /** The topic's; `null` for what comes with the robot's state. */
  readonly field: string | null;
}

/** By which the robot's own state is recorded. */
export const OWN = {
  speed: { key: 'own speed', label: null, unit: 'm/s' },
  turning: { key: 'own turning', label: null, unit: '°/s' },
  heading: { key: 'own heading', label: null, unit: '°' },
  x: { key: 'own x', label: null, unit: 'm' },
  y: { key: 'own y', label: null, unit: 'm' },
  charge: { key: 'own charge', label: null, unit: '%' },
  voltage: { key: 'own voltage', label: null, unit: 'V' },
} as const satisfies Record<string, SeriesDescription>;
export type OwnSeries = keyof typeof OWN;

/** More than the own series and a robot's quantities: those of a robot that was reconfigured stay for a while. */
const MOST_SERIES = 128;
/**
 * Samples may come late, but not this late: the robot's clock began anew, ms. Chosen: no link that is used
 * delays by so much; a robot that starts again is farther off.
 */
const CLOCK_RESET_MS = 10_000;
/** About 0.1 m on the ground, degrees. */
const FIX_STEP = 1e-6;
const DEGREES = 180 / Math.PI;

export class TelemetryRecorder {
  /** In the order in which they first appeared. */
  readonly series = new Map<string, RecordedSeries>();
  /** In the robot's world, metres. */
  readonly track = new Track();
  /** Longitude and latitude, degrees. */
  readonly fixTrack = new Track(FIX_STEP);
  /** Changes whenever a series is added or all are removed. */
  revision = 0;
  /** When the robot's telemetry last came: page's clock, ms. */
  heardMs = Number.NEGATIVE_INFINITY;
  readonly #byNumber = new Map<number, RecordedSeries>();
  #robotId: string | null = null;
  #newestMs = Number.NEGATIVE_INFINITY;

  /** @param now page's clock, ms */
  constructor(client: Pick<RobotClient, 'on'>, now: () => number) {
    client.on('session', () => this.#byNumber.clear());
    client.on('welcome', ({ robotId }) => {
      if (this.#robotId !== null && robotId !== this.#robotId) this.clear();
      this.#robotId = robotId;
    });
    client.on('quantity', (quantity) => this.#describe(quantity));
    client.on('telemetry', (telemetry) => {
      this.heardMs = now();
      this.#take(telemetry);
    });
    client.on('samples', (samples) => this.#sample(samples));
  }

  /** When the newest state was measured, robot's clock, ms. */
  get newestMs(): number {
    return this.#newestMs;
  }

  /** The series of a field of a topic's messages, e.g. `latitude`; `null` without one. */
  ofField(field: string, unit: string): RecordedSeries | null {
    for (const each of this.series.values()) if (each.field === field && each.unit === unit) return each;
    return null;
  }

  /** The charge of the battery: from the battery's own topic, which says when it was measured, where there is one. */
  get charge(): RecordedSeries | null {
    return this.ofField('percentage', '%') ?? this.series.get(OWN.charge.key) ?? null;
  }

  get voltage(): RecordedSeries | null {
    return this.ofField('voltage', 'V') ?? this.series.get(OWN.voltage.key) ?? null;
  }

  clear(): void {
    this.series.clear();
    this.#byNumber.clear();
    this.track.clear();
    this.fixTrack.clear();
    this.#newestMs = Number.NEGATIVE_INFINITY;
    this.revision++;
  }

  #describe({ number, topic, field, label, unit, recorded }: Quantity): void {
    // A robot that plays a recording may measure the same quantity itself.
    const played = { key: `${topic} ${field} recorded`, label, unit, recorded: true };
    const described = recorded === true ? played : { key: `${topic} ${field}`, label, unit };
    const series = this.#open(described, field);
    if (series !== null) this.#byNumber.set(number, series);
  }

  #take({ timeMs, ageMs = 0, pose, twist, battery }: Telemetry): void {
    const measuredMs = timeMs - ageMs;
    if (measuredMs < this.#newestMs - CLOCK_RESET_MS && ageMs < CLOCK_RESET_MS) this.#onClockReset();
    this.#newestMs = Math.max(this.#newestMs, measuredMs);
    const { x, y } = twist.linear;
    // Backwards is negative; a robot that moves sideways, too, has the length of its velocity.
    const speed = Math.abs(y) < 1e-3 ? x : Math.hypot(x, y);
    this.#add(OWN.speed, measuredMs, speed);
    this.#add(OWN.turning, measuredMs, twist.angular.z * DEGREES);
    this.#add(OWN.heading, measuredMs, bodyYaw(pose.orientation) * DEGREES);
    this.#add(OWN.x, measuredMs, pose.position.x);
    this.#add(OWN.y, measuredMs, pose.position.y);
    this.track.add(pose.position.x, pose.position.y);
    if (battery === undefined || this.ofField('percentage', '%') !== null) return;
    const { percentage, voltage } = battery;
    if (percentage !== undefined) this.#add(OWN.charge, timeMs, percentage * 100);
    if (voltage !== undefined) this.#add(OWN.voltage, timeMs, voltage);
  }

  #sample({ timeMs, samples }: Samples): void {
    const fix = { longitude: Number.NaN, latitude: Number.NaN };
    for (const [number, offsetMs, value] of samples) {
      const recorded = this.#byNumber.get(number);
      if (recorded === undefined) continue;
      recorded.series.add(timeMs + offsetMs, value);
      if (recorded.unit !== '°') continue;
      if (recorded.field === 'longitude') fix.longitude = value;
      if (recorded.field === 'latitude') fix.latitude = value;
    }
    if (Number.isFinite(fix.longitude + fix.latitude)) this.fixTrack.add(fix.longitude, fix.latitude);
  }

  #add(description: SeriesDescription, timeMs: number, value: number): void {
    this.#open(description, null)?.series.add(timeMs, value);
  }

  #open(description: SeriesDescription, field: string | null): RecordedSeries | null {
    const there = this.series.get(description.key);
    if (there !== undefined && there.label === description.label && there.unit === description.unit)
      return there;
    if (there === undefined && this.series.size >= MOST_SERIES) return null;
    const made: RecordedSeries = { ...description, field, series: there?.series ?? new Series() };
    this.series.set(description.key, made);
    this.revision++;
    return made;
  }

  /** The robot's computer was restarted: its times cannot be compared with the earlier ones. */
  #onClockReset(): void {
    for (const { series } of this.series.values()) series.clear();
    this.track.clear();
    this.fixTrack.clear();
    this.#newestMs = Number.NEGATIVE_INFINITY;
  }
}
