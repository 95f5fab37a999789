/** What a robot's decrypted RTP packets must be, individually and as a stream. Bytes in, findings out. */
import {
  emptyPointPacketHeader,
  FULL_POINT_PACKET_BYTES,
  MAX_POINT_DATA_BYTES,
  POINT_PACKET_HEADER_BYTES,
  readPointPacketHeader,
} from '@farpoint/protocol';

/** A departure of an implementation from the reference profile. */
export interface Finding {
  /** Short name of the rule, for lists. */
  rule: string;
  /** For people: what was observed. */
  detail: string;
}

export const RTP_HEADER_BYTES = 20;
const MAX_FINDINGS = 100;

/** Takes packets in order of their RTP sequence numbers; the caller leaves out duplicates. */
export class RtpStreamRules {
  readonly findings: Finding[] = [];
  packets = 0;
  frames = 0;
  #frame: number | null = null;
  #frameLength = 0;
  #timestamp = 0;
  #marked = false;
  #lastSequence: number | null = null;
  readonly #header = emptyPointPacketHeader();

  /** @param isFirst whether this is the first packet of the connection: the first frame must then be 0 */
  add(packet: Uint8Array, isFirst = this.packets === 0): void {
    this.packets++;
    const view = new DataView(packet.buffer, packet.byteOffset, packet.byteLength);
    if (packet.length !== RTP_HEADER_BYTES + FULL_POINT_PACKET_BYTES) {
      this.#find(
        'packet-bytes',
        `${packet.length} bytes, ${RTP_HEADER_BYTES + FULL_POINT_PACKET_BYTES} needed`,
      );
      if (packet.length < RTP_HEADER_BYTES + POINT_PACKET_HEADER_BYTES) return;
    }
    this.#checkRtpHeader(view);
    const payload = new DataView(
      packet.buffer,
      packet.byteOffset + RTP_HEADER_BYTES,
      packet.byteLength - RTP_HEADER_BYTES,
    );
    const fault = readPointPacketHeader(payload, this.#header);
    if (fault !== null) {
      this.#find('point-header', fault);
      return;
    }
    this.#checkFrame(view, isFirst);
  }

  #checkRtpHeader(view: DataView): void {
    // Version 2, no padding, an extension, no contributing sources.
    if (view.getUint8(0) !== 0x90) this.#find('rtp-header', `first byte 0x${view.getUint8(0).toString(16)}`);
    if ((view.getUint8(1) & 0x7f) !== 5) this.#find('payload-type', `${view.getUint8(1) & 0x7f}`);
    if (view.getUint32(12) !== 0xbede0001) this.#find('extension', `0x${view.getUint32(12).toString(16)}`);
    // Element 1, two bytes, then a byte of padding.
    if (view.getUint8(16) !== 0x11 || view.getUint8(19) !== 0)
      this.#find('extension-element', `0x${view.getUint32(16).toString(16)}`);
    const sequence = view.getUint16(2);
    if (sequence === this.#lastSequence) this.#find('sequence', `${sequence} twice`);
    this.#lastSequence = sequence;
  }

  #checkFrame(view: DataView, isFirst: boolean): void {
    const { frameNumber, frameLength, sequenceOffset, sequenceLength } = this.#header;
    const timestamp = view.getUint32(4);
    const marker = (view.getUint8(1) & 0x80) !== 0;
    if (sequenceLength !== MAX_POINT_DATA_BYTES || frameLength % MAX_POINT_DATA_BYTES !== 0)
      this.#find('whole-packets', `block of ${sequenceLength} bytes in a frame of ${frameLength}`);
    if (isFirst && frameNumber !== 0) this.#find('from-zero', `the first frame is ${frameNumber}`);
    if (frameNumber !== this.#frame) {
      if (this.#frame !== null) {
        if (((frameNumber - this.#frame) | 0) !== 1)
          this.#find('frame-number', `${frameNumber} after ${this.#frame}`);
        if (timestamp === this.#timestamp)
          this.#find('timestamp', `does not advance with frame ${frameNumber}`);
      }
      this.frames++;
      this.#frame = frameNumber;
      this.#frameLength = frameLength;
      this.#timestamp = timestamp;
      this.#marked = false;
    } else {
      if (frameLength !== this.#frameLength)
        this.#find('frame-length', `${frameLength} after ${this.#frameLength}`);
      if (timestamp !== this.#timestamp) this.#find('timestamp', `changes within frame ${frameNumber}`);
      if (this.#marked) this.#find('marker', `a packet of frame ${frameNumber} after its last`);
    }
    const isLast = sequenceOffset + sequenceLength === frameLength;
    if (marker !== isLast)
      this.#find('marker', `${marker ? 'set before' : 'missing on'} the end of frame ${frameNumber}`);
    this.#marked = marker;
  }

  #find(rule: string, detail: string): void {
    if (this.findings.length < MAX_FINDINGS) this.findings.push({ rule, detail });
  }
}
