import type { Logger } from '@farpoint/service';
import { VoiceBuffer } from '@farpoint/sound';
import type { OpenLoudspeaker, SoundDevices } from '../../sense/sound/sound-devices.ts';
import type { VoicePacket } from '../transport/voice-packet.ts';

export interface LoudspeakerStationOptions {
  loudspeaker: NonNullable<SoundDevices['loudspeaker']>;
  log: Pick<Logger, 'info' | 'warn'>;
  /** Robot's clock, ms. */
  now: () => number;
}

/** The robot's loudspeaker. It is open while somebody drives, and plays that operator's voice. */
export class LoudspeakerStation {
  readonly counters = { played: 0, concealed: 0, refused: 0 };
  /** Why it cannot be played to; `null` if it can, or is closed. */
  fault: string | null = null;
  readonly #options: LoudspeakerStationOptions;
  #buffer = new VoiceBuffer();
  #speaker: string | null = null;
  #open: OpenLoudspeaker | null = null;
  #timer: NodeJS.Timeout | null = null;

  constructor(options: LoudspeakerStationOptions) {
    this.#options = options;
  }

  /** Packets that were not played, by reason. */
  get drops() {
    return this.#buffer.drops;
  }

  /** Opens or closes it. */
  plan(wanted: boolean): void {
    if (wanted === (this.#open !== null)) return;
    if (wanted) this.#start();
    else void this.close();
  }

  /** @param speaker the operator's id */
  push(speaker: string, { sequence, timestamp, payload }: VoicePacket): void {
    if (speaker !== this.#speaker) this.#buffer.clear();
    this.#speaker = speaker;
    this.#buffer.push(sequence, timestamp, payload, this.#options.now());
    this.#play();
  }

  /** What waits is not played any more. */
  stop(): void {
    this.#buffer.clear();
    this.#speaker = null;
  }

  async close(): Promise<void> {
    this.stop();
    if (this.#timer !== null) clearTimeout(this.#timer);
    this.#timer = null;
    const open = this.#open;
    this.#open = null;
    this.fault = null;
    await open?.close();
  }

  #start(): void {
    const { loudspeaker, log } = this.#options;
    const open = loudspeaker({
      onStarted: () => {
        if (this.#open !== null && this.#open !== open) return;
        if (this.fault !== null) log.info('the loudspeaker is back');
        this.fault = null;
      },
      onFault: (fault) => {
        if (this.#open !== open) return;
        if (fault !== this.fault) log.warn({ detail: fault }, 'the loudspeaker has failed');
        this.fault = fault;
      },
    });
    this.#open = open;
  }

  /** Plays what is due, and comes back when more is due without another packet. */
  #play(): void {
    const { now } = this.#options;
    if (this.#timer !== null) clearTimeout(this.#timer);
    this.#timer = null;
    const nowMs = now();
    for (let next = this.#buffer.take(nowMs); next !== null; next = this.#buffer.take(nowMs)) {
      const { hearAtMs, durationMs, bytes } = next;
      const taken = this.#open?.play(hearAtMs, durationMs, bytes) ?? false;
      if (!taken) this.counters.refused++;
      else if (bytes.length === 0) this.counters.concealed++;
      else this.counters.played++;
    }
    const dueMs = this.#buffer.nextDueMs;
    if (dueMs !== null) this.#timer = setTimeout(() => this.#play(), Math.max(1, Math.ceil(dueMs - nowMs)));
  }
}
