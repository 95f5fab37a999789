/** Writes a clip as a WebM file. Loaded when a clip is saved. */
import { BufferTarget, EncodedPacket, EncodedVideoPacketSource, Output, WebMOutputFormat } from 'mediabunny';
import { CLIP_CODEC, type Clip } from './clip-recorder.ts';

/** The last picture's, and the longest of any, seconds: a page that was hidden has drawn nothing. */
const USUAL_S = 1 / 15;

/** @throws {Error} if it has no pictures */
export async function clipFile({ pictures, size }: Clip): Promise<Blob> {
  const target = new BufferTarget();
  const output = new Output({ format: new WebMOutputFormat(), target });
  const source = new EncodedVideoPacketSource(CLIP_CODEC);
  output.addVideoTrack(source);
  await output.start();
  const beganUs = pictures[0]?.timestampUs ?? 0;
  const decoderConfig = { codec: CLIP_CODEC, codedWidth: size.width, codedHeight: size.height };
  for (const [i, { bytes, key, timestampUs }] of pictures.entries()) {
    const nextUs = pictures[i + 1]?.timestampUs ?? timestampUs + USUAL_S * 1e6;
    await source.add(
      new EncodedPacket(
        bytes,
        key ? 'key' : 'delta',
        (timestampUs - beganUs) / 1e6,
        (nextUs - timestampUs) / 1e6,
      ),
      i === 0 ? { decoderConfig } : undefined,
    );
  }
  await output.finalize();
  if (target.buffer === null) throw new Error('nothing was written');
  return new Blob([target.buffer], { type: 'video/webm' });
}
