import type { CloudFormat, Placement } from '@farpoint/protocol';
import type { RejectedPoints } from '@farpoint/wasm-codec';
import type { CaptureRoom, SourceFrame } from '../capture/frame-source.ts';

/** The paper's weights (equations 4 and 5). */
export interface SamplingOptions {
  lambda: number;
  epsilon: number;
  /** D, metres. */
  nearDistance: number;
  depthMeasure: 'z' | 'range';
}

/** What an encoder is made with. */
export interface EncoderOptions extends SamplingOptions {
  /** The sensor's number, for the placement. */
  sensor: number;
}

/** What came of encoding one frame; its packets wait in the encoder. */
export interface EncodedFrame {
  format: CloudFormat;
  frameNumber: number;
  points: number;
  packets: number;
  /** Points of the raw cloud that could have been sent. */
  validPoints: number;
  rejected: RejectedPoints;
  saturated: number;
  /** Choosing points, and turning them into packets, ms. */
  sampleMs: number;
  packMs: number;
}

/** A frame's packets lie in its encoder until the next. */
export interface PacketSource {
  /** The codec's own memory: a frame that lies there already is not copied. */
  readonly room: CaptureRoom;
  /** Copies the packets of the last encoded frame out of the codec's memory. */
  copyPackets(into: Uint8Array, packets: number): void;
}

export function placementOf(
  frame: SourceFrame,
  format: CloudFormat,
  sensor: number,
  latencyTest: boolean,
  saturated: boolean,
): Placement {
  return {
    pose: frame.cameraPose,
    captureTimeUs: Math.floor((frame.capturedAtMs * 1000) % 0x1_0000_0000),
    latencyTest,
    saturated,
    sensor,
    format,
  };
}

/**
 * Views of an encoder's memory, taken when they are asked for: what nobody asks for is not made. Making the images
 * may move the points given out before, so ask for points or for images.
 */
export function roomOf(encoder: {
  frame: Float32Array;
  depth: Float32Array;
  colour: Uint32Array;
}): CaptureRoom {
  return {
    get points() {
      return encoder.frame;
    },
    get depth() {
      return encoder.depth;
    },
    get colour() {
      return encoder.colour;
    },
  };
}

export function isSameMemory(frame: ArrayBufferView, memory: ArrayBufferView): boolean {
  return frame.buffer === memory.buffer && frame.byteOffset === memory.byteOffset;
}
