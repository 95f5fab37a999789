/** The data channels of a Farpoint session. `openedBy` creates the channel in-band (RFC 8832). */
export const channels = {
  /** Lease, limits, stream control, refusals: session-messages.ts. */
  session: { label: 'session', openedBy: 'robot', ordered: true },
  /** telemetry.ts. A state that is older than its lifetime is worth nothing: the next one is on its way. */
  telemetry: { label: 'telemetry', openedBy: 'robot', ordered: false, maxPacketLifeTime: 100 },
  /** picture-chunk.ts; from robots that have cameras. A chunk older than its lifetime is not worth sending again. */
  pictures: { label: 'pictures', openedBy: 'robot', ordered: false, maxPacketLifeTime: 150 },
  /** control.ts. Nothing is sent again, in either direction: whoever needs an answer asks again. */
  control: { label: 'control', openedBy: 'operator', ordered: false, maxRetransmits: 0 },
  /** bandwidth.ts: the operator's limit for the stream. */
  bandwidth: { label: 'bandwidth', openedBy: 'operator', ordered: true },
} as const;

export type ChannelName = keyof typeof channels;

/** The MediaStream id of the point cloud's track in a Farpoint offer. */
export const CLOUD_STREAM_ID = 'farpoint-cloud';
