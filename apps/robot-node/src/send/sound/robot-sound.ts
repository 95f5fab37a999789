import type { Sound } from '@farpoint/protocol';
import type { Logger } from '@farpoint/service';
import { MicrophoneHub } from '../../sense/sound/microphone-hub.ts';
import type { SoundDevices } from '../../sense/sound/sound-devices.ts';
import { LoudspeakerStation } from './loudspeaker-station.ts';
import type { OperatorSound } from './operator-sound.ts';

/** An operator who may listen and speak. */
export interface SoundTarget {
  /** The operator's id, as known to the guard. */
  readonly id: string;
  /** For the log. */
  readonly operatorName: string;
  readonly streaming: boolean;
  readonly sound: OperatorSound;
  tellSound(message: Sound): void;
}

export interface RobotSoundOptions {
  devices: SoundDevices;
  targets: () => Iterable<SoundTarget>;
  /** The operator who drives; `null` if nobody does. */
  driver: () => string | null;
  /** Sends what is due. */
  onFrame: () => void;
  log: Logger;
  /** Robot's clock, ms. */
  now: () => number;
}

/** Characters of a detail, which the message bounds (packages/protocol). */
const MOST_DETAIL = 256;

/**
 * The robot's sound: its microphone for all who listen, and its loudspeaker for the voice of the operator who drives.
 * Whoever stands beside the robot then hears the person who answers for its movements, and nobody else.
 */
export class RobotSound {
  readonly microphone: MicrophoneHub;
  /** `null` if the robot has none. */
  readonly loudspeaker: LoudspeakerStation | null;
  readonly #options: RobotSoundOptions;
  #speaking: string | null = null;

  constructor(options: RobotSoundOptions) {
    this.#options = options;
    const { devices, log, now, targets, onFrame } = options;
    this.microphone = new MicrophoneHub({
      devices,
      log,
      onFrame: (frame) => {
        for (const { streaming, sound } of targets()) if (streaming) sound.offer(frame);
        onFrame();
      },
    });
    const { loudspeaker } = devices;
    this.loudspeaker = loudspeaker === null ? null : new LoudspeakerStation({ loudspeaker, log, now });
  }

  get hasMicrophone(): boolean {
    return this.#options.devices.microphone !== null;
  }

  /** How many operators are sent the microphone's sound. */
  get listeners(): number {
    return [...this.#options.targets()].filter((target) => isHearing(target)).length;
  }

  /** Whose voice is being played; `null` if nobody's. */
  get speaking(): string | null {
    return this.#speaking;
  }

  /** An operator has connected. */
  welcome(target: SoundTarget): void {
    const { sound, operatorName } = target;
    const { log } = this.#options;
    sound.onListening = (on) =>
      log.info({ operator: operatorName }, on ? 'an operator listens' : 'an operator no longer listens');
    sound.onVoice = (packet) => {
      const { loudspeaker } = this;
      const drives = this.#drives(target);
      if (
        loudspeaker === null ||
        loudspeaker.fault !== null ||
        !sound.gate.packet(drives, this.#options.now())
      )
        return;
      if (this.#speaking !== target.id) log.info({ operator: operatorName }, 'an operator speaks');
      this.#speaking = target.id;
      sound.mute();
      loudspeaker.push(target.id, packet);
    };
  }

  /** Plans the devices, and tells each operator what has changed. Call often. */
  update(): void {
    const nowMs = this.#options.now();
    const targets = [...this.#options.targets()];
    for (const { sound } of targets) sound.update(this.microphone.bitsPerSecond, nowMs);
    const hearing = targets.filter((target) => isHearing(target));
    this.microphone.plan(hearing.length === 0 ? null : Math.min(...hearing.map(({ sound }) => sound.room)));
    this.loudspeaker?.plan(targets.some((target) => this.#drives(target)));
    const speaker = targets.find(({ id }) => id === this.#speaking);
    if (this.#speaking !== null && speaker?.sound.gate.state(this.#drives(speaker), nowMs) !== 'open') {
      this.#speaking = null;
      this.loudspeaker?.stop();
    }
    for (const target of targets) {
      const message = this.#message(target, nowMs);
      if (message !== null && target.sound.isNews(message)) target.tellSound(message);
    }
  }

  async close(): Promise<void> {
    await Promise.all([this.microphone.close(), this.loudspeaker?.close()]);
  }

  #drives({ id }: SoundTarget): boolean {
    return this.#options.driver() === id;
  }

  #message(target: SoundTarget, nowMs: number): Sound | null {
    const { line } = target.sound;
    if (line === null) return null;
    const microphone = this.hasMicrophone ? { microphone: this.#microphoneOf(target) } : {};
    const voice = this.loudspeaker === null ? {} : { voice: this.#voiceOf(target, this.loudspeaker, nowMs) };
    return { type: 'sound', mid: line.mid, ...microphone, ...voice };
  }

  #microphoneOf({ sound }: SoundTarget): NonNullable<Sound['microphone']> {
    const { fault, live } = this.microphone;
    if (sound.line?.transport == null) return { state: 'failed', detail: 'this client takes no Opus' };
    if (!sound.listening) return { state: 'off' };
    if (!sound.hasRoom) return { state: 'slow-link', detail: 'the connection is too slow for sound' };
    if (fault !== null) return { state: 'failed', detail: fault.slice(0, MOST_DETAIL) };
    if (!live) return { state: 'starting' };
    return { state: sound.muted ? 'muted' : 'live' };
  }

  #voiceOf(target: SoundTarget, { fault }: LoudspeakerStation, nowMs: number): NonNullable<Sound['voice']> {
    const state = target.sound.gate.state(this.#drives(target), nowMs);
    if (state === 'not-driving') return { state, detail: 'only the operator who drives is heard' };
    if (fault !== null) return { state: 'failed', detail: fault.slice(0, MOST_DETAIL) };
    return { state };
  }
}

function isHearing({ streaming, sound }: SoundTarget): boolean {
  return streaming && sound.hears;
}
