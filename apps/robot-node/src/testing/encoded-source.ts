/** The packets of a source's clouds as the robot makes them, without its threads and without a link. */
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import type { CodedStream } from '../sense/encode/coded-frame-encoder.ts';
import { FrameFormats } from '../sense/encode/frame-formats.ts';
import { SLOT_BYTES, slotPayload } from '../sense/encode/packetiser.ts';
import { CODED_FORMATS, FramePlanner } from '../sense/encode/plan.ts';
import { openSource, type SourceOptions } from '../sense/sources/open-source.ts';

/** As `--lambda` and `--priority-distance`, where nothing is nearer than anything else. */
const SAMPLING = { lambda: 0, epsilon: 1e-6, nearDistance: 3.85, sensor: 0 };

export interface EncodeOptions {
  /** Whether the operators read everything that robots send, or only `points64`. */
  mode: 'coded' | 'points64';
  /** How many of the source's frames. */
  frames: number;
  framesPerSecond: number;
  bitsPerSecond: number;
}

export interface EncodedSource {
  /** What receivers must know before the first packet; `null` for `points64`. */
  stream: CodedStream | null;
  /** Payloads of each frame's RTP packets. */
  frames: Uint8Array[][];
  /** How many points each frame has. */
  points: number[];
}

export async function encodeSource(options: SourceOptions, encode: EncodeOptions): Promise<EncodedSource> {
  const { mode, framesPerSecond, bitsPerSecond } = encode;
  const codec = await loadCodecFromDisk();
  const source = await openSource(options);
  const planner = new FramePlanner({
    ...{ policy: 'latency', mostFramesPerSecond: framesPerSecond, anyRate: true },
    ...{ floorFraction: 0.1, mostPoints: 1e6 },
  });
  const formats = new FrameFormats(codec, source.description, SAMPLING, planner, () => 0);
  const coded = mode === 'points64' ? [] : CODED_FORMATS;
  const budget = {
    ...{ targetBitsPerSecond: bitsPerSecond, overheadBytes: 0, streaming: true, probe: null },
    coded: coded.map((format) => ({ format, targetBitsPerSecond: bitsPerSecond, plainBitsPerSecond: null })),
  };
  const encoded: EncodedSource = { stream: null, frames: [], points: [] };
  for (let frameNumber = 0; frameNumber < encode.frames; frameNumber++) {
    const wishes = { bitsPerSecond, latencyTest: false };
    const captured = source.capture(frameNumber, wishes, formats.room(coded.length > 0));
    if (captured === null) throw new Error(`the source has no frame ${frameNumber}`);
    const request = { frameNumber, budget, probeBytes: 0, workMs: 0, measuredFramesPerSecond: null };
    const [frame] = formats.encode(captured, { ...request, latencyTest: false }).frames;
    if (frame === undefined) throw new Error(`frame ${frameNumber} was not encoded`);
    const { packets: count, points } = frame.encoded;
    const slots = new Uint8Array(count * SLOT_BYTES);
    frame.packets.copyPackets(slots, count);
    encoded.frames.push(Array.from({ length: count }, (_, i) => slotPayload(slots, i)));
    encoded.points.push(points);
  }
  encoded.stream = formats.stream;
  source.close();
  return encoded;
}
