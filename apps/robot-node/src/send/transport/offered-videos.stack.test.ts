import { FixedRateController } from '@farpoint/congestion';
import type { VideoCodec } from '@farpoint/protocol';
import {
  ABS_CAPTURE_TIME_URI,
  rtpTimestamp,
  type SenderReport,
  unixMsOfNtp,
  writePictureLoss,
} from '@farpoint/rtp';
import { eventually } from '@farpoint/service/testing/eventually';
import { describe, expect, it, onTestFinished } from 'vitest';
import { RtcpSrPacket } from 'werift';
import { monotonicMs } from '../../ground/clock.ts';
import { unixOffsetMs } from '../../ground/wall-clock.ts';
import { streamOfVideo, VideoFrame } from '../../sense/video/video-frame.ts';
import { OperatorClient } from '../../testing/operator-client.ts';
import { OperatorPeer } from './operator-peer.ts';
import type { VideoLine } from './peer-events.ts';
import type { RtpTransport } from './rtp-transport.ts';
import { StreamSender } from './stream-sender.ts';

async function session(codecs: readonly (VideoCodec | readonly VideoCodec[])[]) {
  const videos = codecs.map((each) => [each].flat());
  const client = new OperatorClient();
  const connected = Promise.withResolvers<{ clouds: RtpTransport; lines: readonly VideoLine[] }>();
  const peer = new OperatorPeer(
    { iceServers: [], connectTimeoutMs: 20_000, videos },
    {
      onCandidate: (candidate) => void client.connection.addIceCandidate(candidate as never),
      onConnected: (clouds, lines) => connected.resolve({ clouds, lines }),
      onMessage: () => undefined,
      onEnded: (end, detail) => connected.reject(new Error(`${end}: ${detail}`)),
    },
  );
  connected.promise.catch(() => undefined);
  onTestFinished(async () => {
    await client.close();
    peer.close();
  });
  client.onCandidate = (candidate) => peer.addCandidate(candidate);
  const offer = await peer.offer();
  await peer.answer(await client.answer(offer));
  const { clouds, lines } = await connected.promise;
  const sender = new StreamSender(clouds, new FixedRateController({ bitsPerSecond: 50e6 }), monotonicMs);
  for (const [video, { transport }] of lines.entries()) {
    if (transport !== null) sender.addStream(streamOfVideo(video), transport);
  }
  const pump = setInterval(() => sender.pump(), 2);
  onTestFinished(() => clearInterval(pump));
  return { client, offer, lines, sender };
}

/** A key frame's header: 640 × 480. */
const VP8_KEY_FRAME = [0x10, 0, 0, 0x9d, 0x01, 0x2a, 0x80, 2, 0xe0, 1];
/** Parameter sets, and the beginning of a picture's first slice. */
const H264_KEY_FRAME = [
  ...[0, 0, 0, 1, 0x67, 0x42, 0xe0, 0x1f],
  ...[0, 0, 0, 1, 0x68, 0xce],
  ...[0, 0, 0, 1, 0x65, 0x88],
];

/** A picture with recognisable bytes. */
function frameOf(video: number, codec: VideoCodec, capturedAtMs: number, bytes = 5000): VideoFrame {
  const picture = new Uint8Array(bytes).map((_, i) => 1 + ((i * 7 + video) % 250));
  picture.set(codec === 'VP8' ? VP8_KEY_FRAME : H264_KEY_FRAME);
  return new VideoFrame(
    { bytes: picture, key: true, capturedAtMs, width: 640, height: 480 },
    { video, codec, pictureId: 7, framesPerSecond: 30 },
  );
}

const payloadTypesOf = (section: string, codec: VideoCodec) =>
  [...section.matchAll(new RegExp(`a=rtpmap:(\\d+) ${codec}/`, 'g'))].map(([, type]) => Number(type));

