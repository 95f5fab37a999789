/** The connection to the signaling service. */
export type SignalingState =
  | 'connecting'
  | 'ready' // welcomed: sessions can be opened
  | 'waiting' // unreachable; tries again by itself
  | 'refused' // the token is wrong or missing; tries again slowly, in case the service's configuration is the fault
  | 'stopped';
