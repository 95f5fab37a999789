import { VIDEO_CLOCK_RATE, type VideoCodec } from '@farpoint/protocol';
import { streamOfVideo, type VideoFrame, videoOfStream } from '../../sense/video/video-frame.ts';
import type { PathBudget } from '../budgets/path-budget.ts';
import type { VideoLine } from '../transport/peer-events.ts';
import type { StreamSender } from '../transport/stream-sender.ts';
import { VideoSender } from './video-sender.ts';

/**
 * A receiver uses the reports to relate a stream's timestamps to time of day, ms. Chosen: more often than RFC
 * 3550's 5 s, so that the page knows capture times a second after a video begins, and a new
 * listener to sound need not wait.
 */
export const REPORT_MS = 1000;
const NONE: ReadonlySet<VideoCodec> = new Set();

/** One operator's videos, from its wishes to its m-lines. Before it has connected, nothing is sent. */
export class OperatorVideos {
  lines: readonly VideoLine[] = [];
  /** Whether the operator wants the capture time in the pictures. */
  barcode = false;
  readonly #budget: PathBudget;
  readonly #mostBitsPerSecond: (video: number, codecs: ReadonlySet<VideoCodec>) => number;
  readonly #needsKeyFrame: (video: number) => void;
  #codecs: ReadonlyMap<number, ReadonlySet<VideoCodec>> = new Map();
  #connected: { sender: StreamSender; videos: VideoSender } | null = null;
  #reportedMs = Number.NEGATIVE_INFINITY;

  constructor(
    budget: PathBudget,
    mostBitsPerSecond: (video: number, codecs: ReadonlySet<VideoCodec>) => number,
    needsKeyFrame: (video: number) => void,
  ) {
    this.#budget = budget;
    this.#mostBitsPerSecond = mostBitsPerSecond;
    this.#needsKeyFrame = needsKeyFrame;
  }

  get wanted(): ReadonlySet<number> {
    return this.#connected?.videos.wanted ?? new Set();
  }

  get sender(): VideoSender | null {
    return this.#connected?.videos ?? null;
  }

  /** What the operator decodes of a video; nothing if it refused the line. */
  codecs(video: number): ReadonlySet<VideoCodec> {
    return this.#codecs.get(video) ?? NONE;
  }

  connect(sender: StreamSender, lines: readonly VideoLine[]): void {
    this.lines = lines;
    const accepted = new Map<number, ReadonlySet<VideoCodec>>();
    for (const [video, { transport, payloadTypes }] of lines.entries()) {
      if (transport === null) continue;
      sender.addStream(streamOfVideo(video), transport);
      accepted.set(video, new Set(payloadTypes.keys()));
    }
    this.#codecs = accepted;
    const videos = new VideoSender(accepted, (frame) => sender.enqueue(frame), this.#needsKeyFrame);
    sender.onPictureLoss = (stream) => videos.onPictureLoss(videoOfStream(stream));
    this.#connected = { sender, videos };
  }

  disconnect(): void {
    this.lines = [];
    this.#codecs = new Map();
    this.barcode = false;
    this.#connected = null;
  }

  /** @param barcode whether their pictures carry their capture time */
  want(videos: readonly number[], barcode: boolean): void {
    if (this.#connected === null) return;
    this.barcode = barcode;
    const sender = this.#connected.videos;
    sender.want(videos);
    this.#budget.wantVideos(
      () =>
        new Map(
          [...sender.wanted]
            .map((video) => [video, this.#mostBitsPerSecond(video, this.codecs(video))] as const)
            .filter(([, bitsPerSecond]) => bitsPerSecond > 0),
        ),
    );
  }

  offer(frame: VideoFrame): void {
    this.#connected?.videos.offer(frame);
  }

  /** The pacer dropped a frame of a video; what waits behind it cannot be decoded without it. */
  onDropped(stream: number): void {
    this.#connected?.videos.onDropped(videoOfStream(stream));
  }

  clear(): void {
    this.#connected?.videos.clear();
  }

  /** Sends the sender reports that are due. */
  sendDueReports(nowMs: number): void {
    if (this.#connected === null || nowMs - this.#reportedMs < REPORT_MS) return;
    this.#reportedMs = nowMs;
    for (const video of this.wanted) this.lines[video]?.transport?.sendReport(nowMs, VIDEO_CLOCK_RATE);
  }
}
