/** The page's settings, from its address and from local storage. They are checked here and trusted everywhere else. */

import {
  type BridgeAddress,
  isPrivateAddress,
  parseBridge,
  parseSignalingUrl,
  type SignalingAddressFault,
} from '@farpoint/operator';
import { displayNameSchema, robotIdSchema, tokenSchema } from '@farpoint/protocol';
import { type BenchSettings, NO_BENCH } from './bench-settings.ts';
import { type HeadsetSettings, parseHeadset } from './headset-settings.ts';
import { parseTokens, type SignalingTokens, tokenOrigin, withToken } from './signaling-tokens.ts';
import { type MapTiles, mapTilesOf } from './telemetry/map-tiles.ts';

/**
 * `track`: the browser receives and decodes, and its track processor gives each frame. `native`: the browser receives and decodes, and tells when it shows another frame. `webcodecs`: a worker takes the
 * encoded frames and decodes them.
 */
export const VIDEO_RECEIVERS = ['track', 'native', 'webcodecs'] as const;
export type VideoReceiverName = (typeof VIDEO_RECEIVERS)[number];

/** What the browser keeps between visits. */
export interface StoredSettings {
  signaling?: string | undefined;
  tokens?: SignalingTokens | undefined;
  /** Tokens that came in the address; kept until the tab is closed. */
  visitTokens?: SignalingTokens | undefined;
  name?: string | undefined;
  pointScale?: number | undefined;
  synchronised?: boolean | undefined;
  cues?: boolean | undefined;
  clips?: boolean | undefined;
  /** Address template of a map's tiles, and whose they are. */
  mapTiles?: string | undefined;
  mapAttribution?: string | undefined;
  headset?: HeadsetSettings | undefined;
}

/** Where the page was loaded from. */
export interface PageOrigin {
  protocol: string;
  hostname: string;
  host: string;
  isDevServer: boolean;
}

/** Why an address of the signaling service is not used as it was given. */
export interface SignalingFault {
  /** `insecure-token`: it is used, but a token is not sent there. */
  readonly reason: SignalingAddressFault | 'insecure-token';
  /** As it was written. */
  readonly address: string;
}

export interface Settings extends BenchSettings {
  /** WebSocket address of the operators' endpoint. */
  signalingUrl: string;
  /** Why the given address cannot be used; `null` if it can, or if none was given. */
  signalingFault: SignalingFault | null;
  token: string | undefined;
  name: string;
  /** The bridge that the stream comes from; `null` to connect to robots directly. */
  bridge: BridgeAddress | null;
  /** Id of the robot to connect to as soon as it is listed. */
  robot: string | null;
  /** `relay`: connect through TURN servers only. */
  icePolicy: 'all' | 'relay';
  pointScale: number;
  /** Whether videos are presented in step: frames wait for what was captured at the same time. */
  synchronised: boolean;
  /** Whether sound and vibration tell that the robot does less than it is told. */
  cues: boolean;
  /** Whether the last 30 seconds of the view are kept for a clip. */
  clips: boolean;
  /** How the headset shows and is held. */
  headset: HeadsetSettings;
  /** Whether the view is led by the operator's commands. */
  predict: boolean;
  /** Where tiles of a map come from; `null`: no tile is fetched. */
  mapTiles: MapTiles | null;
  /** How videos are received; `null`: as suits this browser best. */
  videoReceiver: VideoReceiverName | null;
}

/** Port of the signaling service if something else serves the page. */
const DEFAULT_SIGNALING_PORT = 3000;

/** The page's own signaling service: the one that serves the page, or the one beside a development server. */
export function ownSignalingUrl(page: PageOrigin): string {
  const host = page.isDevServer ? `${page.hostname || 'localhost'}:${DEFAULT_SIGNALING_PORT}` : page.host;
  return `${page.protocol === 'https:' ? 'wss' : 'ws'}://${host}/operator`;
}

/**
 * @param query the page's query string
 * @param bench what tests and benchmarks ask for
 */
