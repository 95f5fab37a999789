/** The data channels of the reference profile. Two of them have the same label: who opened them distinguishes them. */
export const referenceChannels = {
  /** Operator → robot: a bare twist, UTF-8 JSON as a binary message. Opened by the robot. */
  control: { label: 'controltrack', ordered: true },
  /** Operator → robot: int32 bit/s, once for each received frame. Opened by the operator. */
  bandwidth: { label: 'bandwidth', ordered: true },
  /** Operator → robot: `start` and `stop`. Opened by the operator. */
  words: { label: 'controltrack', ordered: true, maxRetransmits: 30 },
} as const;
