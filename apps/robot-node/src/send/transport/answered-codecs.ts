/**
 * Reads from an operator's SDP answer which of the offered codecs it takes for each video, and with which payload type.
 * werift compares only names, and a single bad line makes it refuse the whole answer; so it gets the good ones only.
 */
import { VIDEO_CLOCK_RATE, type VideoCodec } from '@farpoint/protocol';

/** Why an operator gets no packets of a video. */
export type VideoRefusal =
  | 'refused' // the answer refuses the line (port 0)
  | 'bad-line' // the m-line itself makes no sense
  | 'no-common-codec' // it names none of the offered codecs
  | 'bad-payload-type' // a codec's payload type is not one of the dynamic ones
  | 'ambiguous-payload-type' // one payload type stands for several codecs
  | 'other-parameters'; // H.264 in another profile or packetization mode than offered

/** What the answer says of one video. */
export interface AnsweredVideo {
  /** The payload type of each codec that the operator takes. */
  readonly payloadTypes: ReadonlyMap<VideoCodec, number>;
  /** `null` if it takes one at least. */
  readonly refusal: VideoRefusal | null;
}

export interface ReadAnswer {
  /** The answer without what cannot be used; lines without a codec are refused in it. */
  readonly sdp: string;
  /** By video. */
  readonly videos: readonly AnsweredVideo[];
}

const VIDEO_LINE = /^m=video (\d{1,5}) ([A-Z/]+) (.+)$/;
const OF_FORMAT = /^a=(rtpmap|fmtp|rtcp-fb):(\S+) ?(.*)$/;
const ANY_OF_FORMAT = /^a=(?:rtpmap|fmtp|rtcp-fb)\b/;

/**
 * @param sdp an answer whose m-lines are those of the offer
 * @param offered the codecs of each video m-line
 */
export function readVideoAnswers(sdp: string, offered: readonly (readonly VideoCodec[])[]): ReadAnswer {
  const [session = [], ...media] = sections(sdp);
  const videos: AnsweredVideo[] = [];
  const refusedMids = new Set<string>();
  const kept = media.map((lines) => {
    const codecs = lines[0]?.startsWith('m=video') ? offered[videos.length] : undefined;
    if (codecs === undefined) return lines;
    const answered = readVideo(lines, codecs);
    videos.push(answered);
    if (answered.refusal === null)
      return withOnly(lines, new Set([...answered.payloadTypes.values()].map(String)));
    const mid = lines.find((line) => line.startsWith('a=mid:'));
    if (mid !== undefined) refusedMids.add(mid.slice('a=mid:'.length));
    return [
      'm=video 0 UDP/TLS/RTP/SAVPF 0',
      'c=IN IP4 0.0.0.0',
      'a=inactive',
      ...(mid === undefined ? [] : [mid]),
    ];
  });
  const bundled = session.map((line) =>
    line.startsWith('a=group:BUNDLE ')
      ? line
          .split(' ')
          .filter((mid, i) => i === 0 || !refusedMids.has(mid))
          .join(' ')
      : line,
  );
  return {
    sdp: [bundled, ...kept]
      .flat()
      .map((line) => `${line}\r\n`)
      .join(''),
    videos,
  };
}

/** The lines of the session, then those of each m-line. */
function sections(sdp: string): string[][] {
  const found: string[][] = [[]];
  for (const line of sdp.split(/\r?\n/)) {
    if (line === '') continue;
    if (line.startsWith('m=')) found.push([]);
    found.at(-1)?.push(line);
  }
  return found;
}

