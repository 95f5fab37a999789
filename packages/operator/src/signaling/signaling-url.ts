import { signalingEndpoint } from '@farpoint/protocol';

/** The WebSocket address of a signaling service's endpoint for operators, or why a text is not one. */
export type SignalingAddress =
  | {
      /** The whole address. */
      url: string;
    }
  | {
      /** What is wrong, in one word, for programs that say it in another language. */
      reason: SignalingAddressFault;
      /** The same for people. */
      fault: string;
    };

/** Why a text is not the address of a signaling service. `needs-wss`: a page served by https must not use it unencrypted. */
export type SignalingAddressFault = 'no-address' | 'not-websocket' | 'needs-wss';

/**
 * Reads the address of a signaling service: accepts `host`, `host:port`, http, https, ws and wss addresses, and adds
 * what is missing. A path is where the service is, behind a proxy: /teleop has its operators at /teleop/operator.
 *
 * @param text as a person wrote it
 * @param securePage whether the page was served by https: it may use `wss:` only, except on the loopback interface
 */
export function parseSignalingUrl(text: string, securePage: boolean): SignalingAddress {
  const withScheme = /^[a-z]+:\/\//i.test(text) ? text : `${securePage ? 'wss' : 'ws'}://${text}`;
  let url: URL;
  try {
    url = new URL(withScheme.replace(/^http/i, 'ws'));
  } catch {
    return { reason: 'no-address', fault: `“${text}” is not an address` };
  }
  if (url.protocol !== 'ws:' && url.protocol !== 'wss:')
    return { reason: 'not-websocket', fault: `“${text}” is not a WebSocket address` };
  if (securePage && url.protocol === 'ws:' && !isLoopback(url.hostname)) {
    return { reason: 'needs-wss', fault: 'a page served by https can only use a wss: signaling address' };
  }
  return { url: signalingEndpoint(url.href, 'operator').href };
}

/**
 * Whether a secret may be sent there: only encrypted, or within this machine.
 *
 * @param url as {@link parseSignalingUrl} returns it
 */
export function isPrivateAddress(url: string): boolean {
  const { protocol, hostname } = new URL(url);
  return protocol === 'wss:' || isLoopback(hostname);
}

function isLoopback(hostname: string): boolean {
  return hostname === 'localhost' || hostname === '127.0.0.1' || hostname === '[::1]';
}
