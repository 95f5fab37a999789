import type { Logger } from '@farpoint/service';
import { LEAST_SOUND_BITS_PER_S } from '@farpoint/sound';
import type { OpenMicrophone, SoundDevices } from './sound-devices.ts';
import { SoundFrame } from './sound-frame.ts';

export interface MicrophoneHubOptions {
  devices: Pick<SoundDevices, 'microphone' | 'mostBitsPerSecond'>;
  onFrame: (frame: SoundFrame) => void;
  log: Pick<Logger, 'info' | 'warn'>;
}

/**
 * Smaller changes of the bit rate are not worth telling the encoder. Chosen: 2 to 6 kbit/s are not heard, and
 * each change is a message to its process.
 */
const RATE_STEP = 0.1;

/** The robot's microphone. It runs while somebody listens, and is encoded once for all who do. */
export class MicrophoneHub {
  readonly counters = { packets: 0, bytes: 0 };
  /** Why there is no sound; `null` while there is, or nobody listens. */
  fault: string | null = null;
  /** Whether sound has come since it was opened. */
  live = false;
  /** What the encoder is set to, bit/s; 0 while nobody listens. */
  bitsPerSecond = 0;
  readonly #options: MicrophoneHubOptions;
  #open: OpenMicrophone | null = null;

  constructor(options: MicrophoneHubOptions) {
    this.#options = options;
  }

  /**
   * Opens, closes or sets the microphone.
   *
   * @param room what the encoder may take for those who listen, bit/s; `null` if nobody does
   */
  plan(room: number | null): void {
    const { microphone, mostBitsPerSecond } = this.#options.devices;
    if (microphone === null) return;
    if (room === null) {
      void this.close();
      return;
    }
    const wanted = Math.max(LEAST_SOUND_BITS_PER_S, Math.min(room, mostBitsPerSecond));
    if (this.#open === null) this.#start(microphone, wanted);
    else if (Math.abs(wanted - this.bitsPerSecond) > this.bitsPerSecond * RATE_STEP) {
      this.bitsPerSecond = wanted;
      this.#open.configure(wanted);
    }
  }

  async close(): Promise<void> {
    const open = this.#open;
    if (open === null) return;
    this.#open = null;
    this.live = false;
    this.fault = null;
    this.bitsPerSecond = 0;
    this.#options.log.info('the microphone is off: nobody listens');
    await open.close();
  }

  #start(microphone: NonNullable<SoundDevices['microphone']>, bitsPerSecond: number): void {
    const { log, onFrame } = this.#options;
    log.info('the microphone is on');
    this.bitsPerSecond = bitsPerSecond;
    const open = microphone(bitsPerSecond, {
      onPacket: (packet) => {
        if (this.#open !== open) return;
        if (this.fault !== null) log.info('the microphone is back');
        this.fault = null;
        this.live = true;
        this.counters.packets++;
        this.counters.bytes += packet.bytes.length;
        onFrame(new SoundFrame(packet));
      },
      onFault: (fault) => {
        if (this.#open !== open) return;
        if (fault !== this.fault) log.warn({ detail: fault }, 'the microphone has failed');
        this.fault = fault;
        this.live = false;
      },
    });
    this.#open = open;
  }
}
