/** What the list of robots says while it is empty: nobody knows which robots there are before the service has said so. */
import type { SignalingState } from '@farpoint/operator';
import type { Words } from './words.ts';

/** @param host of the signaling service, for people */
export function emptyListWords(signaling: SignalingState, host: string): Words {
  switch (signaling) {
    case 'ready':
      return {
        text: 'No robots are online. They appear here as soon as they connect to the signaling service.',
        tone: 'neutral',
      };
    case 'refused':
      return {
        text: `The signaling service at ${host} refused this page’s token, so it lists no robots. Enter the token in Settings, under Connection.`,
        tone: 'bad',
      };
    case 'waiting':
      return {
        text: `The signaling service at ${host} cannot be reached, so no robots can be listed. Check the network, or the address in Settings. Trying again…`,
        tone: 'warning',
      };
    case 'connecting':
      return { text: `Asking the signaling service at ${host} for its robots…`, tone: 'neutral' };
    case 'stopped':
      return { text: 'Not connected to a signaling service.', tone: 'neutral' };
  }
}
