export type WireErrorCode =
  | 'too-large' // a message that announces more bytes than there is room for
  | 'unknown-type' // a type that is not in the list
  | 'bad-message'; // a payload that is too short or not valid

/** What is wrong with the bytes that came from the process. */
export class WireError extends Error {
  override readonly name = 'WireError';
  readonly code: WireErrorCode;

  constructor(code: WireErrorCode, what: string, options?: ErrorOptions) {
    super(what, options);
    this.code = code;
  }
}
