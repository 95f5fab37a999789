/** A loudspeaker that plays Opus packets, in a process of its own. It is open from its creation to `close`. */
import { playText, type SoundSinkOptions, soundSinkSchema } from './sound-device.ts';
import { SoundProcess, type SoundProcessEvents, type SoundProcessOptions } from './sound-process.ts';
import { writePlay } from './wire.ts';

/**
 * A process that does not take what it is sent is not waited for: some 100 ms of sound. Chosen: as much as a
 * voice may wait for its turn (voice-buffer.ts).
 */
const MOST_BACKLOG_BYTES = 4096;

export interface LoudspeakerOptions
  extends Omit<SoundProcessEvents, 'onPacket'>,
    Pick<SoundProcessOptions, 'retry' | 'program' | 'env'> {
  readonly sink: SoundSinkOptions;
}

export class Loudspeaker {
  readonly #process: SoundProcess;

  /** @throws {z.ZodError} if the sink is not valid */
  constructor({ sink, ...rest }: LoudspeakerOptions) {
    this.#process = new SoundProcess({
      ...rest,
      role: 'loudspeaker',
      pipeline: playText(soundSinkSchema.parse(sink)),
      silenceMs: 0,
      bitsPerS: 0,
    });
  }

  get pid(): number | undefined {
    return this.#process.pid;
  }

  get starts(): number {
    return this.#process.starts;
  }

  /**
   * @param hearAtMs when it is to be heard, before the device's own delay: CLOCK_MONOTONIC, ms
   * @param bytes an Opus packet; empty for one that was lost and is to be concealed
   * @returns whether it was taken
   */
  play(hearAtMs: number, durationMs: number, bytes: Uint8Array): boolean {
    if (this.#process.backlogBytes > MOST_BACKLOG_BYTES) return false;
    return this.#process.send(writePlay(hearAtMs, durationMs, bytes));
  }

  /** Ends the process; resolves when it is gone. No event comes any more. */
  close(): Promise<void> {
    return this.#process.close();
  }
}
