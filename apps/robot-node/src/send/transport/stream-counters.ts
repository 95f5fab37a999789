/** Totals since the session began. */
export interface StreamCounters {
  /** Of clouds. */
  framesSent: number;
  packetsSent: number;
  /** On the wire, all headers counted. */
  bytesSent: number;
  pointsSent: number;
  /** Packets not sent because the path was closed. */
  packetsUnsent: number;
  feedbackMessages: number;
  feedbackMalformed: number;
  /** Packets retransmitted because the operator was missing them; not included in `packetsSent`. */
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
