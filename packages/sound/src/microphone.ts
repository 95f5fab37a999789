/** A microphone, encoded as Opus in a process of its own. It runs from its creation to `close`. */
import * as z from 'zod';
import { captureText, type SoundSourceOptions, soundSourceSchema } from './sound-device.ts';
import { SoundProcess, type SoundProcessEvents, type SoundProcessOptions } from './sound-process.ts';
import type { SoundPacket } from './wire.ts';

/**
 * The lowest and the highest rate of a microphone, bit/s. RFC 7587, 3.1.1: 16 to 20 kbit/s for speech in wide
 * band, 48 to 64 for music in full band, mono.
 */
export const LEAST_SOUND_BITS_PER_S = 16_000;
export const MOST_SOUND_BITS_PER_S = 64_000;
/**
 * A device that gives nothing for so long counts as lost, ms: as a program that says nothing
 * (packages/media-process).
 */
const SILENCE_MS = 5000;

const rateSchema = z.number().min(LEAST_SOUND_BITS_PER_S).max(MOST_SOUND_BITS_PER_S);

export interface MicrophoneOptions
  extends SoundProcessEvents,
    Pick<SoundProcessOptions, 'retry' | 'program' | 'env'> {
  readonly source: SoundSourceOptions;
  /** Of the encoder, {@link LEAST_SOUND_BITS_PER_S} to {@link MOST_SOUND_BITS_PER_S}. */
  readonly bitsPerS: number;
  readonly packetMs?: 10 | 20 | undefined;
  readonly dtx?: boolean | undefined;
  readonly onPacket: (packet: SoundPacket) => void;
}

export class Microphone {
  readonly #process: SoundProcess;

  /** @throws {z.ZodError} if the source or the rate is not valid */
  constructor({ source, bitsPerS, packetMs = 20, dtx = false, ...rest }: MicrophoneOptions) {
    this.#process = new SoundProcess({
      ...rest,
      role: 'microphone',
      pipeline: captureText(soundSourceSchema.parse(source), { packetMs, dtx }),
      // With discontinuous transmission, silence is no fault.
      silenceMs: dtx ? 0 : SILENCE_MS,
      bitsPerS: rateSchema.parse(bitsPerS),
    });
  }

  get pid(): number | undefined {
    return this.#process.pid;
  }

  get starts(): number {
    return this.#process.starts;
  }

  /**
   * Takes effect with the next packet.
   *
   * @throws {z.ZodError} if the rate is not valid
   */
  configure(bitsPerS: number): void {
    this.#process.configure(rateSchema.parse(bitsPerS));
  }

  /** Ends the process; resolves when it is gone. No event comes any more. */
  close(): Promise<void> {
    return this.#process.close();
  }
}
