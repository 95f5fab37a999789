/** Writes a clip as a WebM file. Loaded when a clip is saved. */
import { BufferTarget, EncodedPacket, EncodedVideoPacketSource, Output, WebMOutputFormat } from 'mediabunny';
import { type ClipTimes, clipTimes } from '../../ground/capture/clip-times.ts';
import { CLIP_CODEC, CLIP_FRAMES_PER_SECOND, type Clip } from './clip-recorder.ts';

export interface ClipFile extends Pick<ClipTimes, 'seconds' | 'missingS'> {
  readonly content: Blob;
}

/** @param clip has pictures @throws {Error} if it cannot be written */
export async function clipFile({ pictures, size }: Clip): Promise<ClipFile> {
  const { shown, seconds, missingS } = clipTimes(pictures, 1e6 / CLIP_FRAMES_PER_SECOND);
  const target = new BufferTarget();
  const output = new Output({ format: new WebMOutputFormat(), target });
  const source = new EncodedVideoPacketSource(CLIP_CODEC);
  output.addVideoTrack(source);
  await output.start();
  const decoderConfig = { codec: CLIP_CODEC, codedWidth: size.width, codedHeight: size.height };
  for (const [i, { bytes, key }] of pictures.entries()) {
    const { atS, forS } = shown[i] ?? { atS: 0, forS: 0 };
    const packet = new EncodedPacket(bytes, key ? 'key' : 'delta', atS, forS);
    await source.add(packet, i === 0 ? { decoderConfig } : undefined);
  }
  await output.finalize();
  if (target.buffer === null) throw new Error('nothing was written');
  return { content: new Blob([target.buffer], { type: 'video/webm' }), seconds, missingS };
}