function readVideo(lines: readonly string[], offered: readonly VideoCodec[]): AnsweredVideo {
  const none = (refusal: VideoRefusal) => ({ payloadTypes: new Map(), refusal });
  const [, port, , formats] = VIDEO_LINE.exec(lines[0] ?? '') ?? [];
  if (port === undefined || formats === undefined) return none('bad-line');
  if (port === '0') return none('refused');
  const { names, parameters } = attributes(lines);
  const payloadTypes = new Map<VideoCodec, number>();
  let refusal: VideoRefusal | null = null;
  for (const format of new Set(formats.split(' '))) {
    const codec = offered.find((each) => names.get(format)?.has(`${each}/${VIDEO_CLOCK_RATE}`));
    if (codec === undefined) continue;
    const fault = formatFault(format, names, codec, parameters);
    if (fault !== null) refusal ??= fault;
    // The first is the one that the operator prefers.
    else if (!payloadTypes.has(codec)) payloadTypes.set(codec, Number(format));
  }
  return payloadTypes.size > 0 ? { payloadTypes, refusal: null } : none(refusal ?? 'no-common-codec');
}

/** By the format of the m-line: the names that it is given, in capitals, and its first parameters. */
function attributes(lines: readonly string[]) {
  const names = new Map<string, Set<string>>();
  const parameters = new Map<string, string>();
  for (const line of lines) {
    const [, kind, format = '', value = ''] = OF_FORMAT.exec(line) ?? [];
    if (kind === 'rtpmap') names.set(format, (names.get(format) ?? new Set()).add(value.toUpperCase()));
    else if (kind === 'fmtp' && !parameters.has(format)) parameters.set(format, value);
  }
  return { names, parameters };
}

function formatFault(
  format: string,
  names: ReadonlyMap<string, ReadonlySet<string>>,
  codec: VideoCodec,
  parameters: ReadonlyMap<string, string>,
): VideoRefusal | null {
  if (!isDynamic(format)) return 'bad-payload-type';
  if ((names.get(format)?.size ?? 0) > 1) return 'ambiguous-payload-type';
  return codec === 'H264' && !isOfferedH264(parameters.get(format) ?? '') ? 'other-parameters' : null;
}

/** 64–95 cannot be told from RTCP in the same flow (RFC 5761 §4), and those below 35 have fixed meanings. */
function isDynamic(format: string): boolean {
  if (!/^\d{2,3}$/.test(format) || format.startsWith('0')) return false;
  const number = Number(format);
  return (number >= 35 && number <= 63) || (number >= 96 && number <= 127);
}

/** Packets of mode 1, and constrained baseline by any of its names (RFC 6184 §8.1). */
function isOfferedH264(parameters: string): boolean {
  const values = new Map(
    parameters.split(';').map((each) => {
      const [name = '', value = ''] = each.split('=', 2);
      return [name.trim().toLowerCase(), value.trim().toLowerCase()];
    }),
  );
  if (values.get('packetization-mode') !== '1') return false;
  const profile = values.get('profile-level-id');
  if (profile === undefined) return true;
  if (!/^[0-9a-f]{6}$/.test(profile)) return false;
  const constraints = Number.parseInt(profile.slice(2, 4), 16);
  const needed = { '42': 0x40, '4d': 0x80, '58': 0xc0 }[profile.slice(0, 2)];
  return needed !== undefined && (constraints & needed) === needed;
}

/** The section with these formats and no others. What two lines say of one format, the first says. */
function withOnly(lines: readonly string[], formats: ReadonlySet<string>): string[] {
  const said = new Set<string>();
  const [first = '', ...others] = lines;
  const [, port, protocol] = VIDEO_LINE.exec(first) ?? [];
  const kept = others.filter((line) => {
    if (!ANY_OF_FORMAT.test(line)) return true;
    const [, kind = '', format = '', value = ''] = OF_FORMAT.exec(line) ?? [];
    if (kind === 'rtcp-fb') return value !== '' && (format === '*' || formats.has(format));
    const isNew = formats.has(format) && !said.has(`${kind} ${format}`);
    said.add(`${kind} ${format}`);
    return isNew;
  });
  return [`m=video ${port} ${protocol} ${[...formats].join(' ')}`, ...kept];
}
