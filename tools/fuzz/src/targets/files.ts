import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { decodeColourJpeg, decodeDepthPng } from '@farpoint/cloud-formats';
import { openRecording } from '@farpoint/recording';
import { cloudMessage, mcapOf } from '@farpoint/recording/testing';
import { encode } from 'fast-png';
import type { FuzzTarget } from '../fuzz-target.ts';

/** 8 × 8 grey pixels. */
const JPEG = [
  '/9j/4AAQSkZJRgABAQAAAQABAAD/2wCEACgcHiMeGSgjISMtKygwPGRBPDc3PHtYXUlkkYCZlo+AjIqgtObDoKrarYqMyP/L2u71',
  '////m8H////6/+b9//gBKy0tPDU8dkFBdviljKX4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4',
  '+Pj4+P/AABEIAAgACAMBEQACEQEDEQH/xAGiAAABBQEBAQEBAQAAAAAAAAAAAQIDBAUGBwgJCgsQAAIBAwMCBAMFBQQEAAABfQEC',
  'AwAEEQUSITFBBhNRYQcicRQygZGhCCNCscEVUtHwJDNicoIJChYXGBkaJSYnKCkqNDU2Nzg5OkNERUZHSElKU1RVVldYWVpjZGVm',
  'Z2hpanN0dXZ3eHl6g4SFhoeIiYqSk5SVlpeYmZqio6Slpqeoqaqys7S1tre4ubrCw8TFxsfIycrS09TV1tfY2drh4uPk5ebn6Onq',
  '8fLz9PX29/j5+gEAAwEBAQEBAQEBAQAAAAAAAAECAwQFBgcICQoLEQACAQIEBAMEBwUEBAABAncAAQIDEQQFITEGEkFRB2FxEyIy',
  'gQgUQpGhscEJIzNS8BVictEKFiQ04SXxFxgZGiYnKCkqNTY3ODk6Q0RFRkdISUpTVFVWV1hZWmNkZWZnaGlqc3R1dnd4eXqCg4SF',
  'hoeIiYqSk5SVlpeYmZqio6Slpqeoqaqys7S1tre4ubrCw8TFxsfIycrS09TV1tfY2dri4+Tl5ufo6ery8/T19vf4+fr/2gAMAwEA',
  'AhEDEQA/AG0Af//Z',
].join('');

/** As programs do: from the disk. Reads every message. */
function readFile(name: string): (input: Uint8Array) => Promise<void> {
  return async (input) => {
    // For each input: a process that is killed, as those of tests are, leaves one at most.
    const folder = mkdtempSync(join(tmpdir(), 'farpoint-fuzz-'));
    try {
      writeFileSync(join(folder, name), input);
      const recording = await openRecording(join(folder, name));
      try {
        const names = recording.topics.map((topic) => topic.name);
        for await (const { topic, data } of recording.messages(names, recording.startNs)) topic.decode(data);
      } finally {
        await recording.close();
      }
    } finally {
      rmSync(folder, { recursive: true, force: true });
    }
  };
}

const bagRecord = (header: string, data: Uint8Array) => {
  const fields = Buffer.from(header, 'latin1');
  const lengths = [Buffer.alloc(4), Buffer.alloc(4)] as const;
  lengths[0].writeUInt32LE(fields.length, 0);
  lengths[1].writeUInt32LE(data.length, 0);
  return Buffer.concat([lengths[0], fields, lengths[1], data]);
};

/** Readers of whole files: slower than the others by orders of magnitude. */
export const fileTargets: readonly FuzzTarget[] = [
  {
    name: 'mcap',
    share: 0.005,
    maxBytes: 65_536,
    seeds: async () => [Uint8Array.from(await mcapOf(4, (k) => cloudMessage(k, 10)))],
    run: readFile('input.mcap'),
    refusals: ['RecordingError', 'RosFault'],
  },
  {
    name: 'bag',
    share: 0.02,
    maxBytes: 8192,
    seeds: () => {
      const header =
        '\x0d\0\0\0index_pos=\0\x20\0\0\0\0\0\0\x0f\0\0\0conn_count=\x01\0\0\0\x10\0\0\0chunk_count=\x01\0\0\0\x04\0\0\0op=\x03';
      return [Buffer.concat([Buffer.from('#ROSBAG V2.0\n'), bagRecord(header, Buffer.alloc(4027, 32))])];
    },
    run: readFile('input.bag'),
    refusals: ['RecordingError', 'RosFault'],
  },
  {
    name: 'depth-png',
    share: 0.05,
    seeds: () => [
      encode({ width: 8, height: 8, channels: 1, depth: 16, data: new Uint16Array(64).fill(900) }),
    ],
    run: (input) => void decodeDepthPng(input),
    refusals: ['RgbdError'],
  },
  {
    name: 'colour-jpeg',
    share: 0.02,
    seeds: () => [Buffer.from(JPEG, 'base64')],
    run: (input) => void decodeColourJpeg(input),
    refusals: ['RgbdError'],
  },
];
