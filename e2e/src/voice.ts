/** What the browser's microphone hears in tests. */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { processFolder } from '@farpoint/local-stack';

/** Samples a second. */
export const AUDIO_RATE = 48_000;
export const VOICE_HZ = 900;
/** Of a RIFF file with PCM samples. */
const HEADER_BYTES = 44;

/**
 * A second of speech-like sound: a tone that comes and goes, so that the browser does not take it for noise and remove it.
 *
 * @returns the flags with which Chromium takes it for its microphone
 */
export function voiceFlags(): string[] {
  const samples = Int16Array.from({ length: AUDIO_RATE }, (_, i) => {
    const envelope = Math.max(0, Math.sin((2 * Math.PI * 4 * i) / AUDIO_RATE));
    return Math.round(12_000 * envelope * Math.sin((2 * Math.PI * VOICE_HZ * i) / AUDIO_RATE));
  });
  const header = Buffer.alloc(HEADER_BYTES);
  header.write('RIFF', 0);
  header.writeUInt32LE(HEADER_BYTES - 8 + samples.byteLength, 4);
  header.write('WAVEfmt ', 8);
  header.writeUInt32LE(16, 16);
  // PCM, one channel.
  header.writeUInt16LE(1, 20);
  header.writeUInt16LE(1, 22);
  header.writeUInt32LE(AUDIO_RATE, 24);
  header.writeUInt32LE(AUDIO_RATE * 2, 28);
  header.writeUInt16LE(2, 32);
  header.writeUInt16LE(16, 34);
  header.write('data', 36);
  header.writeUInt32LE(samples.byteLength, 40);
  const file = join(processFolder(), 'voice.wav');
  writeFileSync(file, Buffer.concat([header, Buffer.from(samples.buffer)]));
  return [
    '--use-fake-ui-for-media-stream',
    '--use-fake-device-for-media-stream',
    `--use-file-for-fake-audio-capture=${file}`,
  ];
}
