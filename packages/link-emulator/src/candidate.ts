/** ICE candidates and session descriptions as text, rewritten for other addresses. Pure. */
import { isIP } from 'node:net';

/** A UDP transport address. */
export interface Endpoint {
  readonly address: string;
  readonly port: number;
}

/** Why a candidate cannot be routed through the link, and is left out. */
export const candidateFaults = [
  'malformed', // not a candidate as in RFC 8839
  'not-udp', // TCP would bypass the link
  'mdns', // a .local name: only its owner's network can resolve it
  'hostname', // any other name
  'link-local', // its address is valid only together with an interface
] as const;
export type CandidateFault = (typeof candidateFaults)[number];

/** A parsed UDP candidate; see {@link standIn}. */
export interface UdpCandidate {
  readonly endpoint: Endpoint;
  readonly text: string;
}

// candidate:foundation component transport priority address port typ …, preceded by a= in SDP.
const CANDIDATE =
  /^(?:a=)?(?:candidate:)?[\w+/]{1,32} \d{1,5} (?<transport>\S{1,16}) \d{1,10} (?<address>\S{1,255}) (?<port>\d{1,5}) typ \S+(?: .*)?$/;
const BASE = /^((?:a=)?(?:candidate:)?(?:\S+ ){4})\S+ \d+ /;
const RELATED = / raddr \S+ rport \d+/;
/** RFC 8839 §5.1: the values used there for privacy. */
const NO_RELATED = { 4: ' raddr 0.0.0.0 rport 9', 6: ' raddr :: rport 9' };

/** Reads one candidate, with or without `a=` and `candidate:` before it. Accepts any text. */
export function readCandidate(text: string): UdpCandidate | CandidateFault {
  const groups = CANDIDATE.exec(text)?.groups;
  if (groups === undefined || /[\r\n]/.test(text)) return 'malformed';
  const { transport, address, port: portText } = groups as Record<'transport' | 'address' | 'port', string>;
  if (transport.toLowerCase() !== 'udp') return 'not-udp';
  const port = Number(portText);
  if (port < 1 || port > 65_535) return 'malformed';
  if (isIP(address) === 0) {
    return address.toLowerCase().endsWith('.local') ? 'mdns' : 'hostname';
  }
  if (/^fe[89ab]/i.test(address) || address.startsWith('169.254.') || address.includes('%')) {
    return 'link-local';
  }
  return { endpoint: { address, port }, text };
}

/** The candidate with its endpoint replaced; the base that it was derived from is removed. */
export function standIn(candidate: UdpCandidate, endpoint: Endpoint): string {
  const related = isIP(endpoint.address) === 6 ? NO_RELATED[6] : NO_RELATED[4];
  return candidate.text
    .replace(BASE, (_, before: string) => `${before}${endpoint.address} ${endpoint.port} `)
    .replace(RELATED, () => related);
}

/** The UDP endpoints that a session description names. */
export function endpointsOf(sdp: string): Endpoint[] {
  return sdp.split(/\r\n|\r|\n/).flatMap((line) => {
    if (!line.startsWith('a=candidate:')) return [];
    const candidate = readCandidate(line);
    return typeof candidate === 'string' ? [] : [candidate.endpoint];
  });
}

/**
 * The session description with every candidate replaced or left out, and the default addresses of its media lines
 * removed as for trickled candidates (RFC 8840): no address of the peer itself remains. Accepts any text.
 *
 * @param place returns the replacement for an endpoint; `null` leaves the candidate out
 * @param onFault called for each candidate that cannot be replaced
 */
export function rewriteSdp(
  sdp: string,
  place: (endpoint: Endpoint) => Endpoint | null,
  onFault: (fault: CandidateFault) => void,
): string {
  // Lines keep their line endings, so that nothing else changes.
  const parts = sdp.split(/(\r\n|\r|\n)/);
  let rewritten = '';
  for (let index = 0; index < parts.length; index += 2) {
    const line = rewriteLine(parts[index]!, place, onFault);
    if (line !== null) rewritten += line + (parts[index + 1] ?? '');
  }
  return rewritten;
}

function rewriteLine(
  line: string,
  place: (endpoint: Endpoint) => Endpoint | null,
  onFault: (fault: CandidateFault) => void,
): string | null {
  if (line.startsWith('a=candidate:')) {
    const candidate = readCandidate(line);
    if (typeof candidate === 'string') {
      onFault(candidate);
      return null;
    }
    const endpoint = place(candidate.endpoint);
    return endpoint === null ? null : standIn(candidate, endpoint);
  }
  // A port of 0 means that the media line is rejected, and stays.
  if (line.startsWith('m=')) return line.replace(/^(m=\S+ )(?!0+ )\d+/, (_, media: string) => `${media}9`);
  if (line.startsWith('c=IN IP4')) return 'c=IN IP4 0.0.0.0';
  if (line.startsWith('c=IN IP6')) return 'c=IN IP6 ::';
  if (line.startsWith('a=rtcp:')) return 'a=rtcp:9 IN IP4 0.0.0.0';
  if (line.startsWith('a=remote-candidates:')) return null;
  return line;
}
