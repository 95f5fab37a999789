/** Sums since the session began. */
export interface StreamCounters {
  framesSent: number;
  packetsSent: number;
  /** On the wire, all headers counted. */
  bytesSent: number;
  pointsSent: number;
  /** Packets that found the path closed. */
  packetsUnsent: number;
  feedbackMessages: number;
  feedbackMalformed: number;
  /** Sent again because the operator missed them; not among `packetsSent`. */
  packetsResent: number;
}

export function emptyStreamCounters(): StreamCounters {
  return {
    framesSent: 0,
    packetsSent: 0,
    bytesSent: 0,
    pointsSent: 0,
    packetsUnsent: 0,
    feedbackMessages: 0,
    feedbackMalformed: 0,
    packetsResent: 0,
  };
}