describe('videos of a session', { timeout: 30_000 }, () => {
  it('have an m-line each, in their own streams and with one codec', async () => {
    const { offer } = await session(['H264', 'VP8']);
    expect(offer.match(/^m=\w+/gm)).toEqual(['m=audio', 'm=video', 'm=video', 'm=application']);
    expect(offer).toMatch(/a=group:BUNDLE 0 1 2 3/);
    const [, first = '', second = ''] = offer.split('m=video');
    expect(first).toMatch(/msid:farpoint-video-0 /);
    expect(first.match(/a=rtpmap:\d+ (\w+)/g)?.map((line) => line.split(' ')[1])).toEqual(['H264']);
    expect(second).toMatch(/msid:farpoint-video-1 /);
    expect(second.match(/a=rtpmap:\d+ (\w+)/g)?.map((line) => line.split(' ')[1])).toEqual(['VP8']);
    for (const section of [first, second]) {
      expect(section).toContain(ABS_CAPTURE_TIME_URI);
      expect(section).toMatch(/rtcp-fb:\d+ nack pli/);
      expect(section).toMatch(/a=sendonly/);
    }
  });

  it('with several codecs offer all of them, the preferred first, and send each with its payload type', async () => {
    const { client, offer, sender, lines } = await session([['H264', 'VP8'], 'VP8']);
    const [, first = ''] = offer.split('m=video');
    expect(first.match(/a=rtpmap:\d+ (\w+)/g)?.map((line) => line.split(' ')[1])).toEqual(['H264', 'VP8']);
    const [line] = lines;
    const types = (['H264', 'VP8'] as const).map((codec) => payloadTypesOf(first, codec)[0]);
    expect([...line!.payloadTypes]).toEqual([
      ['H264', types[0]],
      ['VP8', types[1]],
    ]);
    const nowMs = monotonicMs();
    sender.enqueue(frameOf(0, 'H264', nowMs - 60));
    const received = () => client.videos.get('1');
    await client.until(() => received()?.frames.length === 1);
    expect(received()?.payloadType).toBe(types[0]);
    sender.enqueue(frameOf(0, 'VP8', nowMs - 30));
    await client.until(() => received()?.frames.length === 2);
    expect(received()?.payloadType).toBe(types[1]);
    expect(received()?.frames.map(({ bytes }) => bytes.length)).toEqual([5000, 5000]);
  });

  it('arrive whole, with the capture time as timestamp and as NTP time', async () => {
    const { client, sender, lines } = await session(['H264', 'VP8']);
    const capturedAtMs = monotonicMs() - 5;
    sender.enqueue(frameOf(0, 'H264', capturedAtMs));
    sender.enqueue(frameOf(1, 'VP8', capturedAtMs));
    const mids = lines.map(({ mid }) => mid);
    expect(mids).toEqual(['1', '2']);
    await client.until(() => mids.every((mid) => client.videos.get(mid)?.frames.length === 1));
    const received = mids.map((mid) => client.videos.get(mid)!);
    for (const { frames } of received) {
      expect(frames[0]).toMatchObject({ timestamp: rtpTimestamp(capturedAtMs, 90_000), isKeyFrame: true });
      expect(frames[0]!.bytes).toHaveLength(5000);
    }
    // The session found its offset at another moment, and both are right to a millisecond.
    const unixMs = capturedAtMs + unixOffsetMs();
    for (const { captureTime } of received)
      expect(unixMsOfNtp(captureTime!.captured)).toBeCloseTo(unixMs, -1);
  });

  it('are reported with their clock', async () => {
    const { client, lines } = await session(['VP8']);
    const transport = lines[0]!.transport!;
    const reports: SenderReport[] = [];
    for (const { receiver } of client.connection.getTransceivers()) {
      receiver.onRtcp?.subscribe((packet: unknown) => {
        if (packet instanceof RtcpSrPacket) {
          const { ssrc, senderInfo } = packet;
          reports.push({
            ssrc,
            ntp: { seconds: 0, fraction: 0 },
            rtpTimestamp: senderInfo.rtpTimestamp,
            packets: senderInfo.packetCount,
            octets: senderInfo.octetCount,
          });
        }
      });
    }
    const nowMs = monotonicMs();
    const waiting = setInterval(() => transport.sendReport(nowMs, 90_000), 20);
    onTestFinished(() => clearInterval(waiting));
    await eventually(() => reports.length > 0);
    expect(reports[0]).toMatchObject({ rtpTimestamp: rtpTimestamp(nowMs, 90_000), packets: 0, octets: 0 });
  });

  it('hear requests for key frames and for lost packets, each for its own stream', async () => {
    const { client, sender, lines } = await session(['VP8', 'VP8']);
    const lost: number[] = [];
    sender.onPictureLoss = (stream) => lost.push(stream);
    const [, second] = lines;
    const { dtlsTransport } = client.connection.getTransceivers()[0]!;
    const ask = (ssrc: number) =>
      dtlsTransport.sendRtcp([{ serialize: () => Buffer.from(writePictureLoss(1, ssrc)) } as never]);
    await ask(99);
    const hasHeard = async () => {
      await ask(second!.transport!.ssrc);
      return lost.length > 0;
    };
    await eventually(hasHeard);
    expect(new Set(lost)).toEqual(new Set([2]));
  });
});
