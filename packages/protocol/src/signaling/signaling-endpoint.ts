/** What a signaling service serves: WebSockets for robots and operators, and whether it works. */
export type SignalingEndpoint = 'robot' | 'operator' | 'healthz';

const NAMED = /\/(?:robot|operator|healthz)$/;

/**
 * The address of an endpoint, below the path at which the service is, if it has one: behind a proxy it may be at
 * wss://host/teleop. An address that already ends with an endpoint is that of the service.
 *
 * @param service its address; an absolute URL
 */
export function signalingEndpoint(service: string, endpoint: SignalingEndpoint): URL {
  const url = new URL(service);
  const path = url.pathname.replace(/\/+$/, '').replace(NAMED, '');
  url.pathname = `${path}/${endpoint}`;
  url.hash = '';
  return url;
}
