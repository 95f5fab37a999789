/** The state of the connection to the signaling service. */
export type SignalingState =
  | 'connecting'
  /** Welcomed: sessions can be opened. */
  | 'ready'
  /** Unreachable; reconnects automatically. */
  | 'waiting'
  /** The token is wrong or missing. Tries again slowly, in case the service's configuration is wrong. */
  | 'refused'
  | 'stopped';
