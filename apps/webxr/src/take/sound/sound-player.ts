/** Plays the robot's microphone in the browser, and measures what is played. */

/** Some 170 ms of sound: fine enough to tell tones apart. */
const WINDOW = 8192;
/** What a meter shows as nothing, dB below full scale. */
const FLOOR_DB = -60;

export class SoundPlayer {
  /** Called with what the browser says if it does not play. */
  onRefused: ((detail: string) => void) | null = null;
  readonly #element = new Audio();
  #context: AudioContext | null = null;
  #analyser: AnalyserNode | null = null;
  #source: MediaStreamAudioSourceNode | null = null;
  #track: MediaStreamTrack | null = null;
  #on = false;

  /** Takes the robot's track; it is heard while the player is on. `null` for none. */
  use(track: MediaStreamTrack | null): void {
    this.#track = track;
    this.#source?.disconnect();
    this.#source = null;
    this.#element.srcObject = track === null ? null : new MediaStream([track]);
    if (this.#on) this.#play();
  }

  /** Begins to play. Browsers allow it in the handler of a click or of a key. */
  start(): void {
    this.#on = true;
    this.#context ??= new AudioContext({ latencyHint: 'interactive' });
    this.#context.resume().catch(() => undefined);
    this.#play();
  }

  stop(): void {
    this.#on = false;
    this.#element.pause();
    // A suspended context takes no processor time.
    this.#context?.suspend().catch(() => undefined);
  }

  /** @param volume 0–1 */
  set volume(volume: number) {
    this.#element.volume = volume;
  }

  /** Whether the browser plays something now. */
  get playing(): boolean {
    return this.#on && !this.#element.paused && this.#track?.readyState === 'live' && !this.#track.muted;
  }

  /** The loudness of what has just been played, before the volume: 0 (at most −60 dB) to 1 (full scale). */
  level(): number {
    if (this.#analyser === null || !this.playing) return 0;
    const samples = new Float32Array(2048);
    this.#analyser.getFloatTimeDomainData(samples);
    const power = samples.reduce((sum, sample) => sum + sample * sample, 0) / samples.length;
    const db = 10 * Math.log10(power + 1e-12);
    return Math.max(0, 1 - db / FLOOR_DB);
  }

  /** The strongest frequency of what has just been played, Hz; `null` if there is none. */
  peakFrequency(): number | null {
    if (this.#analyser === null || this.#context === null || !this.playing) return null;
    const bins = new Float32Array(this.#analyser.frequencyBinCount);
    this.#analyser.getFloatFrequencyData(bins);
    let best = 1;
    for (let bin = 2; bin < bins.length; bin++)
      if ((bins[bin] as number) > (bins[best] as number)) best = bin;
    return (bins[best] as number) < FLOOR_DB ? null : (best * this.#context.sampleRate) / WINDOW;
  }

  #play(): void {
    const { srcObject } = this.#element;
    if (!(srcObject instanceof MediaStream) || this.#context === null) return;
    if (this.#source === null) {
      this.#analyser ??= new AnalyserNode(this.#context, { fftSize: WINDOW, smoothingTimeConstant: 0 });
      this.#source = this.#context.createMediaStreamSource(srcObject);
      this.#source.connect(this.#analyser);
    }
    this.#element.play().catch((error: unknown) => {
      // A new track or a pause came before it had begun.
      if (error instanceof DOMException && error.name === 'AbortError') return;
      this.onRefused?.(String(error));
    });
  }
}
