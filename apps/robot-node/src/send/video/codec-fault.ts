import type { VideoCodec } from '@farpoint/protocol';
import type { VideoRefusal } from '../transport/answered-codecs.ts';
import type { VideoLine } from '../transport/peer-events.ts';

const ANSWERED: Readonly<Record<Exclude<VideoRefusal, 'refused' | 'no-common-codec'>, string>> = {
  'bad-line': 'its m-line for this video makes no sense',
  'bad-payload-type': 'it gives this video’s codec a payload type that is not dynamic',
  'ambiguous-payload-type': 'it gives one payload type to several codecs',
  'other-parameters': 'it takes H.264 in another profile or packetization mode only',
};

/**
 * @param codec that the video is encoded with at present
 * @returns why an operator gets no pictures, for people; `null` if it is not the codec's fault
 */
export function codecFault({ refusal, payloadTypes }: VideoLine, codec: VideoCodec): string | null {
  if (refusal === null) {
    if (payloadTypes.has(codec)) return null;
    return `this client does not decode ${codec}, which the camera has at present for others who watch`;
  }
  if (refusal === 'refused' || refusal === 'no-common-codec')
    return `this client does not decode ${codec}: give the camera another encoder (\`auto\` offers several)`;
  return `this client’s answer cannot be used: ${ANSWERED[refusal]} (${refusal})`;
}
