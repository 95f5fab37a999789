/** What is recorded, and served live. */
import type { CloudKind } from '@farpoint/recording';

/**
 * Which videos are recorded: `always`, for which cameras are encoded while nobody watches, too; only while an operator
 * watches them; or none.
 */
export const RECORDED_VIDEOS = ['always', 'watched', 'none'] as const;
export type RecordedVideos = (typeof RECORDED_VIDEOS)[number];

/** Who can reach the live server: programs on this machine, or everybody in its networks. */
export const FOXGLOVE_REACHES = ['localhost', 'network'] as const;

export interface RecordingOptions {
  /** Path of the MCAP file that is written from the start, which must not exist yet; `null` for none. */
  path: string | null;
  /** Where operators' recordings go, and the size of all of them, bytes; `null`: operators begin none. */
  folder: { path: string; mostBytes: number } | null;
  compression: 'none' | 'zstd';
  /** Highest number of clouds per second; 0 records none. */
  clouds: Readonly<Record<CloudKind, number>>;
  videos: RecordedVideos;
  /** A recording ends, complete, before it exceeds this size. */
  mostBytes: number;
}

/** A server that shows live what a recording contains. */
export interface LiveOptions {
  port: number;
  reach: (typeof FOXGLOVE_REACHES)[number];
  /** Origins of web pages that may connect, besides the viewers' own and pages of this machine. */
  allowedOrigins: readonly string[];
  /** Of this machine, by which its own pages may connect. */
  ownNames: readonly string[];
  /** Highest number of clouds of each kind per second. */
  cloudsPerSecond: number;
}

/** At least one of them. */
export interface SessionOutputs {
  record: RecordingOptions | null;
  foxglove: LiveOptions | null;
}
