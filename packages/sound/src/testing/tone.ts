/** Tones in raw sound, for tests. */

/** The share of a signal's power that a frequency has (Goertzel), 0–1. */
export function toneShare(samples: Float32Array | Int16Array, frequency: number, rate: number): number {
  const coefficient = 2 * Math.cos((2 * Math.PI * frequency) / rate);
  let [before, last, power] = [0, 0, 0];
  for (const sample of samples) {
    [before, last] = [last, sample + coefficient * last - before];
    power += sample * sample;
  }
  if (power === 0) return 0;
  const tone = before * before + last * last - coefficient * before * last;
  return Math.min(1, (2 * tone) / (samples.length * power));
}

/** Raw 16-bit sound of one channel. */
export function samplesOf(bytes: Uint8Array): Int16Array {
  const whole = bytes.length - (bytes.length % 2);
  return new Int16Array(new Uint8Array(bytes.subarray(0, whole)).buffer);
}
