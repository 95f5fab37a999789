/** The interface between the robot's sound and the processes that capture and play it. */
import type { SoundPacket } from '@farpoint/sound';

export interface MicrophoneEvents {
  onPacket(packet: SoundPacket): void;
  /** @param fault why there is no sound, for people */
  onFault(fault: string): void;
}

export interface OpenMicrophone {
  /** @param bitsPerSecond of the encoder; takes effect with the next packet */
  configure(bitsPerSecond: number): void;
  close(): Promise<void>;
}

export interface LoudspeakerEvents {
  /** It can be played to. */
  onStarted(): void;
  /** @param fault why it cannot be played to, for people */
  onFault(fault: string): void;
}

export interface OpenLoudspeaker {
  /**
   * @param hearAtMs when it is to be heard, robot's clock
   * @param bytes an Opus packet; empty for one that was lost
   * @returns whether it was taken
   */
  play(hearAtMs: number, durationMs: number, bytes: Uint8Array): boolean;
  close(): Promise<void>;
}

/** What a robot has. Opening never throws: faults are events. */
export interface SoundDevices {
  /** `null` if it has none. */
  microphone: ((bitsPerSecond: number, events: MicrophoneEvents) => OpenMicrophone) | null;
  /** `null` if it has none. */
  loudspeaker: ((events: LoudspeakerEvents) => OpenLoudspeaker) | null;
  /** The highest rate of the microphone, bit/s. */
  mostBitsPerSecond: number;
}
