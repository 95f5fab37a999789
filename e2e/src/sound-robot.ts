/** A robot with a microphone and a loudspeaker, and a browser whose microphone hears a tone. */
import { existsSync, mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { RobotSpec } from '@farpoint/local-stack';
import { ADDON_FILE } from '@farpoint/sound/build';
import { samplesOf } from '@farpoint/sound/testing';

/** Whether the program for sound is built; without it, tests of sound are skipped. */
export const hasSound = existsSync(ADDON_FILE);

const RATE = 48_000;

export interface SoundRobot {
  readonly spec: RobotSpec;
  /** What the robot's loudspeaker has played, 48,000 samples a second. */
  heard(): Int16Array;
}

/** @param microphone a pipeline; default a tone of 600 Hz */
export function soundRobot(robot: RobotSpec, microphone?: string): SoundRobot {
  const folder = mkdtempSync(join(tmpdir(), 'farpoint-sound-'));
  const file = join(folder, 'heard.raw');
  const source =
    microphone === undefined ? { kind: 'test', frequency: 600 } : { kind: 'gst', pipeline: microphone };
  const pipeline = `audio/x-raw,format=S16LE,rate=${RATE},channels=1 ! filesink location=${file} buffer-mode=unbuffered`;
  const sound = { microphone: { source }, loudspeaker: { sink: { kind: 'gst', pipeline } } };
  const config = join(folder, 'farpoint.yaml');
  // JSON is valid YAML.
  writeFileSync(config, JSON.stringify({ robot: { sound } }));
  return {
    spec: { ...robot, args: [...(robot.args ?? []), '--config', config] },
    heard: () => (existsSync(file) ? samplesOf(readFileSync(file)) : new Int16Array(0)),
  };
}

/**
 * A file with a second of speech-like sound: a tone that comes and goes, so that the browser does not take it for noise
 * and remove it.
 */
export function toneFile(frequency: number): string {
  const samples = Int16Array.from({ length: RATE }, (_, i) => {
    const envelope = Math.max(0, Math.sin((2 * Math.PI * 4 * i) / RATE));
    return Math.round(12_000 * envelope * Math.sin((2 * Math.PI * frequency * i) / RATE));
  });
  const header = Buffer.alloc(44);
  header.write('RIFF', 0);
  header.writeUInt32LE(36 + samples.byteLength, 4);
  header.write('WAVEfmt ', 8);
  header.writeUInt32LE(16, 16);
  // PCM, one channel.
  header.writeUInt16LE(1, 20);
  header.writeUInt16LE(1, 22);
  header.writeUInt32LE(RATE, 24);
  header.writeUInt32LE(RATE * 2, 28);
  header.writeUInt16LE(2, 32);
  header.writeUInt16LE(16, 34);
  header.write('data', 36);
  header.writeUInt32LE(samples.byteLength, 40);
  const file = join(mkdtempSync(join(tmpdir(), 'farpoint-tone-')), 'tone.wav');
  writeFileSync(file, Buffer.concat([header, Buffer.from(samples.buffer)]));
  return file;
}
