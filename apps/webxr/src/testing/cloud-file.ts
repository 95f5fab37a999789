/** Clouds as files that the robot's encoders have written, for a page without a robot. */

/** A cloud as it is on the wire. */
export interface CloudFile {
  /** Base64. Absent for `points64`. */
  stream?: { format: 'organised' | 'unorganised'; header: string };
  /** Axes of its points: x ahead and z up, instead of those of a camera's optical frame. */
  axes?: 'body';
  /** Payloads of the frames' RTP packets, base64. */
  frames: string[][];
}

/** What a test changes of a payload: which frame it belongs to, when it was captured, where its camera stood. */
export interface PlacedFrame {
  frameNumber: number;
  captureUs: number;
  position: readonly [x: number, y: number, z: number];
  /** x, y, z, w of the camera's optical frame. */
  orientation: readonly [x: number, y: number, z: number, w: number];
  sensor: number;
  /** Whether it answers a latency test: it is shown green. */
  latencyTest: boolean;
}

const PLACEMENT_BYTES = 28;
const FLAG_LATENCY_TEST = 1;
const QUATERNION_SCALE = 32767;

/** The payload with another place; docs/protocol.md has the layout. */
export function placed(payload: string, frame: PlacedFrame): ArrayBuffer {
  const { buffer } = bytesOf(payload);
  const view = new DataView(buffer);
  const at = view.byteLength - PLACEMENT_BYTES;
  view.setUint32(0, frame.frameNumber, true);
  for (const [i, metres] of frame.position.entries()) view.setFloat32(at + 4 * i, metres, true);
  for (const [i, part] of frame.orientation.entries())
    view.setInt16(at + 12 + 2 * i, Math.round(part * QUATERNION_SCALE), true);
  view.setUint32(at + 20, frame.captureUs, true);
  if (frame.latencyTest) view.setUint8(at + 24, view.getUint8(at + 24) | FLAG_LATENCY_TEST);
  view.setUint8(at + 25, frame.sensor);
  return buffer;
}

export function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
}
