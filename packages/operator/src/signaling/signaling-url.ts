/** Accepts `host`, `host:port`, http, https, ws and wss addresses; adds what is missing. */
export function parseSignalingUrl(text: string, securePage: boolean): { url: string } | { fault: string } {
  const withScheme = /^[a-z]+:\/\//i.test(text) ? text : `${securePage ? 'wss' : 'ws'}://${text}`;
  let url: URL;
  try {
    url = new URL(withScheme.replace(/^http/i, 'ws'));
  } catch {
    return { fault: `“${text}” is not an address` };
  }
  if (url.protocol !== 'ws:' && url.protocol !== 'wss:')
    return { fault: `“${text}” is not a WebSocket address` };
  if (securePage && url.protocol === 'ws:' && !isLoopback(url.hostname)) {
    return { fault: 'a page served by https can only use a wss: signaling address' };
  }
  if (url.pathname === '' || url.pathname === '/') url.pathname = '/operator';
  url.hash = '';
  return { url: url.href };
}

function isLoopback(hostname: string): boolean {
  return hostname === 'localhost' || hostname === '127.0.0.1' || hostname === '[::1]';
}
