/** For tests: a DTLS 1.2 record as on the wire. */
export function dtlsRecord(
  contentType: number,
  epoch: number,
  sequence: number,
  fragment: Uint8Array,
): Buffer {
  const header = Buffer.alloc(13);
  header.writeUInt8(contentType, 0);
  header.writeUInt16BE(0xfefd, 1);
  header.writeUInt16BE(epoch, 3);
  header.writeUIntBE(sequence, 5, 6);
  header.writeUInt16BE(fragment.length, 11);
  return Buffer.concat([header, fragment]);
}
