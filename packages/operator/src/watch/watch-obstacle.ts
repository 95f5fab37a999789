import { JanusFailure } from '@farpoint/janus';
import { ProtocolError } from '@farpoint/protocol';
import type { WatchObstacle } from './watch-state.ts';

export function obstacleOf(error: unknown): WatchObstacle {
  if (error instanceof ProtocolError) return 'not-a-broadcast';
  if (!(error instanceof JanusFailure)) return 'lost';
  if (error.reason === 'no-mountpoint') return 'no-broadcast';
  return error.reason === 'unauthorised' ? 'refused' : 'relay-unreachable';
}
