/** The data channels of a Farpoint session. `openedBy` creates the channel in-band (RFC 8832). */
export const channels = {
  /** Lease, limits, stream control, refusals: session-messages.ts. */
  session: { label: 'session', openedBy: 'robot', ordered: true },
  /** telemetry.ts. A lifetime, not a retransmission count: werift reads a count of 0 as reliable. */
  telemetry: { label: 'telemetry', openedBy: 'robot', ordered: false, maxPacketLifeTime: 100 },
  /** picture-chunk.ts; from robots that have cameras. A chunk older than its lifetime is not worth sending again. */
  pictures: { label: 'pictures', openedBy: 'robot', ordered: false, maxPacketLifeTime: 150 },
  /** control.ts. Opened by the browser, whose stack honours 0 retransmissions for what it sends. */
  control: { label: 'control', openedBy: 'operator', ordered: false, maxRetransmits: 0 },
  /** bandwidth.ts: the operator's limit for the stream. */
  bandwidth: { label: 'bandwidth', openedBy: 'operator', ordered: true },
} as const;

export type ChannelName = keyof typeof channels;

/** The MediaStream id of the point cloud's track in a Farpoint offer. */
export const CLOUD_STREAM_ID = 'farpoint-cloud';
