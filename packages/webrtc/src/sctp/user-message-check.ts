/** Checks that an SCTP message is valid for a data channel (RFC 8831 §8, RFC 8832 §5). */

export const PayloadProtocol = {
  dcep: 50,
  string: 51,
  binary: 53,
  stringEmpty: 56,
  binaryEmpty: 57,
} as const;
export const DCEP_OPEN = 3;
const DCEP_ACK = 2;
/** Message type, channel type, priority, reliability, lengths of label and protocol. */
const OPEN_BYTES = 12;
const KNOWN = new Set<number>(Object.values(PayloadProtocol));

/** @param isOpen whether the stream has a channel */
export function isUserMessage(payloadProtocol: number, data: Buffer, isOpen: boolean): boolean {
  if (!KNOWN.has(payloadProtocol)) return false;
  if (payloadProtocol !== PayloadProtocol.dcep) return true;
  if (data.length === 0) return false;
  if (data.readUInt8(0) === DCEP_ACK) return isOpen;
  // Each opening is acknowledged, and the acknowledgements of one that is repeated would pile up.
  if (data.readUInt8(0) !== DCEP_OPEN || isOpen || data.length < OPEN_BYTES) return false;
  return data.length === OPEN_BYTES + data.readUInt16BE(8) + data.readUInt16BE(10);
}
