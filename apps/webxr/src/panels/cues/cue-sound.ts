import type { Cue } from './cue-judge.ts';

interface Tone {
  hz: number;
  ms: number;
}

/** Told apart by number and pitch, also by those who hear only some of them. */
export const cueTones: Readonly<Record<Cue, readonly Tone[]>> = {
  slower: [{ hz: 660, ms: 90 }],
  held: [
    { hz: 440, ms: 110 },
    { hz: 440, ms: 110 },
  ],
  stop: [
    { hz: 880, ms: 120 },
    { hz: 587, ms: 120 },
    { hz: 392, ms: 240 },
  ],
};

/** Silence between two tones of a cue, ms. Chosen by ear: two are told from one. */
const GAP_MS = 50;
/**
 * A cue that cannot be heard within so long is left out, ms. Chosen: later, it would tell of something else.
 */
const LATE_MS = 300;
const LOUDNESS = 0.2;
/** Of a tone's beginning and end: without it they click. */
const FADE_S = 0.01;

/** Sounds the cues. A browser lets a page be heard only after somebody has pressed a key or a button in it. */
export class CueSound {
  #context: AudioContext | null = null;
  /** Tones that have not ended. */
  #sounding = 0;

  /** Opens the loudspeaker, which takes a tenth of a second and more on a slow computer. Call it while nobody drives. */
  prepare(): void {
    if (this.#context === null) this.#rest(this.#open());
  }

  play(cue: Cue): void {
    const context = this.#open();
    const askedMs = performance.now();
    // It rests between two cues, and until the first press.
    context.resume().then(
      () => {
        // What was not heard at once is not heard late.
        if (performance.now() - askedMs < LATE_MS) this.#sound(context, cue);
        else this.#rest(context);
      },
      () => undefined,
    );
  }

  #open(): AudioContext {
    this.#context ??= new AudioContext({ latencyHint: 'interactive' });
    return this.#context;
  }

  #sound(context: AudioContext, cue: Cue): void {
    let at = context.currentTime;
    for (const { hz, ms } of cueTones[cue]) {
      const oscillator = new OscillatorNode(context, { frequency: hz, type: 'triangle' });
      const gain = new GainNode(context, { gain: 0 });
      const end = at + ms / 1000;
      gain.gain.setValueAtTime(0, at);
      gain.gain.linearRampToValueAtTime(LOUDNESS, at + FADE_S);
      gain.gain.setValueAtTime(LOUDNESS, end - FADE_S);
      gain.gain.linearRampToValueAtTime(0, end);
      oscillator.connect(gain).connect(context.destination);
      oscillator.start(at);
      oscillator.stop(end);
      this.#sounding++;
      oscillator.onended = () => {
        this.#sounding--;
        this.#rest(context);
      };
      at = end + GAP_MS / 1000;
    }
  }

  /** A context that runs takes the processor's time for silence. */
  #rest(context: AudioContext): void {
    if (this.#sounding === 0) context.suspend().catch(() => undefined);
  }
}
