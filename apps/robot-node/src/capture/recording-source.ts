import { setTimeout as delay } from 'node:timers/promises';
import { CloudPlayer, type PlayClock, type PlayOptions } from '@farpoint/recording';
import type {
  CaptureRoom,
  CaptureWishes,
  FrameSource,
  SourceDescription,
  SourceFrame,
  SourceState,
} from './frame-source.ts';

export type RecordingSourceOptions = PlayOptions;

/** Plays a recording's clouds at their times. It has no wheels: velocities change nothing. */
export class RecordingSource implements FrameSource {
  readonly description: SourceDescription;
  onReady: (() => void) | null = null;
  onFault: ((error: Error) => void) | null = null;
  readonly #player: CloudPlayer;

  private constructor(player: CloudPlayer) {
    const { topic, axes, width, height, capacity, framesPerSecond } = player.stream;
    this.#player = player;
    this.description = {
      kind: `recording (${topic.name}, ${axes} frame, ${player.seconds.toFixed(1)} s)`,
      ...{ width, height, capacity },
      camera: null,
      depthMeasure: axes === 'body' ? 'range' : 'z',
      drives: false,
      ...(framesPerSecond === null ? {} : { framesPerSecond }),
    };
    player.onCloud = () => this.onReady?.();
    player.onFault = (error) => this.onFault?.(error);
  }

  /** @throws {RecordingError} saying what cannot be read, and where */
  static async open(options: RecordingSourceOptions, now: () => number): Promise<RecordingSource> {
    const source = new RecordingSource(await CloudPlayer.open(options, playClock(now)));
    // What it finds is told as faults, once somebody listens.
    setImmediate(() => {
      const { warning } = source.#player;
      if (warning !== null) source.onFault?.(new Error(warning));
      void source.#player.run();
    });
    return source;
  }

  get state(): SourceState {
    const { pose, twist, battery } = this.#player;
    return { pose, twist, battery, contact: false };
  }

  advance(): void {}

  capture(nowMs: number, _wishes: CaptureWishes, { points }: CaptureRoom): SourceFrame | null {
    const cloud = this.#player.take(points);
    if (cloud === null) return null;
    return { form: 'points', points, ...cloud, captureMs: nowMs };
  }

  skip(): void {
    this.#player.skip();
  }

  close(): void {
    void this.#player.close();
  }
}

function playClock(now: () => number): PlayClock {
  return {
    now,
    wait: async (ms, signal) => {
      // An abort ends the wait: whoever waits looks at the signal.
      await delay(ms, undefined, { signal }).catch(() => {});
    },
  };
}
