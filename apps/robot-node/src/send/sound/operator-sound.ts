import { SOUND_MEDIA, type Sound } from '@farpoint/protocol';
import { LEAST_SOUND_BITS_PER_S } from '@farpoint/sound';
import {
  SOUND_STREAM,
  type SoundFrame,
  soundRateWithin,
  soundWireRate,
} from '../../sense/sound/sound-frame.ts';
import type { PathBudget } from '../budgets/path-budget.ts';
import type { SoundLine } from '../transport/peer-events.ts';
import type { StreamSender } from '../transport/stream-sender.ts';
import type { VoicePacket } from '../transport/voice-packet.ts';
import { REPORT_MS } from '../video/operator-videos.ts';
import { VoiceGate } from './voice-gate.ts';

/**
 * Sound that was switched off for want of room comes back with so much more room than it needs. It returns
 * with room for 20 kbit/s instead of 16.
 */
const ROOM_TO_RETURN = 1.25;
/**
 * After the voice has closed, it is still heard at the robot for so long, ms: the jitter buffer and the
 * device. Those may take 100 and 40 ms (docs/sound.md).
 */
const TAIL_MS = 200;

/** One operator's sound: what it hears, and what it says. Before it has connected, there is neither. */
export class OperatorSound {
  /** Whether it wants to hear the microphone. */
  listening = false;
  readonly gate = new VoiceGate();
  /** Called for each packet of the operator's voice while it holds the key. */
  onVoice: ((packet: VoicePacket) => void) | null = null;
  /** Called when the operator begins or ceases to listen. */
  onListening: ((on: boolean) => void) | null = null;
  readonly #budget: PathBudget;
  readonly #now: () => number;
  #connected: { sender: StreamSender; line: SoundLine } | null = null;
  #hasRoom = true;
  #mutedUntilMs = Number.NEGATIVE_INFINITY;
  #reportedMs = Number.NEGATIVE_INFINITY;
  #told = '';

  constructor(budget: PathBudget, now: () => number) {
    this.#budget = budget;
    this.#now = now;
  }

  get line(): SoundLine | null {
    return this.#connected?.line ?? null;
  }

  /** Whether it listens and can be sent sound. */
  get hears(): boolean {
    return this.listening && this.#hasRoom && this.line?.transport != null;
  }

  get hasRoom(): boolean {
    return this.#hasRoom;
  }

  get muted(): boolean {
    return this.#now() < this.#mutedUntilMs;
  }

  /** What the encoder may take of this operator's path, bit/s. */
  get room(): number {
    const target = this.#connected?.sender.targetBitsPerSecond ?? 0;
    return soundRateWithin(this.#budget.soundBitsPerSecond(target));
  }

  connect(sender: StreamSender, line: SoundLine | null): void {
    if (line === null) return;
    if (line.transport !== null) sender.addStream(SOUND_STREAM, line.transport);
    this.#connected = { sender, line };
  }

  disconnect(): void {
    this.listen(false);
    this.speak(false);
    this.#connected = null;
  }

  listen(on: boolean): void {
    if (on === this.listening || (on && this.#connected === null)) return;
    this.listening = on;
    this.onListening?.(on);
  }

  speak(held: boolean): void {
    this.gate.hold(held, this.#now());
    const voice = this.line?.voice;
    // Nothing is decrypted that nobody has announced.
    if (voice != null) voice.onPacket = held ? (packet) => this.onVoice?.(packet) : null;
  }

  /** The operator's voice is being played: it would hear itself. */
  mute(): void {
    this.#mutedUntilMs = this.#now() + TAIL_MS;
  }

  offer(frame: SoundFrame): void {
    if (this.hears && !this.muted) this.#connected?.sender.enqueue(frame);
  }

  /** @param bitsPerSecond what the encoder is set to; 0 while it is off */
  update(bitsPerSecond: number, nowMs: number): void {
    const needed = this.#hasRoom ? LEAST_SOUND_BITS_PER_S : LEAST_SOUND_BITS_PER_S * ROOM_TO_RETURN;
    this.#hasRoom = this.#connected === null || this.room >= needed;
    this.#budget.takeSound(this.hears && bitsPerSecond > 0 ? soundWireRate(bitsPerSecond) : 0);
    if (!this.gate.isHeld(nowMs)) this.speak(false);
    if (!this.hears || nowMs - this.#reportedMs < REPORT_MS) return;
    this.#reportedMs = nowMs;
    this.line?.transport?.sendReport(nowMs, SOUND_MEDIA.clockRate);
  }

  /** @returns whether the operator has not been told the same before */
  isNews(message: Sound): boolean {
    const text = JSON.stringify(message);
    if (text === this.#told) return false;
    this.#told = text;
    return true;
  }
}
