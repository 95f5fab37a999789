/** What was wrong with a call. */
export type CodecErrorCode =
  | 'not-loadable' // the WASM module cannot be read or compiled here
  | 'bad-capacity' // not an integer, or more than the module's memory can hold
  | 'bad-layout' // a full data block does not fit into a slot
  | 'too-many-points' // more points than the encoder's capacity
  | 'too-many-packets' // more packets than the decoder's capacity
  | 'bad-count' // a number of points that is not an integer, or over 150 for one packet
  | 'bad-stream-header' // a stream header that is damaged, of another version, or invalid
  | 'no-stream' // nothing can be coded before a stream is begun
  | 'too-many-colours' // more than a palette holds
  | 'bad-parameter'; // a sampling parameter outside its range

/** Thrown by this package for every call it refuses; the object remains usable afterwards. */
export class CodecError extends Error {
  override readonly name = 'CodecError';
  readonly code: CodecErrorCode;

  constructor(code: CodecErrorCode, message: string, options?: ErrorOptions) {
    super(message, options);
    this.code = code;
  }
}
