/** What became of one packet, according to transport-wide feedback. */
export interface PacketResult {
  transportSequence: number;
  bytes: number;
  sentMs: number;
  /** The receiver's clock, µs, continuous across feedback messages; only differences are meaningful. `null`: lost. */
  arrivalUs: number | null;
}
