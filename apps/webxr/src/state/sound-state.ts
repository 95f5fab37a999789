/** What the page knows of the robot's sound and of the operator's voice, as signals. */
import type { RobotClient, Sound, VoiceStatus } from '@farpoint/operator';
import { computed, type ReadonlySignal, signal } from '@preact/signals-core';
import { heardWords, type SoundWords, voiceWords } from '../words/sound-words.ts';

export class SoundState {
  /** What the robot has said last; `null` if it has no sound, or there is no session. */
  readonly robot = signal<Sound | null>(null);
  /** Whether the operator wants to hear the robot. It stays so with the next session. */
  readonly wanted = signal(false);
  /** 0–1. */
  readonly volume = signal(1);
  /** Loudness of what is played, 0–1. */
  readonly level = signal(0);
  /** Whether the browser plays something. */
  readonly playing = signal(false);
  /** What the browser said when it did not play; `null` if it does. */
  readonly refused = signal<string | null>(null);
  readonly voice = signal<VoiceStatus>({ held: false, sending: false, failure: null });

  readonly hasMicrophone: ReadonlySignal<boolean> = computed(
    () => this.robot.value?.microphone !== undefined,
  );
  readonly hasLoudspeaker: ReadonlySignal<boolean> = computed(() => this.robot.value?.voice !== undefined);
  /** What is heard of the robot. */
  readonly heard: ReadonlySignal<SoundWords> = computed(() =>
    heardWords({
      wanted: this.wanted.value,
      microphone: this.robot.value?.microphone,
      playing: this.playing.value,
      refused: this.refused.value !== null,
    }),
  );
  /** Whether the robot hears the operator. */
  readonly said: ReadonlySignal<SoundWords> = computed(() =>
    voiceWords(this.voice.value, this.robot.value?.voice),
  );

  constructor(client: RobotClient) {
    client.on('session', () => {
      this.robot.value = null;
    });
    client.on('phase', (phase) => {
      if (phase !== 'live') this.robot.value = null;
    });
    client.on('sound', (sound) => {
      const isFirst = this.robot.peek() === null;
      this.robot.value = sound;
      if (isFirst && this.wanted.peek()) client.sound.listen(true);
    });
    client.on('voice', (voice) => {
      this.voice.value = voice;
    });
  }
}
