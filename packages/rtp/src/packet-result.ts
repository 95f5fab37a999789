/** What became of one packet, as transport-wide feedback tells. */
export interface PacketResult {
  transportSequence: number;
  bytes: number;
  sentMs: number;
  /** The receiver's clock, µs, continuous over feedback messages; only differences mean something. `null`: lost. */
  arrivalUs: number | null;
}