export function readSettings(
  query: URLSearchParams,
  stored: StoredSettings,
  page: PageOrigin,
  bench: BenchSettings = NO_BENCH,
): Settings {
  const secure = page.protocol === 'https:';
  const own = ownSignalingUrl(page);
  const inQuery = nonEmpty(query.get('signaling'));
  const asked = inQuery ?? nonEmpty(stored.signaling);
  const given = asked === undefined ? null : parseSignalingUrl(asked, secure);
  const signalingUrl = given !== null && 'url' in given ? given.url : own;
  const name = nonEmpty(query.get('name')) ?? nonEmpty(stored.name) ?? 'Operator';
  // A token in the query belongs to the service in the query, or else to the page's own service.
  const cameFor = inQuery === undefined ? own : given !== null && 'url' in given ? given.url : null;
  const isForHere = cameFor !== null && tokenOrigin(cameFor) === tokenOrigin(signalingUrl);
  const origin = tokenOrigin(signalingUrl);
  const token =
    (isForHere ? nonEmpty(query.get('token')) : undefined) ??
    stored.visitTokens?.get(origin) ??
    stored.tokens?.get(origin);
  const hasToken = token !== undefined && tokenSchema.safeParse(token).success;
  const mayTell = isPrivateAddress(signalingUrl);
  const robot = nonEmpty(query.get('robot'));
  return {
    signalingUrl,
    signalingFault:
      given !== null && 'reason' in given
        ? { reason: given.reason, address: asked ?? '' }
        : hasToken && !mayTell
          ? { reason: 'insecure-token', address: signalingUrl }
          : null,
    token: hasToken && mayTell ? token : undefined,
    name: displayNameSchema.safeParse(name).success ? name : 'Operator',
    bridge: parseBridge(query.get('bridge') ?? '', query.get('bridge-signaling')),
    robot: robot !== undefined && robotIdSchema.safeParse(robot).success ? robot : null,
    icePolicy: query.get('ice') === 'relay' ? 'relay' : 'all',
    pointScale: clampScale(stored.pointScale),
    synchronised: stored.synchronised ?? true,
    cues: stored.cues ?? true,
    clips: stored.clips ?? false,
    headset: parseHeadset(stored.headset),
    predict: query.get('predict') !== '0',
    mapTiles: mapTilesOf(stored.mapTiles, stored.mapAttribution, page),
    videoReceiver: VIDEO_RECEIVERS.find((name) => name === query.get('video')) ?? null,
    ...bench,
  };
}

/**
 * The usable part of local storage. Earlier versions of the page stored a single token and did not say for which
 * service. Such a token is used for `ownUrl` only.
 */
export function parseStored(text: string | null, ownUrl: string): StoredSettings {
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
  const single = nonEmpty(textOf('token'));
  const own = tokenOrigin(ownUrl);
  const tokens = parseTokens(record.tokens);
  return {
    signaling: textOf('signaling'),
    tokens: single === undefined || tokens.has(own) ? tokens : withToken(tokens, own, single),
    name: textOf('name'),
    pointScale: typeof record.pointScale === 'number' ? clampScale(record.pointScale) : undefined,
    synchronised: typeof record.synchronised === 'boolean' ? record.synchronised : undefined,
    cues: typeof record.cues === 'boolean' ? record.cues : undefined,
    clips: typeof record.clips === 'boolean' ? record.clips : undefined,
    headset: record.headset === undefined ? undefined : parseHeadset(record.headset),
    mapTiles: textOf('mapTiles'),
    mapAttribution: textOf('mapAttribution'),
  };
}

export function clampScale(scale: number | undefined): number {
  return scale !== undefined && Number.isFinite(scale) ? Math.min(Math.max(scale, 0.25), 4) : 1;
}

function nonEmpty(text: string | null | undefined): string | undefined {
  const trimmed = text?.trim();
  return trimmed === undefined || trimmed === '' ? undefined : trimmed;
}
