/** The interface between a camera's encoder and what feeds it with pictures. */
import type { VideoProcess } from '@farpoint/video';

/** What takes a camera's pictures: the process that encodes them. */
export type FeedTarget = Pick<VideoProcess, 'takes' | 'pushFrame' | 'pushCoded'>;

export interface FeedEvents {
  /** @param fault why no picture comes, for people. The next encoded picture clears it. */
  onFault(fault: string): void;
}

/** Pictures on their way to an encoder, until it is closed. */
export interface Feed {
  close(): void;
}
