/** What the page is told by its address and what it remembers: checked here, trusted elsewhere. */

import { displayNameSchema, robotIdSchema, tokenSchema } from '@farpoint/protocol';
import { type BridgeAddress, parseBridge } from './bridge/bridge-settings.ts';

/** What the browser keeps between visits. */
export interface StoredSettings {
  signaling?: string | undefined;
  token?: string | undefined;
  name?: string | undefined;
  pointScale?: number | undefined;
}

export interface Settings {
  /** WebSocket address of the operators' endpoint. */
  signalingUrl: string;
  /** Why the address that was given is not used; `null` where all is well. */
  signalingFault: string | null;
  token: string | undefined;
  name: string;
  /** Take the stream from a bridge instead of from the robots themselves. */
  bridge: BridgeAddress | null;
  /** Connect to it as soon as it is there. */
  robot: string | null;
  /** `relay`: by TURN servers only. */
  icePolicy: 'all' | 'relay';
  /** Fixed size of the canvas in pixels, for benchmarks. */
  canvas: { width: number; height: number } | null;
  /** `points64`: refuse the coded formats. */
  mode: 'auto' | 'points64';
  /** Draw every so many-th point only, for benchmarks where the GPU is an emulated one; `null`: as many as can be drawn. */
  drawEvery: number | null;
  pointScale: number;
}

/** Port of the signaling service, where the page is served by something else. */
export const DEFAULT_SIGNALING_PORT = 3000;
const MAX_CANVAS = 8192;

/**
 * @param query the page's query string
 * @param page where the page comes from
 */
export function readSettings(
  query: URLSearchParams,
  stored: StoredSettings,
  page: { protocol: string; hostname: string; host: string; isDevServer: boolean },
): Settings {
  const secure = page.protocol === 'https:';
  // Served by the signaling service itself, or by a development server beside it.
  const host = page.isDevServer ? `${page.hostname || 'localhost'}:${DEFAULT_SIGNALING_PORT}` : page.host;
  const standard = `${secure ? 'wss' : 'ws'}://${host}/operator`;
  const asked = nonEmpty(query.get('signaling')) ?? nonEmpty(stored.signaling);
  const given = asked === undefined ? null : parseSignalingUrl(asked, secure);
  const name = nonEmpty(query.get('name')) ?? nonEmpty(stored.name) ?? 'Operator';
  const token = nonEmpty(query.get('token')) ?? nonEmpty(stored.token);
  const robot = nonEmpty(query.get('robot'));
  return {
    signalingUrl: given !== null && 'url' in given ? given.url : standard,
    signalingFault: given !== null && 'fault' in given ? given.fault : null,
    token: token !== undefined && tokenSchema.safeParse(token).success ? token : undefined,
    name: displayNameSchema.safeParse(name).success ? name : 'Operator',
    bridge: parseBridge(query.get('bridge') ?? '', query.get('bridge-signaling')),
    robot: robot !== undefined && robotIdSchema.safeParse(robot).success ? robot : null,
    icePolicy: query.get('ice') === 'relay' ? 'relay' : 'all',
    canvas: parseCanvas(query.get('canvas')),
    mode: query.get('mode') === 'points64' ? 'points64' : 'auto',
    drawEvery: parseEvery(query.get('every')),
    pointScale: clampScale(stored.pointScale),
  };
}

function parseEvery(text: string | null): number | null {
  const every = Number(text);
  return text !== null && Number.isInteger(every) && every >= 1 && every <= 1024 ? every : null;
}

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
    return { fault: `“${text}” is no WebSocket address` };
  if (securePage && url.protocol === 'ws:' && !isLoopback(url.hostname)) {
    return { fault: 'a page served by https can only use a wss: signaling address' };
  }
  if (url.pathname === '' || url.pathname === '/') url.pathname = '/operator';
  url.hash = '';
  return { url: url.href };
}

/** What of local storage can be used. */
export function parseStored(text: string | null): StoredSettings {
  let value: unknown;
  try {
    value = JSON.parse(text ?? '{}');
  } catch {
    return {};
  }
  if (typeof value !== 'object' || value === null) return {};
  const record = value as Record<string, unknown>;
  const textOf = (key: string): string | undefined =>
    typeof record[key] === 'string' && record[key].length <= 4096 ? record[key] : undefined;
  return {
    signaling: textOf('signaling'),
    token: textOf('token'),
    name: textOf('name'),
    pointScale: typeof record.pointScale === 'number' ? clampScale(record.pointScale) : undefined,
  };
}

export function clampScale(scale: number | undefined): number {
  return scale !== undefined && Number.isFinite(scale) ? Math.min(Math.max(scale, 0.25), 4) : 1;
}

function parseCanvas(text: string | null): Settings['canvas'] {
  const match = /^(\d{1,5})x(\d{1,5})$/.exec(text ?? '');
  if (match === null) return null;
  const [width, height] = [Number(match[1]), Number(match[2])];
  if (width < 16 || height < 16 || width > MAX_CANVAS || height > MAX_CANVAS) return null;
  return { width, height };
}

function isLoopback(hostname: string): boolean {
  return hostname === 'localhost' || hostname === '127.0.0.1' || hostname === '[::1]';
}

function nonEmpty(text: string | null | undefined): string | undefined {
  const trimmed = text?.trim();
  return trimmed === undefined || trimmed === '' ? undefined : trimmed;
}
