/** What this operator hears of the robot, and what the robot hears of this operator. */
import { type OperatorSessionMessage, type Sound, SPEAK_REPEAT_MS } from '@farpoint/protocol';
import { openMicrophone, type VoiceMicrophone } from './open-microphone.ts';
import type { SoundLine } from './sound-line.ts';
import { type VoiceFailure, voiceFailure } from './voice-failure.ts';

/** The operator's own voice. */
export interface VoiceStatus {
  /** Whether the operator wants to speak. */
  readonly held: boolean;
  /**
   * Whether the voice is sent. That does not mean that it is heard: see the `voice` of {@link Sound}.
   */
  readonly sending: boolean;
  /** Why the microphone cannot be used; `null` if it can, or was not needed yet. */
  readonly failure: VoiceFailure | null;
}

/** What {@link RobotSound.played} tells. */
export interface PlayedSound {
  /** When it was captured, by the robot's monotonic clock: 1/48000 s, modulo 2³². */
  readonly rtpTimestamp: number;
  /** When it was handed to the output, `performance.now()`. */
  readonly atMs: number;
}

/** What {@link RobotSound} needs of its client. */
export interface RobotSoundPort {
  send(message: OperatorSessionMessage): void;
  /** The voice's status has changed. */
  onVoice(status: VoiceStatus): void;
  /** The robot's microphone can be played. */
  onTrack(track: MediaStreamTrack): void;
}

/**
 * The microphone stays open for so long after the last word, ms: opening it takes a moment. Chosen: pauses
 * within a talk are shorter, and nobody likes a page that keeps the microphone (docs/sound.md).
 */
const KEEP_OPEN_MS = 10_000;

/** {@link RobotClient.sound}. */
export class RobotSound {
  /** What the robot has said last in this session; `null` if it has no sound. */
  latest: Sound | null = null;
  readonly #port: RobotSoundPort;
  readonly #open: () => Promise<VoiceMicrophone>;
  #line: SoundLine | null = null;
  #microphone: VoiceMicrophone | null = null;
  #opening = false;
  #status: VoiceStatus = { held: false, sending: false, failure: null };
  #repeating: ReturnType<typeof setInterval> | undefined;
  #closing: ReturnType<typeof setTimeout> | undefined;

  /** Made by {@link RobotClient}. @param open opens the operator's microphone */
  constructor(port: RobotSoundPort, open: () => Promise<VoiceMicrophone> = openMicrophone) {
    this.#port = port;
    this.#open = open;
  }

  /** The operator's own voice. */
  get voice(): VoiceStatus {
    return this.#status;
  }

  /**
   * Asks for the sound of the robot's microphone, or for none. A new session begins without.
   *
   * @param on whether it is wanted
   */
  listen(on: boolean): void {
    this.#port.send({ type: 'listen', on });
  }

  /**
   * Begins to speak. Call it for a key or a button that the operator holds, and {@link release} when it is let go. The
   * browser asks for permission the first time. Nothing happens if the robot has no loudspeaker.
   */
  press(): void {
    if (this.#status.held || this.#line === null || this.latest?.voice === undefined) return;
    this.#set({ held: true, sending: false, failure: null });
    clearTimeout(this.#closing);
    if (this.#microphone === null) void this.#openMicrophone();
    else this.#send(this.#microphone);
  }

  /** Ceases to speak, at once. Nothing happens if the operator does not speak. */
  release(): void {
    if (!this.#status.held) return;
    const { sending, failure } = this.#status;
    clearInterval(this.#repeating);
    this.#set({ held: false, sending: false, failure });
    if (sending) {
      this.#port.send({ type: 'speak', held: false });
      this.#replace(null);
    }
    if (this.#microphone !== null) this.#closing = setTimeout(() => this.#stop(), KEEP_OPEN_MS);
  }

  /**
   * Which sound of the robot's microphone the browser hands to its output; `null` if there is none, or the browser does
   * not tell.
   */
  played(): PlayedSound | null {
    const [source] = this.#line?.receiver.getSynchronizationSources() ?? [];
    return source === undefined
      ? null
      : { rtpTimestamp: source.rtpTimestamp, atMs: source.timestamp - performance.timeOrigin };
  }

  /** A session begins or has ended. @internal */
  reset(): void {
    this.release();
    this.#stop();
    this.#line = null;
    this.latest = null;
  }

  /** The robot offers its sound. @internal */
  connect(line: SoundLine): void {
    // An ICE restart offers the same line again.
    if (line.track === this.#line?.track) return;
    this.#line = line;
    this.#port.onTrack(line.track);
  }

  async #openMicrophone(): Promise<void> {
    // The operator is still being asked because of an earlier press.
    if (this.#opening) return;
    this.#opening = true;
    try {
      const microphone = await this.#open();
      this.#microphone = microphone;
      if (this.#status.held) this.#send(microphone);
      else this.#closing = setTimeout(() => this.#stop(), KEEP_OPEN_MS);
    } catch (error) {
      this.#set({ ...this.#status, sending: false, failure: voiceFailure(error) });
    } finally {
      this.#opening = false;
    }
  }

  #send({ track }: VoiceMicrophone): void {
    if (this.#line === null) return;
    if (track.readyState === 'ended') {
      // Unplugged since.
      this.#stop();
      void this.#openMicrophone();
      return;
    }
    this.#replace(track);
    const say = () => this.#port.send({ type: 'speak', held: true });
    say();
    this.#repeating = setInterval(say, SPEAK_REPEAT_MS);
    this.#set({ held: true, sending: true, failure: null });
  }

  #replace(track: MediaStreamTrack | null): void {
    if (this.#microphone !== null) this.#microphone.track.enabled = track !== null;
    // Rejected only after the connection was closed.
    this.#line?.sender.replaceTrack(track).catch(() => undefined);
  }

  #stop(): void {
    clearTimeout(this.#closing);
    this.#microphone?.stop();
    this.#microphone = null;
  }

  #set(status: VoiceStatus): void {
    this.#status = status;
    this.#port.onVoice(status);
  }
}
