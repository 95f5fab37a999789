/** The connection to the signaling service. */
export type SignalingState =
  | 'connecting'
  /** Welcomed: sessions can be opened. */
  | 'ready'
  /** Unreachable; tries again by itself. */
  | 'waiting'
  /** The token is wrong or missing; tries again slowly, in case the service's configuration is the fault. */
  | 'refused'
  | 'stopped';
