/** The stops at the robot itself: each holds the emergency stop until it says go. */

import { READING_LIMITS, type RobotStop } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';
import type { DriveGuard, RobotStopState } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import { monotonicMs } from '../../ground/clock.ts';
import { LimitedLines } from '../../ground/limited-lines.ts';
import { openStops, type RobotStopsOptions } from './open-stops.ts';
import type { StopSource } from './stop-source.ts';

/** For people. */
export const stopWords: Readonly<Record<RobotStopState, string>> = {
  go: 'released',
  pressed: 'pressed',
  unheard: 'has said nothing yet',
  silent: 'says nothing any more',
  lost: 'cannot be read',
  settling: 'released a moment ago',
};

const labels: Readonly<Record<RobotStop, string>> = {
  topic: 'Stop (topic)',
  shm: 'Stop (shared memory)',
  gpio: 'Stop (GPIO)',
  key: 'Stop (console)',
};

/** Whether a stop in this state works: it says what it should, be it go or stop. */
export function isWell(state: RobotStopState): boolean {
  return state === 'go' || state === 'pressed' || state === 'settling';
}

/** What people should know about a stop at the robot. */
export function stopReading(stop: RobotStop, name: string, state: RobotStopState): TopicReading {
  const level = state === 'go' ? 'ok' : isWell(state) ? 'warn' : 'error';
  const words = stopWords[state];
  const text = `${name}: ${words}`;
  const fits = text.length <= READING_LIMITS.text;
  return { topic: `stop:${stop}`, label: labels[stop], level, values: [['', fits ? text : words]] };
}

/**
 * Between two looks at every stop, ms: a stop counts within this time (docs/robot-stops.md). Chosen: a
 * centimetre at 1 m/s, for 100 cheap looks a second.
 */
const LOOK_MS = 10;

/** What the stops change. */
export interface StopsPort {
  readonly guard: DriveGuard;
  /** A stop holds the emergency stop now, or no longer. Apply the velocity, and tell everybody. */
  changed(stop: RobotStop, state: RobotStopState): void;
  /** Takes what people should know. */
  tell(reading: TopicReading): void;
  readonly log: Pick<Logger, 'info' | 'warn'>;
  now(): number;
}

export class RobotStops {
  readonly #sources: readonly StopSource[];
  readonly #port: StopsPort;
  readonly #states = new Map<RobotStop, RobotStopState>();
  readonly #lines = new LimitedLines();
  readonly #looking: NodeJS.Timeout | null;
  /** How often each has stopped the robot. */
  readonly #pressed = new Map<RobotStop, number>();
  #closed = false;

  /** Every stop that does not say go holds the emergency stop when this returns. */
  constructor(sources: readonly StopSource[], port: StopsPort) {
    this.#sources = sources;
    this.#port = port;
    for (const source of sources) {
      source.onChange = () => this.#look(source);
      this.#look(source);
    }
    this.#looking = sources.length === 0 ? null : setInterval(() => this.#lookAtAll(), LOOK_MS);
  }

  /** What each says, by its kind. */
  get states(): ReadonlyMap<RobotStop, RobotStopState> {
    return this.#states;
  }

  /** How often each has stopped the robot, since the start. */
  get stopped(): ReadonlyMap<RobotStop, number> {
    return this.#pressed;
  }

  /** Whether each can be read. */
  get areWell(): boolean {
    return [...this.#states.values()].every(isWell);
  }

  async close(): Promise<void> {
    this.#closed = true;
    if (this.#looking !== null) clearInterval(this.#looking);
    for (const source of this.#sources) await source.close();
  }

  #lookAtAll(): void {
    for (const source of this.#sources) this.#look(source);
  }

  #look(source: StopSource): void {
    if (this.#closed) return;
    const { stop, name } = source;
    const { guard } = this.#port;
    const now = this.#port.now();
    const state = source.look(now);
    // The wheels first.
    const changed = state === 'go' ? guard.letGoEstop(stop) : guard.holdEstop(stop);
    if (changed) {
      if (state !== 'go') this.#pressed.set(stop, (this.#pressed.get(stop) ?? 0) + 1);
      this.#port.changed(stop, state);
    }
    const before = this.#states.get(stop);
    if (before === state) return;
    this.#states.set(stop, state);
    this.#port.tell(stopReading(stop, name, state));
    // One that says go from the start has not been released.
    if (before !== undefined || state !== 'go') this.#log(source, state, now);
  }

  #log({ stop, name, fault }: StopSource, state: RobotStopState, now: number): void {
    const leftOut = this.#lines.take(now);
    if (leftOut === null) return;
    const entry = {
      stop,
      source: name,
      state,
      ...(fault === null ? {} : { fault }),
      ...(leftOut === 0 ? {} : { unreported: leftOut }),
    };
    if (state === 'go') this.#port.log.info(entry, 'a stop at the robot was released');
    else this.#port.log.warn(entry, 'a stop at the robot holds the emergency stop');
  }
}

/** Opens the stops that are configured. @param remembered those that held the emergency stop when the robot last ran */
export function startStops(
  options: RobotStopsOptions,
  host: { drive: Pick<StopsPort, 'guard'>; robotStopChanged: StopsPort['changed'] },
  remembered: readonly RobotStop[],
  tell: StopsPort['tell'],
  log: Logger,
): RobotStops {
  return new RobotStops(openStops(options, remembered, log), {
    guard: host.drive.guard,
    changed: (stop, state) => host.robotStopChanged(stop, state),
    tell,
    log,
    now: monotonicMs,
  });
}
