import type { SessionRecorder } from '@farpoint/recording';
import type { Logger } from '@farpoint/service';
import type { LiveOptions } from './session-outputs.ts';

/** Logs whether there is a server for live viewers, and who reaches it. */
export function logLive(
  live: SessionRecorder['live'],
  { reach, port }: Pick<LiveOptions, 'reach' | 'port'>,
  log: Pick<Logger, 'error' | 'info' | 'warn'>,
): void {
  if (live === null) return;
  if ('failed' in live) {
    const remedy = 'another --foxglove-port, or end the program that has this one';
    log.error({ port, remedy }, `no server for Foxglove: ${live.failed}`);
  } else if (reach === 'network')
    log.warn({ ...live, reach }, 'everybody in the network can watch this robot in Foxglove');
  else log.info({ ...live, reach }, 'server for Foxglove');
}
